"""A flow that was interrupted and restarted against one that was not: the same results and history, to the last bit on the same
number of ranks, to the solvers' tolerance on another. And restarts that must be refused.

Usage: restart_test.py EXECUTABLE RANKS MPIEXEC...
"""

import csv
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

import running

h5py = running.package("h5py")
numpy = running.package("numpy")

STEADY = ("time.steady={time: 8 us, tolerance: 1e-6}",)  # which adds columns to the history
# No row of the history in the middle: what it counts since the last one is saved.
SETTINGS = ("time.end=28 us", *STEADY, "time.maximum_step=2 us", "output.interval=7 us", "output.history_steps=4",
            "boundaries.fuel.swirl_velocity=10 cm/s", "output.boundaries=[all]",
            "output.probes={flame: {at: [1 mm, 5 mm]}}", "output.lines={axis: {from: [0 mm, 1 mm], to: [0 mm, 7 mm], points: 5}}")
# The start of a run that goes on is that of its checkpoint, whatever the deck says.
OTHER_START = ("initial.position=5 mm", "initial.temperature=1500 K", "time.first_step=0.7 us")
MIDDLE = 10  # of some 17 steps


def rows(out):
    with open(out / "history.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def tables(out):
    return {path.name: path.read_text("utf-8") for path in (out / "tables").glob("*.csv")}


def assert_equal(out, reference, but=()):
    """The same to the last bit: results, history, and the description of the results."""
    found, expected = running.datasets(out / "results.h5"), running.datasets(reference / "results.h5")
    assert found.keys() == expected.keys(), found.keys() ^ expected.keys()
    different = [name for name in expected if name not in but and found[name].tobytes() != expected[name].tobytes()]
    assert not different, f"{out.name} differs from {reference.name} in {different}"
    assert rows(out) == rows(reference), f"{out.name} has another history than {reference.name}"
    assert tables(out) == tables(reference), f"{out.name} has other tables than {reference.name}"
    assert (out / "results.xdmf").read_text("utf-8") == (reference / "results.xdmf").read_text("utf-8")


def largest_difference(out, reference):
    """Of the last fields, relative to the largest value of each."""
    found, expected = running.datasets(out / "results.h5"), running.datasets(reference / "results.h5")
    assert found.keys() == expected.keys(), found.keys() ^ expected.keys()
    last = max(name for name in expected if name.startswith("steps/")).rsplit("/", 1)[0]
    worst = ("", 0.0)
    for name in expected:
        scale = abs(expected[name]).max() if name.startswith(last) else 0
        # Traces below the stiff solver's absolute tolerance, and pressure, which is 1e-8 of that of the gas, are noise.
        if scale > 1e-9 and not name.endswith("/pressure"):
            worst = max(worst, (name, abs(found[name] - expected[name]).max() / scale), key=lambda pair: pair[1])
    return worst


def run(program, *arguments):
    result = program("run", *arguments)
    assert result.code == 0, f"{arguments}: {result.err}"
    return result


def check_middle(program, folder, deck, sweeps=1):
    """N steps against N/2, a restart, N/2."""
    options = running.settings(*SETTINGS, f"checkpoint.steps={MIDDLE}", f"time.sweeps={sweeps}")
    folder = folder / f"sweeps_{sweeps}"
    folder.mkdir()
    whole = folder / "whole"
    run(program, deck, *options, "--out", whole)
    assert [file.name for file in sorted((whole / "checkpoint").glob("step_*"))] == [f"step_{MIDDLE:06}.h5"]
    rest = folder / "rest"
    run(program, deck, *options, *running.settings(*OTHER_START), "--out", rest, "--restart", whole / f"checkpoint/step_{MIDDLE:06}.h5")
    assert_equal(rest, whole)
    check_other_tables(program, folder, deck, options, whole)
    return whole


def check_other_tables(program, folder, deck, options, whole):
    """A restart with other tables: what both have goes on, what is new begins, what is left out is gone."""
    out = folder / "others"
    other = running.settings("output.boundaries=[fuel]", "output.probes={flame: {at: [1 mm, 5 mm]}, new: {at: [2 mm, 5 mm]}}",
                             "output.lines={axis: {from: [0 mm, 1 mm], to: [0 mm, 7 mm], points: 5}}")
    run(program, deck, *options, *other, "--out", out, "--restart", whole / f"checkpoint/step_{MIDDLE:06}.h5")
    found, expected = tables(out), tables(whole)
    new = found.pop("probe_new.csv").splitlines()
    assert new[0] == expected["probe_flame.csv"].splitlines()[0]
    steps = [int(line.split(",")[0]) for line in expected["probe_flame.csv"].splitlines()[1:]]
    assert [int(line.split(",")[0]) for line in new[1:]] == [step for step in steps if step > MIDDLE], new
    assert found == {name: text for name, text in expected.items() if name in ("boundary_fuel.csv", "probe_flame.csv", "line_axis.csv")}


def check_other_ranks(executable, mpiexec, folder, deck, whole, ranks, others):
    for number in others:
        out = folder / f"from_{ranks}_on_{number}"
        run(running.Program(executable, mpiexec, number), deck, *running.settings(*SETTINGS), "--out", out, "--restart",
            whole / f"checkpoint/step_{MIDDLE:06}.h5")
        name, difference = largest_difference(out, whole)
        print(f"from {ranks} to {number} ranks: {difference:.1e} in {name}")
        assert difference < 1e-5, (name, difference)
        # What came in and left is summed over the ranks.
        for column, value in rows(out)[-1].items():
            if "flow" in column or "content" in column:
                assert abs(float(value) - float(rows(whole)[-1][column])) <= 1e-6 * abs(float(value)), column


def wait_for(ready, process, what):
    for _ in range(3000):
        if ready():
            return
        assert process.poll() is None, f"the run ended before {what}: {process.communicate()}"
        time.sleep(0.01)
    process.kill()
    raise AssertionError(f"no {what} in half a minute")


def start(program, *arguments):
    return subprocess.Popen([*program.command, "run", *map(str, arguments)], env=running.environment(), text=True,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def checkpoints(out):
    return sorted(file.name for file in (out / "checkpoint").glob("step_*.h5"))


def steps_in(out):
    history = out / "history.csv"
    return history.read_bytes().count(b"\n") - 1 if history.is_file() else 0


def check_requests(program, folder, deck):
    """Checkpoints by signal and by file, a stop, and going on from there: against a run that was left alone."""
    end = "0.1 ms" if program.ranks == 1 else "0.06 ms"
    options = running.settings(f"time.end={end}", "time.maximum_step=1 us", "output.interval=0.015 ms")
    whole, out = folder / "alone", folder / "asked"
    run(program, deck, *options, "--out", whole)
    process = start(program, deck, *options, "--out", out)
    wait_for(lambda: steps_in(out) > 5, process, "step")
    # One rank is enough.
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
    rank = int(children[-1]) if program.ranks > 1 else process.pid
    os.kill(rank, signal.SIGUSR1)
    wait_for(lambda: len(checkpoints(out)) == 1, process, "checkpoint after SIGUSR1")
    (out / "checkpoint-now").touch()
    wait_for(lambda: not (out / "checkpoint-now").exists() and len(checkpoints(out)) == 2, process, "second checkpoint")
    first = checkpoints(out)
    os.kill(rank, signal.SIGTERM)
    told = running.without_launcher(process.communicate(timeout=60)[1])
    assert process.returncode == 128 + signal.SIGTERM and len(told.splitlines()) == 1, told
    assert f"--restart goes on from {out}/checkpoint/{checkpoints(out)[-1]}" in told, told
    assert len(checkpoints(out)) == 2 and checkpoints(out)[0] == first[1], "the last two are kept"
    assert run(program, deck, *options, "--out", out, "--restart").out.count("continues from") == 1
    assert_equal(out, whole)


def check_later_end(program, folder, deck, whole):
    """A run that has ended goes on to a later end, with another interval of outputs."""
    out = folder / "later"
    run(program, deck, *running.settings(*SETTINGS, "checkpoint.at_end=true"), "--out", out)
    assert_equal(out, whole)
    result = run(program, deck, *running.settings(*SETTINGS, *OTHER_START), "--out", out, "--restart")  # not a step
    assert "no step is left: the checkpoint is of t = 2.8e-05 s, and time.end is 2.8e-05 s" in result.err, result.err
    assert_equal(out, whole)
    before = rows(out)
    result = run(program, deck, *running.settings(*STEADY, "time.end=32 us", "output.interval=3 us"), "--out", out, "--restart")
    assert "continues from" in result.out
    record = json.loads((out / "run.json").read_text("utf-8"))
    earlier, own = record["steps_before_restart"], record["steps"] - record["steps_before_restart"]
    assert earlier == int(float(before[-1]["step [1]"])) and 0 < own < earlier, record
    assert f"x {own} steps on " in result.out and f", after {earlier} steps before the restart\n" in result.out, result.out
    assert rows(out)[: len(before)] == before and abs(float(rows(out)[-1]["time [s]"]) - 32e-6) < 1e-15
    with h5py.File(out / "results.h5", "r") as file:
        times = sorted(step.attrs["time"] for step in file["steps"].values())
    assert len(times) == 7 and abs(numpy.array(times[-3:]) - [28e-6, 30e-6, 32e-6]).max() < 1e-12, times


def refusal(program, before, folder, words, *arguments):
    result = program("run", *arguments)
    assert result.code == 2 and result.err.count("lampblack: ") == 1 and result.err.startswith("lampblack: "), (words, result)
    for word in words:
        assert word in result.err, (word, result.err)
    assert running.snapshot(folder) == before, f"{words}: something was written"


def check_absent(program, folder, deck, base, whole):
    """Nothing to restart from; one message on any number of ranks."""
    before = running.snapshot(folder)
    refusal(program, before, folder, ["there is no checkpoint in this folder"], deck, *base, "--out", folder / "none", "--restart")
    refusal(program, before, folder, ["is missing"], deck, *base, "--out", whole, "--restart", folder / "none.h5")
    refusal(program, before, folder, ["of another pressure"], deck, *base, *running.settings("pressure=2 atm"), "--out", whole,
            "--restart")
    refusal(program, before, folder, ["write no checkpoints"], running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml",
            "--out", whole, "--restart")


def check_wrong(program, folder, deck, whole):
    """One message, exit code 2, and nothing written."""
    base = running.settings(*SETTINGS)
    check_absent(program, folder, deck, base, whole)
    mechanism = folder / "mechanisms" / running.MECHANISM
    text = mechanism.read_text(encoding="utf-8")
    constant = re.search(r"A: ([0-9.e+]+)", text)
    mechanism.with_name("other.yaml").write_text(text[: constant.start()] + "A: 1.5" + text[constant.end():], encoding="utf-8")
    before = running.snapshot(folder)
    others = {"mesh": ["mesh.refinement=2"], "boundaries": ["boundaries.oxidiser_flange.type=symmetry"], "pressure": ["pressure=2 atm"],
              "mechanism": ["mechanism=../mechanisms/other.yaml"],
              "particle model": ["particles.description=none"]}
    for name, values in others.items():
        wrong = [*base, *running.settings(*values)]
        refusal(program, before, folder, [f"of another {name} (its own: "], deck, *wrong, "--out", whole, "--restart")
    file = whole / f"checkpoint/step_{MIDDLE:06}.h5"
    refusal(program, before, folder, ["already", "--force"], deck, *base, "--out", whole.parent / "rest", "--restart", file)
    outputs = next((whole / "checkpoint").glob("outputs_*.h5"))
    for victim in (file, outputs):
        check_damage(program, folder, deck, base, whole, victim)


def check_damage(program, folder, deck, base, whole, victim):
    """One bit, or the end of the file; anywhere."""
    chance = random.Random(3)
    good = victim.read_bytes()
    places = [0, len(good) - 1, len(good) - 50] + [chance.randrange(len(good)) for _ in range(3)]
    bad = [good[:place] + bytes([good[place] ^ 1 << chance.randrange(8)]) + good[place + 1:] for place in places]
    bad += [good[:length] for length in (0, len(good) // 2, len(good) - 1)]
    for content in bad:
        victim.write_bytes(content)
        refusal(program, running.snapshot(folder), folder, [victim.name, "and there is no other checkpoint"], deck, *base,
                "--out", whole, "--restart")
    victim.write_bytes(good)


def check_one_before(program, folder, deck, whole):
    """Where the newest is damaged the one before it is taken, and the run says so."""
    out = folder / "two"
    options = running.settings(*SETTINGS, f"checkpoint.steps={MIDDLE // 2}")
    run(program, deck, *options, "--out", out)
    older, newest = sorted((out / "checkpoint").glob("step_*.h5"))
    saved = [step for file in (out / "checkpoint").glob("outputs_*.h5") for step in h5py.File(file)["steps"]]
    assert len(saved) == len(set(saved)) > 2, f"each output is saved once: {saved}"
    newest.write_bytes(newest.read_bytes()[:-1])
    result = run(program, deck, *options, "--out", out, "--restart")
    assert result.err.count("warning") == 2 and newest.name in result.err and "before the flow is steady" in result.err and older.name in result.out, result
    assert_equal(out, whole)


def check_full_disk(program, folder, deck):
    """A checkpoint for which there is no room is told, the former stays, and the run goes on. A limit on the size of files is
    treated as a full disk; the results are small enough for it."""
    out = folder / "full"
    options = running.settings(*SETTINGS, "output.interval=1 s", "output.species=[O2]", "mesh.refinement=4", "particles.description=none")
    run(program, deck, *options, *running.settings("time.end=1 us", "checkpoint.at_end=true"), "--out", out)
    (former,) = (out / "checkpoint").glob("step_*.h5")
    before = former.read_bytes()
    limit = len(before) - 1
    done = subprocess.run([*program.command, "run", str(deck), *options, *running.settings("checkpoint.steps=1", "time.end=4 us"),
                           "--out", str(out), "--restart"], env=running.environment(), stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    assert done.returncode == 0 and "no checkpoint at step" in done.stderr and "disk full: " in done.stderr, done
    assert former.read_bytes() == before and checkpoints(out) == [former.name], checkpoints(out)
    assert not [file.name for file in out.rglob("*") if file.name.endswith(".part")]
    assert abs(float(rows(out)[-1]["time [s]"]) - 4e-6) < 1e-15


def main(executable, ranks, *mpiexec):
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        whole = check_middle(program, folder, deck)
        check_middle(program, folder, deck, sweeps=2)
        check_requests(program, folder, deck)
        if program.ranks == 1:
            check_later_end(program, folder, deck, whole)
            check_wrong(program, folder, deck, whole)
            check_one_before(program, folder, deck, whole)
            check_full_disk(program, folder, deck)
        else:
            check_other_ranks(executable, list(mpiexec), folder, deck, whole, 2, [1, 3])
            check_absent(program, folder, deck, running.settings(*SETTINGS), whole)
    print("restarts: all in order")


if __name__ == "__main__":
    main(*sys.argv[1:])
