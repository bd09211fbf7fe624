"""Full disks: every problem on disks of many sizes, from one page to nearly what the run needs, on one and two ranks.

A disk is a tmpfs in a mount namespace of the run's own, which needs root; its content is copied out when the run ends.
"""

import os
import pathlib
import re
import shutil
import subprocess
import threading

import judging
import oracles
import subjects
from execution import Limits, Program, run

PAGE = 4096
FULL = re.compile(r"disk (is )?full|no space left", re.IGNORECASE)
OF_MPI = re.compile(r"mca_|\[[\w.-]+:\d+\]")
ON_DISK = """mount -t tmpfs -o size="$1" tmpfs "$2" || exit 90
disk="$2" kept="$3"; shift 3
"$@"; code=$?
cp -r "$disk/." "$kept/"
exit $code
"""


def pages(folder: pathlib.Path) -> int:
    """Bytes of disk that a folder takes."""
    return sum(-(-path.stat().st_size // PAGE) * PAGE if path.is_file() else PAGE for path in folder.rglob("*"))


class Disks:
    def __init__(self, program: Program, seed: int, sizes: int, limits: Limits):
        self.program = program
        self.sizes = sizes
        self.limits = limits
        self.names = list(subjects.DECKS)
        self.needed = {}
        self.lock = threading.Lock()
        self.possible = os.geteuid() == 0 and subprocess.run(["unshare", "-m", "true"], check=False).returncode == 0
        self.numbers = range(sizes * len(self.names) * 2 if self.possible else 0)
        if not self.possible:
            print("disks: left out, a mount namespace needs root")

    def measure(self, name: str, folder: pathlib.Path) -> int:
        """Bytes of disk that a whole run takes."""
        with self.lock:
            if name not in self.needed:
                subject = subjects.prepare(name, folder)
                ended = run(self.program.command(1, *subject.arguments(folder / "out")), folder, self.limits)
                if ended.code != 0:
                    raise SystemExit(f"disks: {name} does not even run with room enough: {ended.err}")
                self.needed[name] = pages(folder / "out")
            return self.needed[name]

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        ranks = 1 + number % 2
        name = self.names[number // 2 % len(self.names)]
        step = number // 2 // len(self.names)
        needed = self.measure(name, folder / "measured")
        size = max(PAGE, int(needed * step / self.sizes) // PAGE * PAGE)
        disk, kept = folder / "disk", folder / "kept"
        disk.mkdir()
        kept.mkdir()
        subject = subjects.prepare(name, folder / "deck")
        command = self.program.command(ranks, *subject.arguments(disk / "out"))
        wrapped = ["unshare", "-m", "sh", "-c", ON_DISK, "sh", size, disk, kept, *command]
        ended = run(wrapped, folder, self.limits)
        verdict = self.judge(ended, kept / "out")
        shutil.rmtree(disk, ignore_errors=True)
        return name, f"{name} on {size // 1024} kB of {needed // 1024}, {ranks} rank(s)", verdict

    def judge(self, ended, out: pathlib.Path) -> judging.Verdict:
        # Open MPI says on its own what its writing met.
        ended.err = "".join(line for line in ended.err.splitlines(keepends=True) if not OF_MPI.match(line))
        fault = judging.common_faults(ended)
        if fault:
            return fault
        if ended.code == 0:
            fault = oracles.faults_of_results(out)
            return judging.Verdict(judging.UNSOUND, fault) if fault else judging.Verdict(judging.RAN)
        said = judging.last_line(ended.err)
        if ended.code != 3:
            return judging.Verdict(judging.OTHER_CODE, f"exit {ended.code}: {said}")
        if not FULL.search(said):
            return judging.Verdict(judging.MESSAGE, f"does not say that the disk is full: {said}")
        fault = oracles.faults_of_remains(out)
        return judging.Verdict(judging.LOST, fault) if fault else judging.Verdict(judging.NUMERICS, said)
