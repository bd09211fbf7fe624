"""A flow that is killed again and again, at random moments, while it writes outputs and checkpoints too: it goes on from its last
whole checkpoint each time, and in the end its results are those of a run that was left alone, to the last bit.

Usage: restart_kill_test.py EXECUTABLE RANKS KILLS WHAT MPIEXEC...
WHAT: gas, the tests' own flame; ensembles, the same with an ensemble of soot in each cell.
"""

import os
import pathlib
import random
import signal
import sys
import tempfile
import time

import restart_test
import running

# A checkpoint after each step, an output after every other: a third of the time is spent on writing.
SETTINGS = {
    "gas": running.settings("time.end=0.12 ms", "time.maximum_step=1 us", "output.interval=2 us", "checkpoint.steps=1"),
    "ensembles": running.settings("time.end=0.12 ms", "time.maximum_step=2 us", "output.interval=4 us", "checkpoint.steps=1",
                                  "particles={description: ensemble, number: 40, minimum_number_density: 1e9 1/m^3, averaging_time: 10 us}"),
}


def processes(program, process):
    """The program's own and mpirun's."""
    if program.ranks == 1:
        return [process.pid]
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
    return [*map(int, children), process.pid]


def kill(program, process):
    for pid in processes(program, process):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.communicate(timeout=60)


def interrupt(program, deck, settings, out, chance):
    """Starts or goes on, and kills at a random moment. Whether it was killed before its end."""
    again = ["--restart"] if restart_test.checkpoints(out) else ["--force"]
    process = restart_test.start(program, deck, *settings, "--out", out, *again)
    if chance.random() < 0.2:  # while it starts, reads the checkpoint, or restores what was written
        delay = chance.uniform(0.0, 1.0)
    else:  # while it goes on
        before = restart_test.checkpoints(out)
        for _ in range(6000):
            if restart_test.checkpoints(out) != before or process.poll() is not None:
                break
            time.sleep(0.005)
        delay = chance.uniform(0.0, 0.3)
    end = time.monotonic() + delay
    while time.monotonic() < end and process.poll() is None:
        time.sleep(0.001)
    if process.poll() is None:
        kill(program, process)
        return True
    _, told = process.communicate()
    assert process.returncode == 0, told
    return False


def main(executable, ranks, kills, what, *mpiexec):
    settings = SETTINGS[what]
    if int(kills) < 10:  # some twenty steps a kill
        settings = [*settings, *running.settings("time.end=0.06 ms")]
    program = running.Program(executable, list(mpiexec), int(ranks))
    chance = random.Random(7)
    killed = whole_runs = in_checkpoint = damaged = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        alone = folder / "alone"
        restart_test.run(program, deck, *settings, "--out", alone)
        out = folder / "killed"
        while killed < int(kills):
            if interrupt(program, deck, settings, out, chance):
                killed += 1
                in_checkpoint += any(file.suffix == ".part" for file in out.glob("checkpoint/*"))
                part = out / "results.h5.part"
                try:
                    damaged += part.exists() and not running.datasets(part)
                except (OSError, RuntimeError):
                    damaged += 1
            else:
                restart_test.assert_equal(out, alone)
                whole_runs += 1
                for file in out.glob("checkpoint/*"):
                    file.unlink()
        restart_test.run(program, deck, *settings, "--out", out, "--restart" if restart_test.checkpoints(out) else "--force")
        restart_test.assert_equal(out, alone)
    print(f"{killed} kills, {in_checkpoint} of them while a checkpoint or its outputs were written, {damaged} left results that "
          f"cannot be read; {whole_runs + 1} runs ended, all as the one that was left alone")


if __name__ == "__main__":
    main(*sys.argv[1:])
