"""The commands of README.md, in order, as somebody would type them in a clone.

The clone is a folder of links to the sources and the build, with results/ and a home of its own. Files of CHEMKIN, which the page calls
the reader's own, are made here. `./scripts/test` would run this test again, so that only its --help is run. LAMPBLACK_PROGRAM, where it
is set, is used in place of a build by the scripts.

Usage: readme_test.py BUILD_FOLDER CMAKE
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import running
from gas_options_test import CHEMKIN, CHEMKIN_THERMO

sys.path.insert(0, str(running.SOURCE / "tests"))
import pages  # noqa: E402
import pages_test  # noqa: E402

running.package("h5py")
running.package("matplotlib")

# Geometry (0: an atom, 1: linear), well depth, collision diameter, dipole, polarisability, rotational relaxation.
TRANSPORT = """\
H                  0   145.000     2.050     0.000     0.000     0.000
H2                 1    38.000     2.920     0.000     0.790   280.000
"""


def clone(folder, build):
    """A folder that looks like one with a build of the preset release."""
    (folder / "build").mkdir(parents=True)
    (folder / "build/release").symlink_to(pathlib.Path(build).resolve())
    for path in running.SOURCE.iterdir():
        if path.name not in ("build", "results", ".git"):
            (folder / path.name).symlink_to(path)
    (folder / "chem.inp").write_text(CHEMKIN, encoding="utf-8")
    (folder / "therm.dat").write_text(CHEMKIN_THERMO, encoding="utf-8")
    (folder / "tran.dat").write_text(TRANSPORT, encoding="utf-8")


def lines_of_page(text):
    """The blocks of the page and the commands of its table, in their order."""
    table = text.index("| problem |")
    blocks = [(text.index(block.splitlines()[0]), block) for block in pages.indented(text)]
    commands = [command for commands, _ in pages_test.rows_of_problems(text) for command in commands]
    return [line for _, block in sorted([*blocks, (table, "\n".join(commands))]) for line in block.splitlines()]


def runs(lines):
    """(deck, folder of results) of each command of scripts/run."""
    for line in lines:
        for command in pages.words_of(line):
            if command[0] == "./scripts/run":
                deck = pathlib.Path(command[1])
                own = deck.name if not deck.suffix else deck.parent.name if deck.name == "deck.yaml" else f"{deck.parent.name}/{deck.stem}"
                yield deck, f"results/{own}"


def main(build, cmake):
    lines = lines_of_page((running.SOURCE / "README.md").read_text(encoding="utf-8"))
    computed = list(runs(lines))
    assert len(computed) >= 7 and len(lines) > 14, "the page has lost its commands"
    script = "\n".join("./scripts/test --help" if line.split("#")[0].strip() == "./scripts/test" else line for line in lines)
    with tempfile.TemporaryDirectory() as name:
        folder, home = pathlib.Path(name) / "lampblack", pathlib.Path(name) / "home"
        home.mkdir()
        clone(folder, build)
        env = dict(running.environment(), HOME=str(home), PATH=f"{pathlib.Path(cmake).parent}:/usr/sbin:/usr/bin:/sbin:/bin")
        env.pop("PYTHONPATH", None)
        done = subprocess.run(["bash", "-xeuo", "pipefail", "-c", script], cwd=folder, env=env, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        print(done.stdout)
        assert done.returncode == 0, "a command failed"
        for deck, results in [*computed, (None, "results/my_flame")]:
            if (folder / results / "study.json").exists():
                assert json.loads((folder / results / "study.json").read_text())["failed_runs"] == 0, results
            else:
                assert json.loads((folder / results / "run.json").read_text())["status"] == "done", results
            assert list((folder / results / "pictures").glob("*.png")), f"{results} has no pictures"
        assert (folder / "mechanism.yaml").is_file() and os.access(home / "lampblack/bin/lampblack", os.X_OK)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
