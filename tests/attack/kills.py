"""Signals at random times: SIGTERM and SIGINT to the run, SIGKILL to the run or one rank, in all problems and studies."""

import pathlib
import random
import signal
import time

import judging
import oracles
import subjects
from execution import SIGKILL_TIMEOUT, STOP_WITHIN, Limits, Program, Run, processes_of, run, send

CODES = {signal.SIGTERM: (143, -signal.SIGTERM), signal.SIGINT: (130, -signal.SIGINT), signal.SIGKILL: (137, -signal.SIGKILL)}


class Kills:
    def __init__(self, program: Program, seed: int, limits: Limits):
        self.program = program
        self.seed = seed
        self.limits = limits
        self.names = list(subjects.DECKS)

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        chance = random.Random(f"kill {self.seed} {number}")
        name = self.names[number % len(self.names)]
        ranks = chance.choice([1, 2])
        which = chance.choice([signal.SIGTERM, signal.SIGTERM, signal.SIGINT, signal.SIGINT, signal.SIGKILL])
        to_rank = which == signal.SIGKILL and chance.random() < 0.5
        subject = subjects.prepare(name, folder)
        out = folder / "out"
        arguments = subject.arguments(out)
        begun = Run(self.program.command(ranks, *arguments), folder, self.limits, "killed", patient=True)
        # As the folder of the run is there, so is the run; the time after that is chance.
        while not (out / "run.json").is_file() and not any(out.glob("*/run.json")) and begun.process.poll() is None:
            time.sleep(0.02)
        time.sleep(chance.uniform(0, 3))
        what = f"{which.name}{' to one rank' if to_rank else ''} in {name} after {time.monotonic() - begun.begin:.1f} s, {ranks} rank(s)"
        if to_rank:
            # mpirun gives the ranks that are left, which wait for the lost one, their seconds twice.
            ranks_wait = 2 * SIGKILL_TIMEOUT if ranks > 1 else 0
            ranks_of = [process for process in processes_of(begun.process.pid) if process != begun.process.pid]
            send(which, ranks_of[-1:] or [begun.process.pid])
            stopped = begun.ends_within(STOP_WITHIN + ranks_wait)
        else:
            stopped = begun.stop(which)
        verdict = self.judge(begun, stopped, which, ranks, out)
        if not verdict.failed:
            again = run(self.program.command(ranks, *subject.arguments(out, "--force")), folder, self.limits, "again")
            fault = oracles.faults_of_results(out) if again.code == 0 else judging.last_line(again.err)
            if again.code != 0 or fault:
                verdict = judging.Verdict(judging.LOST, f"a second run into the folder: exit {again.code}, {fault}")
        return name, what, verdict

    def judge(self, begun: Run, stopped: float | None, which: signal.Signals, ranks: int, out: pathlib.Path):
        if stopped is None:
            begun.finish()
            return judging.Verdict(judging.HANG, "not ended in time after the signal")
        ended = begun.finish()
        if ended.left:
            return judging.Verdict(judging.LEFT, f"{len(ended.left)} processes")
        # A run that was about to end has ended well, whatever mpirun says of itself.
        if ended.code == 0 or (ranks > 1 and f"results in {out}" in ended.out):
            fault = oracles.faults_of_results(out)
            return judging.Verdict(judging.UNSOUND, fault) if fault else judging.Verdict(judging.RAN)
        asked = which != signal.SIGKILL
        # mpirun ends with a code of its own.
        if ended.code not in (*CODES[which], *((1,) if ranks > 1 else ())):
            return judging.Verdict(judging.OTHER_CODE, f"exit {ended.code} after {which.name}")
        words = judging.FOREIGN.search(ended.err)
        lines = [line for line in ended.err.splitlines() if line.startswith("lampblack: ")]
        if asked and (len(lines) != 1 or (words and ranks == 1)):
            return judging.Verdict(judging.MESSAGE, f"{len(lines)} lines{', ' + words[0] if words else ''}: {lines[:2]}")
        fault = oracles.faults_of_remains(out, asked)
        return judging.Verdict(judging.LOST, fault) if fault else judging.Verdict(judging.STOPPED)
