"""Scripts on damaged results: real files of every problem, cut, overwritten, with parts missing, or not of this program.

Usage: damaged_results_test.py EXECUTABLE [--all]. Without --all every seventy-fifth damage. Each script ends with an exit code of its
own and, where it cannot go on, with one line that names the file. Exit code 77 (skipped) where a Python package is missing.
"""

import json
import os
import pathlib
import random
import shutil
import sys
import tempfile

import running
import small_decks

SCRIPTS = running.SOURCE / "scripts"
sys.path.insert(0, str(running.SOURCE / "python"))
h5py = running.package("h5py")
np = running.package("numpy")
for module in ("flame", "flame_study", "planes", "population", "reactor", "sizes"):  # once for all children
    running.package(f"lampblack.plots.{module}")

POPULATION = small_decks.population("dsmc: {type: dsmc, particles: 50}", repeats=2, outputs=5, bins=10, times=[1])
FLAME = small_decks.free_flame("hydrogen_h2o2_10.yaml", "H2", slope=0.5, curve=0.8)
SECONDS = 30  # of the processor; a script that takes more hangs


def make_results(program, folder):
    """A run of every problem and a study; the scripts that read it, with what follows the folder."""
    (folder / "population.yaml").write_text(POPULATION, encoding="utf-8")
    (folder / "flame.yaml").write_text(FLAME, encoding="utf-8")
    (folder / "study.yaml").write_text(f"study: flames\ndeck: {folder}/flame.yaml\nvary:\n"
                                       "  - {key: inlet.equivalence_ratio, values: [1, 1.1]}\n", encoding="utf-8")
    (folder / "profile.csv").write_text("z_m,T_K\n0,300\n0.01,1500\n0.02,300\n", encoding="utf-8")
    profile = str(folder / "profile.csv")
    ignition = running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml"
    tasks = {
        "flow": (("run", running.small_case(folder), *running.settings("time.end=2 us")),
                 [("plot",), ("compare_centreline", profile)]),
        "population": (("run", folder / "population.yaml"), [("plot",)]),
        "reactor": (("run", ignition, *running.settings("time.end=0.2 ms")), [("plot",)]),
        "flame": (("run", folder / "flame.yaml"),
                  [("plot",), ("compare_flame", profile), ("compare_sections",), ("compare_premixed_soot",)]),
        "study": (("sweep", folder / "study.yaml"), [("plot",), ("check_soot_trends",), ("compare_premixed_soot",)]),
    }
    made = {}
    for name, (arguments, scripts) in tasks.items():
        result = program(*arguments, "--out", folder / name)
        assert result.code == 0, f"{name}: {result.err}"
        made[name] = (folder / name, scripts)
    return made


def flip(content, places):
    damaged = bytearray(content)
    for place in places:
        damaged[place] ^= 0xFF
    return bytes(damaged)


def byte_damages(content):
    """Name and content of a damaged file."""
    size = len(content)
    chance = random.Random(size)
    yield "empty", b""
    yield "text", b"this is a text, and not what was here before\n"
    yield "bytes", bytes(range(256)) * 8
    for length in sorted({1, min(100, size - 1), size // 4, size // 2, 3 * size // 4, size - 1}):
        yield f"cut to {length}", content[:length]
    for count in (1, 20, 500):
        yield f"{count} bytes flipped", flip(content, [chance.randrange(size) for _ in range(count)])
        yield f"{count} bytes flipped at the start", flip(content, [chance.randrange(min(size, 3000)) for _ in range(count)])


def without(path, name):
    with h5py.File(path, "r+") as file:
        del file[name]


def replaced(path, name, values):
    with h5py.File(path, "r+") as file:
        del file[name]
        file[name] = values


def damages(folder):
    """A name and a function that damages a copy of the folder."""
    results = sorted(path.relative_to(folder) for path in folder.rglob("results.h5"))[0]
    yield "folder for results", lambda copy: ((copy / results).unlink(), (copy / results).mkdir())
    for name, content in byte_damages((folder / results).read_bytes()):
        yield f"{results}: {name}", lambda copy, content=content: (copy / results).write_bytes(content)
    with h5py.File(folder / results, "r") as file:
        names = []
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        groups = list(file)
    for name in groups:
        yield f"without {name}", lambda copy, name=name: without(copy / results, name)
        yield f"text for {name}", lambda copy, name=name: replaced(copy / results, name, "text")
    for name in random.Random(1).sample(sorted(names), 5):
        yield f"without {name}", lambda copy, name=name: without(copy / results, name)
        yield f"empty {name}", lambda copy, name=name: replaced(copy / results, name, np.zeros((0,)))
        yield f"another shape of {name}", lambda copy, name=name: replaced(copy / results, name, np.ones((2, 3, 2)))
        yield f"texts for {name}", lambda copy, name=name: replaced(copy / results, name, [b"a", b"b"])
    yield "run.json is a pipe", lambda copy: ((copy / "run.json").unlink(missing_ok=True), os.mkfifo(copy / "run.json"))
    yield "a long line", lambda copy: (copy / "study.csv").write_text("run," + "x" * 200000 + "\nnone,done\n")
    for text in sorted([*folder.glob("*.json"), *folder.glob("*.csv"), *folder.glob("*/run.json")]):
        for name, content in list(byte_damages(text.read_bytes()))[::3]:
            yield (f"{text.relative_to(folder)}: {name}",
                   lambda copy, text=text, content=content: (copy / text.relative_to(folder)).write_bytes(content))
        for content in ("[]", "{}", '{"runs": 1, "deck": 2}', '{"runs": [1], "deck": {"mesh": []}}') if text.suffix == ".json" else ():
            yield (f"{text.relative_to(folder)}: {content}",
                   lambda copy, text=text, content=content: (copy / text.relative_to(folder)).write_text(content))


def main():
    program = running.Program(sys.argv[1], [], 1)
    every = 1 if "--all" in sys.argv else 75
    counts = {0: 0, 1: 0, 2: 0}
    failed = files = seen = 0
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        for problem, (folder, scripts) in make_results(program, work).items():
            for script, *more in scripts[:1]:
                ended = running.script(SCRIPTS / script, folder, *more, seconds=SECONDS)
                assert ended.code == 0, f"{problem}: {script} fails on what is whole: {ended.err}"
                shutil.rmtree(folder / "pictures")
            for damage, apply in damages(folder):
                seen += 1
                if seen % every:
                    continue
                files += 1
                copy = work / "copy"
                shutil.copytree(folder, copy)
                apply(copy)
                for script, *more in scripts:
                    ended = running.script(SCRIPTS / script, copy, *more, seconds=SECONDS)
                    code, told = ended.code, ended.err
                    lines = told.splitlines()
                    good = code in (0, 1) and not lines or code == 2 and len(lines) == 1 and str(copy) in lines[0]
                    counts[code] = counts.get(code, 0) + 1
                    if not good:
                        failed += 1
                        print(f"FAILED {problem}, {damage}: {script} ends with {code}\n{told}")
                shutil.rmtree(copy)
    print(json.dumps({"damaged files": files, "exit codes": counts, "failed": failed}))
    return 1 if failed or files < 200 / every else 0


if __name__ == "__main__":
    sys.exit(main())
