"""Command lines one after the other in one process against a process for each: the same exit codes, words and files to the
last byte, before and after others, on one rank and on two. And a process that hangs or crashes in a request, or keeps something.

Usage: program_server_test.py EXECUTABLE MPIEXEC... [--all]      (otherwise a command line of each kind, on one rank)
"""

import csv
import os
import pathlib
import re
import shutil
import signal
import sys
import tempfile
import threading
import time

import running
import small_decks

h5py = running.package("h5py")

CASES = running.SOURCE / "cases"
# What a run measures, not computes.
MEASURED = re.compile(r"seconds|_us\b|per_second|_time_s\b")


def requests(folder: pathlib.Path) -> dict:
    """Command lines of every problem and command, some of them wrong; those with an output folder end with `--out`."""
    flow = running.small_case(folder)
    ensembles = flow.with_name("ensembles.yaml")
    text = flow.read_text(encoding="utf-8")
    ensembles.write_text(text[:text.index("trajectories:")], encoding="utf-8")
    (folder / "flame.yaml").write_text(small_decks.free_flame("hydrogen_h2o2_10.yaml", "H2", slope=0.5, curve=0.8), encoding="utf-8")
    (folder / "population.yaml").write_text(small_decks.population(
        "dsmc: {type: dsmc, particles: 50}, sections: {type: sectional, sections: 20, smallest: 1 m^3, spacing: 2}",
        repeats=3, outputs=5, bins=10, times=[1]), encoding="utf-8")
    (folder / "study.yaml").write_text(f"study: seeds\ndeck: {folder}/population.yaml\nvary:\n  - {{key: seed, values: [1, 2]}}\n",
                                       encoding="utf-8")
    reactor = CASES / "reactor/ignition_hydrogen/deck.yaml"
    soot = CASES / "reactor/closed_soot/deck.yaml"
    along = CASES / "particles_along/premixed_ethylene_abf/deck.yaml"
    mechanism = CASES / "mechanisms/hydrogen_h2o2_10.yaml"
    flow_settings = running.settings("time.end=4 us", "time.maximum_step=1 us")
    closed = CASES / "flow/heated_cavity_lowmach/deck.yaml"
    return {
        "flow": ["run", flow, *flow_settings, "--out"],
        "closed vessel": ["run", closed, *running.settings("mesh.refinement=0.5", "time.end=20 ms"), "--out"],
        "ensembles": ["run", ensembles, *flow_settings, *running.settings("particles={description: ensemble, number: 40, minimum_number_density: 1e9 1/m^3}"), "--out"],
        "checkpoint": ["run", flow, *flow_settings, *running.settings("checkpoint.at_end=true"), "--out"],
        "reactor": ["run", reactor, *running.settings("time.end=0.1 ms", "sensitivity.reactions=['1']"), "--out"],
        "soot": ["run", soot, *running.settings("time.end=0.1 ms", "particles.description=hmom"), "--out"],
        "sections": ["run", soot, *running.settings("time.end=0.1 ms", "particles.description=sectional"), "--out"],
        "along": ["run", along, *running.settings("particles.repeats=2", "particles.number=32", "gas.end=2 ms", "output.times=[1 ms]"), "--out"],
        "flame": ["run", folder / "flame.yaml", "--out"],
        "population": ["run", folder / "population.yaml", "--out"],
        "study": ["sweep", folder / "study.yaml", "--out"],
        "refused": ["run", flow, *running.settings("mesh.refinment=2"), "--out"],
        "failing": ["run", folder / "flame.yaml", *running.settings("grid.maximum_points=41"), "--out"],
        "check": ["check", flow],
        "usage": ["run", "--frobnicate"],
        "gas": ["gas", mechanism, "--T", "1500", "--X", "H2:2, O2:1", "--hp", "--json"],
        "mechanism": ["mechanism", mechanism],
        "reference": ["deck-reference"],
    }


def datasets(path: pathlib.Path) -> dict:
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
    return {name: values for name, values in found.items() if not MEASURED.search(name)}


def contents(out: pathlib.Path) -> dict:
    """Results and tables, without what is measured; the record and the description have times and folders."""
    found = {}
    for path in sorted(out.rglob("*")):
        name = str(path.relative_to(out))
        if path.suffix in (".h5", ".part") and "checkpoint" not in name:
            found[name] = datasets(path)
        elif path.suffix == ".csv":
            head, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
            own = [i for i, column in enumerate(head) if MEASURED.search(column)]
            found[name] = [head, *[[value for i, value in enumerate(row) if i not in own] for row in rows]]
        else:
            found[name] = "there"
    return found


def outcome(program, arguments: list, out: pathlib.Path) -> tuple:
    """Exit code, words on both streams, files."""
    has_folder = arguments[-1] == "--out"
    result = program(*arguments, *([out] if has_folder else []), timeout=120)
    found = contents(out)
    shutil.rmtree(out, ignore_errors=True)
    # What a run says has durations in it.
    return result.code, "" if has_folder else result.out, result.err, found


def first_difference(one, other) -> str:
    for what, a, b in zip(("exit codes", "standard output", "standard error"), one, other):
        if a != b:
            return f"{what}: {a}\nand {b}"
    names = [name for name in one[3].keys() | other[3].keys() if one[3].get(name) != other[3].get(name)]
    parts = [part for name in names if isinstance(one[3].get(name), dict)
             for part in one[3][name] if one[3][name].get(part) != other[3].get(name, {}).get(part)]
    return f"files: {names} {parts}"


def check_sequence(program, folder: pathlib.Path, tasks: dict) -> int:
    """Forwards and backwards in one process, and each in a process of its own."""
    out, failures = folder / "out", 0
    first = {name: outcome(program, arguments, out) for name, arguments in tasks.items()}
    for name in reversed(tasks):
        for what, other in (("after others", program), ("in a process of its own", program.process_of_its_own)):
            again = outcome(other, tasks[name], out)
            same = again == first[name]
            failures += not same
            print(f"{'ok' if same else 'FAILED':8}{name} {what} on {program.ranks} rank(s)"
                  f"{'' if same else ': ' + first_difference(first[name], again)}")
    codes = {name: found[0] for name, found in first.items()}
    expected = {name: {"refused": 2, "usage": 2, "failing": 3}.get(name, 0) for name in tasks}
    assert codes == expected, codes
    return failures


def check_ends(program, folder: pathlib.Path) -> None:
    """A request that hangs, one that crashes, and one beside another thread's: each has its answer, and so has the next."""
    flow = running.small_case(folder)
    long = ["run", flow, *running.settings("time.end=1 s"), "--out", folder / "long"]
    assert program(*long, timeout=0.5).code is None
    assert program("check", flow).code == 0
    server = program._server.process.pid
    assert program("check", flow).code == 0 and program._server.process.pid == server, "a server for each request"

    def crash():
        for _ in range(600):
            if (folder / "crash/history.csv").exists():
                break
            time.sleep(0.05)
        children = pathlib.Path(f"/proc/{server}/task/{server}/children").read_text(encoding="utf-8").split()
        os.kill(int(children[-1]) if program.ranks > 1 else server, signal.SIGKILL)

    thread = threading.Thread(target=crash)
    thread.start()
    result = program(*long[:-1], folder / "crash")
    thread.join()
    assert result.code == (-signal.SIGKILL if program.ranks == 1 else 128 + signal.SIGKILL), result
    codes = running.at_once(lambda deck: program("check", deck).code, [flow, folder / "nowhere.yaml", flow, flow])
    assert codes == [0, 2, 0, 0], codes


# What leaves most in a process: files, options of PETSc, HDF5, failures, many runs in one, and the checks beside them.
OF_EACH_KIND = ("flow", "ensembles", "reactor", "along", "study", "refused", "failing", "usage", "gas", "reference")
ON_TWO_RANKS = ("flow", "soot", "flame", "population", "refused", "check")


def main(executable: str, *mpiexec: str) -> int:
    failures, whole = 0, mpiexec[-1] == "--all"
    mpiexec = mpiexec[:-1] if whole else mpiexec
    with tempfile.TemporaryDirectory() as name:
        for ranks in (1, 2) if whole else (1,):
            folder = pathlib.Path(name) / str(ranks)
            folder.mkdir()
            program = running.Program(executable, list(mpiexec), ranks)
            assert program._server is not None, "there is no program_server beside the executable"
            tasks = requests(folder)
            if ranks > 1 or not whole:
                tasks = {name: tasks[name] for name in (ON_TWO_RANKS if ranks > 1 else OF_EACH_KIND)}
            failures += check_sequence(program, folder, tasks)
            check_ends(program, folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
