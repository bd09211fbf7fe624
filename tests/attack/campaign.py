"""A part of the attack: its cases, done some at a time, with what failed kept and all counted."""

import collections
import concurrent.futures
import dataclasses
import json
import pathlib
import shutil
import sys
import threading
import time

import judging


@dataclasses.dataclass
class Done:
    part: str
    number: int
    group: str  # the problem, or what was damaged
    what: str
    verdict: judging.Verdict
    seconds: float


class Campaign:
    """Runs numbered cases. `work(number, folder)` gives (group, what was done, verdict)."""

    def __init__(self, folder: pathlib.Path, jobs: int, only: set):
        self.folder = folder
        self.jobs = jobs
        self.only = only  # of (part, number); empty: all
        self.done = []
        self.lock = threading.Lock()

    def carry_out(self, part: str, numbers, work) -> None:
        numbers = [number for number in numbers if not self.only or (part, number) in self.only]
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(lambda number: self.one(part, number, work), numbers))

    def one(self, part: str, number: int, work) -> None:
        folder = self.folder / f"{part}-{number}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        begin = time.monotonic()
        group, what, verdict = work(number, folder)
        done = Done(part, number, group, what, verdict, time.monotonic() - begin)
        (folder / "case.json").write_text(json.dumps(dataclasses.asdict(done), indent=1) + "\n", encoding="utf-8")
        with self.lock:
            self.done.append(done)
            if verdict.failed or self.only:
                print(f"{part}:{number} {group}: {what}\n    {verdict.outcome}: {verdict.why}\n    in {folder}")
            sys.stdout.flush()
        # What failed stays to be looked at.
        if not verdict.failed and not self.only:
            shutil.rmtree(folder, ignore_errors=True)

    @property
    def failures(self) -> int:
        return sum(done.verdict.failed for done in self.done)

    def table(self) -> str:
        """Counts by part, group and outcome, as Markdown."""
        outcomes = [outcome for outcome in (*judging.FINE, *judging.BAD)
                    if any(done.verdict.outcome == outcome for done in self.done)]
        counts = collections.Counter((done.part, done.group, done.verdict.outcome) for done in self.done)
        rows = sorted({(done.part, done.group) for done in self.done}, key=lambda row: (PARTS.index(row[0]), row[1]))
        lines = ["| part | of | number | " + " | ".join(outcomes) + " |", "|---|---|" + "---|" * (1 + len(outcomes))]
        for part, group in rows:
            numbers = [counts[part, group, outcome] for outcome in outcomes]
            lines.append(f"| {part} | {group} | {sum(numbers)} | " + " | ".join(map(str, numbers)) + " |")
        totals = [sum(counts[part, group, outcome] for part, group in rows) for outcome in outcomes]
        lines.append(f"| all | | {sum(totals)} | " + " | ".join(map(str, totals)) + " |")
        return "\n".join(lines)


PARTS = ["scenarios", "decks", "disks", "kills", "damaged"]
