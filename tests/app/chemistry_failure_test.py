"""A run whose chemistry cannot be solved ends on all ranks, with exit code 3, one message and a record that says so. It
leaves the cell in a file, which `lampblack replay` advances again: to the same failure, or to the end with options that
can be met. Before, the step is tried again, smaller, as often as the deck allows, and the run keeps what it goes on from.

Usage: chemistry_failure_test.py EXECUTABLE RANKS MPIEXEC...
"""

import json
import pathlib
import re
import sys
import tempfile

import running

# More than double precision has.
TOO_MUCH = ("chemistry.relative_tolerance=1e-18", "chemistry.absolute_tolerance=1e-40")
NUMBER = "[-+.0-9e]+"


def check_failure(program: running.Program, folder: pathlib.Path) -> pathlib.Path:
    """Runs into the failure; returns the file that the cell leaves."""
    deck = running.small_case(folder)
    result = program("run", deck, *running.settings(*TOO_MUCH, "time.retries=2"), "--out", folder / "out", timeout=120)
    assert result.code == 3, f"exit code {result.code}, expected 3\n{result.out}{result.err}"
    *warnings, last = result.err.splitlines()
    tried = [re.search("^lampblack: warning: step 1 from t = 0 s failed and is tried again with dt = ([0-9.e-]+) s in place of "
                       r"([0-9.e-]+) s: chemistry failed in cell [0-9]+ at \(", line).groups() for line in warnings]
    assert tried == [("2.5e-07", "1e-06"), ("6.25e-08", "2.5e-07")], result.err
    assert "this was step 1 from t = 0 s, tried with dt = 1e-06 s, 2.5e-07 s, 6.25e-08 s; " in last, last
    lines = [last]
    for part in (r"^lampblack: numerics: chemistry failed in cell [0-9]+ at \([-0-9.e]+, [-0-9.e]+\) m at time [-0-9.e]+ s",
                 r"T = [0-9.]+ K", r"p = 101325 Pa", r"mass fractions \{.*(N2|C2H4): [0-9.e-]+"):
        assert re.search(part, lines[0]), f"the message lacks {part}\n{result.err}"
    record = json.loads((folder / "out/run.json").read_text(encoding="utf-8"))
    assert record["status"] == "failed" and record["retried_steps"] == 2 and record["steps"] == 0, record
    assert record["message"] and record["message"] in lines[0], record
    assert not (folder / "out/results.h5").exists(), "a failed run looks finished"
    assert (folder / "out/results.h5.part").exists(), "what there was is lost"
    cell = re.search(r"in cell ([0-9]+) ", lines[0]).group(1)
    told = re.search(r"lampblack replay (\S+); ", lines[0])
    assert told, f"the message does not say how to replay\n{result.err}"
    assert pathlib.Path(told.group(1)) == folder / f"out/failed_cell_{cell}.yaml", told.group(1)
    print(f"{program.ranks} rank(s): {lines[0][:150]}...")
    return pathlib.Path(told.group(1))


def check_going_on(program: running.Program, folder: pathlib.Path) -> None:
    """What the run has kept goes on where the deck asks for what can be done."""
    arguments = ("run", folder / "flame/deck.yaml", *running.settings("time.end=3 us"), "--out", folder / "out", "--restart")
    result = program(*arguments, timeout=120)
    assert result.code == 0 and "continues from " in result.out, f"{result.out}{result.err}"
    assert "tried again" not in result.out, f"no step of this run failed: {result.out}"
    record = json.loads((folder / "out/run.json").read_text(encoding="utf-8"))
    assert record["status"] == "done" and record["retried_steps"] == 2, record
    history = (folder / "out/history.csv").read_text(encoding="utf-8").splitlines()
    column = history[0].split(",").index("retried_steps [1]")
    assert {float(row.split(",")[column]) for row in history[1:]} == {2.0}, history


def check_replay(program: running.Program, file: pathlib.Path) -> None:
    result = program("replay", file)
    assert result.code == 3, f"exit code {result.code}, expected 3\n{result.out}{result.err}"
    assert len(result.err.splitlines()) == 1, result.err
    assert re.search(rf"^lampblack: numerics: the chemistry of a cell could not be advanced: T = {NUMBER} K", result.err), result.err
    for attempt, method in enumerate(("the Rosenbrock method", "CVODE", "CVODE", "CVODE"), 1):
        assert f"attempt {attempt} by {method}: relative tolerance" in result.out, result.out
        assert f"attempt {attempt} failed at T = " in result.out, result.out

    # With tolerances that can be met the cell reaches its end, and every step is shown.
    text = file.read_text(encoding="utf-8")
    text = re.sub("relative_tolerance: .*", "relative_tolerance: 1e-6", text)
    text = re.sub("absolute_tolerance: .*", "absolute_tolerance: 1e-12", text)
    text = re.sub("negligible_change: .*", "negligible_change: 0", text)
    file.write_text(text, encoding="utf-8")
    result = program("replay", file)
    assert result.code == 0, f"exit code {result.code}, expected 0\n{result.out}{result.err}"
    end = re.search(rf"^end: T = {NUMBER} K, ([0-9]+) steps", result.out, re.MULTILINE)
    assert end, result.out
    steps = re.findall(rf"^ *{NUMBER} +{NUMBER} +[1-5] +{NUMBER}$", result.out, re.MULTILINE)
    assert len(steps) == int(end.group(1)) > 0, result.out

    file.write_text(text.replace("pressure:", "presure:"), encoding="utf-8")
    result = program("replay", file)
    assert result.code == 2, f"exit code {result.code}, expected 2\n{result.out}{result.err}"
    assert "unknown key 'presure'; the nearest known key is 'pressure'" in result.err, result.err


def check_force(program: running.Program, folder: pathlib.Path) -> None:
    """Another run in the same folder does not keep the cell of the first."""
    (folder / "out/failed_cell_999999.yaml").write_text("mine\n", encoding="utf-8")
    result = program("run", folder / "flame/deck.yaml", *running.settings(*TOO_MUCH, "time.retries=0"), "--out", folder / "out",
                     "--force", timeout=120)
    assert result.code == 3 and len(result.err.splitlines()) == 1, result.err
    assert not (folder / "out/failed_cell_999999.yaml").exists(), "the failed cell of an earlier run is left"


def main(executable: str, ranks: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        failed = check_failure(program, folder)
        check_replay(program, failed)
        check_going_on(program, folder)
        check_force(program, folder)


main(*sys.argv[1:])
