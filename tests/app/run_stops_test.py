"""Flows that stop before their end by themselves, or because a rank is gone, and go on from there.

Usage: run_stops_test.py EXECUTABLE RANKS MPIEXEC...
"""

import json
import os
import pathlib
import re
import signal
import sys
import tempfile
import time

import restart_test
import running

# Some thousand steps, of which a run makes a part in a few seconds of wall time.
LONG = running.settings("time.end=5 ms", "time.maximum_step=1 us", "output.interval=2.5 ms", "output.species=[O2]", "particles.description=none")
LIMIT = 3.0  # s
TABLE = "# measured\nr [mm],velocity [m/s]\n0,0.2\n5,{}\n10,0.2\n"


def record_of(out):
    return json.loads((out / "run.json").read_text(encoding="utf-8"))


def check_wall_limit(program, folder, deck):
    """A run stops before its limit, with what the next one goes on from: time after time, on one rank."""
    out = folder / "limited"
    before = 0
    # That all ranks stop together needs no second time.
    for again in ([], ["--restart"]) if program.ranks == 1 else ([],):
        begun = time.monotonic()
        result = program.process_of_its_own("run", deck, *LONG, *running.settings(f"time.wall_limit={LIMIT} s"), "--out", out, *again)
        took = time.monotonic() - begun
        assert result.code == 128 + signal.SIGTERM and len(result.err.splitlines()) == 1, result
        (newest,) = [file for file in (out / "checkpoint").glob("step_*.h5") if file.name == restart_test.checkpoints(out)[-1]]
        assert result.err.startswith("lampblack: stopped by time.wall_limit of 3.00 s at t = "), result.err
        assert f"--restart goes on from {newest}" in result.err, result.err
        # Half of it is used at least; the start of mpirun is not the program's.
        assert LIMIT / 2 < took < LIMIT + (2 if program.ranks > 1 else 0.5), took
        record = record_of(out)
        assert record["status"] == "stopped" and record["steps"] > before, record
        before = record["steps"]
        kept = running.datasets(out / "results.h5.part")
        assert kept["history/step"][-1] == before and len(set(kept["history/step"])) == len(kept["history/step"]) == before, "a row a step"
    # What has stopped ends as what was left alone.
    end = running.settings(f"time.end={record['simulated_time_s'] + 20e-6} s")
    restart_test.run(program, deck, *LONG, *end, "--out", out, "--restart")
    alone = folder / "alone"
    restart_test.run(program, deck, *LONG, *end, "--out", alone)
    found, expected = running.datasets(out / "results.h5"), running.datasets(alone / "results.h5")
    last = max(name for name in expected if name.startswith("steps/")).rsplit("/", 1)[0]
    different = [name for name in expected if name.startswith(last) and found[name].tobytes() != expected[name].tobytes()]
    assert not different, different


def check_lost_rank(program, folder, deck):
    """All ranks are gone soon after one of them, mpirun says so once, and the run goes on from its last checkpoint."""
    out = folder / "lost"
    process = restart_test.start(program, deck, *LONG, *running.settings("checkpoint.steps=5"), "--out", out)
    restart_test.wait_for(lambda: len(restart_test.checkpoints(out)) == 2, process, "second checkpoint")
    ranks = list(map(int, pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()))
    assert len(ranks) == program.ranks, ranks
    os.kill(ranks[-1], signal.SIGKILL)
    begun = time.monotonic()
    _, told = process.communicate(timeout=30)
    while any(is_alive(rank) for rank in ranks):
        assert time.monotonic() - begun < 10, "ranks are left"
        time.sleep(0.05)
    assert process.returncode == 128 + signal.SIGKILL, process.returncode
    assert " ".join(told.split()).count("exited on signal 9 (Killed)") == 1 and "lampblack:" not in told, told
    print(f"{program.ranks} ranks: all gone {time.monotonic() - begun:.2f} s after one")
    newest = out / "checkpoint" / restart_test.checkpoints(out)[-1]
    step = int(re.search("step_([0-9]+)", newest.name).group(1))
    result = restart_test.run(program, deck, *LONG, *running.settings(f"time.end={(step + 10) * 1e-6} s"), "--out", out, "--restart")
    assert f"continues from {newest}" in result.out and record_of(out)["steps"] > step, result.out


def is_alive(process):
    """Not a zombie that nobody has asked for yet."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def check_boundaries(program, folder, deck):
    """A number that is none in a table is refused before the run; one that a formula gives ends it with its last state."""
    text = deck.read_text(encoding="utf-8")
    stream = "velocity: 20 cm/s, temperature: 298 K"
    assert stream in text
    table = deck.with_name("inlet.csv")
    deck.write_text(text.replace(stream, "temperature: 298 K, table: inlet.csv"), encoding="utf-8")
    for none in ("nan", "inf", ""):
        table.write_text(TABLE.format(none), encoding="utf-8")
        result = program("run", deck, "--out", folder / "table")
        assert result.code == 2 and not (folder / "table").exists(), result
        assert f"inlet.csv: line 4: expected a finite number as 'velocity', found '{none}'" in result.err, result.err
    table.write_text(TABLE.format("0.1"), encoding="utf-8")
    restart_test.run(program, deck, *running.settings("time.end=2 us"), "--out", folder / "table")

    formula = '{velocity: "0.2*sqrt(1 - t/5e-6)"}'
    deck.write_text(text.replace(stream, f"temperature: 298 K, formula: {formula}"), encoding="utf-8")
    out = folder / "formula"
    result = program("run", deck, "--out", out)
    assert result.code == 2 and len(result.err.splitlines()) == 1, result
    assert re.match(r"lampblack: boundaries.oxidiser: at \(0.00125, 0.008\) m and t = .* gives no finite number at .*; this was step "
                    r"[0-9]+ from t = .* s, tried with dt = [^,]* s; the fields until then are in ", result.err), result.err
    steps = record_of(out)["steps"]
    assert steps > 0 and restart_test.checkpoints(out) == [f"step_{steps:06}.h5"], result.err
    assert running.datasets(out / "results.h5.part")["history/step"][-1] == steps
    deck.write_text(text, encoding="utf-8")


def main(executable, ranks, *mpiexec):
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        check_boundaries(program, folder, deck)
        check_wall_limit(program, folder, deck)
        if program.ranks > 1:
            # With what mpirun has to say.
            loud = running.Program(executable, list(mpiexec), int(ranks))
            loud.command = [word for word in loud.command if word != "-q"]
            check_lost_rank(loud, folder, deck)
    print("stops: all in order")


if __name__ == "__main__":
    main(*sys.argv[1:])
