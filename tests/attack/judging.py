"""What became of an input: names of outcomes, and which of them are failures."""

import dataclasses
import json
import pathlib
import re

import oracles
from execution import Ended

# What may come of a strange input.
RAN = "ran to its end"
REFUSED = "refused with one message (exit 2)"
NUMERICS = "numerics, with one message (exit 3)"
STOPPED = "stopped by the signal, with something to go on from"
LONG = "long: stopped at the limit of time, with progress until then"
FINE = (RAN, REFUSED, NUMERICS, STOPPED, LONG)

# What may not.
BUG = "called a bug (exit 1)"
CRASH = "ended by a signal"
HANG = "hung"
LATE = "accepted by check, refused by run"
INCONSISTENT = "refused by check, accepted by run"
LEFT = "refused, but left files or processes"
MESSAGE = "not exactly one message that says where"
ACCEPTED = "accepted, though wrong"
WRONGLY_REFUSED = "refused, though right"
UNSOUND = "accepted, with results that are not sound"
OTHER_CODE = "another exit code than agreed"
LOST = "nothing usable left"
BAD = (CRASH, HANG, BUG, ACCEPTED, UNSOUND, LATE, INCONSISTENT, LEFT, MESSAGE, WRONGLY_REFUSED, OTHER_CODE, LOST)

LONGEST_LINE = 1000  # characters: a state that failed is told with its mass fractions
MOST_LINES = 3  # that go on with a message
QUOTE = re.compile(r"^ *(\d+|--set)? \| ")
# Mistakes of a deck are told together, each with its place.
OF_DECK = re.compile(r"^(\S.*\.ya?ml(:\d+:\d+)?: |--set |these are \d+ mistakes)")
WARNING = "lampblack: warning: "
PLACE = re.compile(r":\d+:|--\w+|runs failed|[\w*]+(\.[\w*\[\]]+)+|: ")
FOREIGN = re.compile(r"Traceback|terminate called|PETSC ERROR|HDF5-DIAG|Segmentation|MPI_ABORT|std::|bad_alloc|vector::",
                     re.IGNORECASE)


@dataclasses.dataclass
class Verdict:
    outcome: str
    why: str = ""

    @property
    def failed(self) -> bool:
        return self.outcome not in FINE


def faults_of_message(err: str) -> str:
    """What is wrong with the message of a run that ended with 2 or 3: "" where nothing is."""
    lines = [line for line in err.split("\n") if line.strip() and not line.startswith(WARNING)]
    if not lines or not lines[0].startswith("lampblack: "):
        return f"the first line is no message: {(lines or [''])[0][:100]!r}"
    if FOREIGN.search(err):
        return f"words of a library: {FOREIGN.search(err)[0]}"
    more = [line for line in lines[1:] if not QUOTE.match(line)]
    if OF_DECK.match(lines[0][len("lampblack: "):]):
        more = [line for line in more if not OF_DECK.match(line)]
    if any(line.startswith("lampblack: ") for line in more) or len(more) > MOST_LINES:
        return f"more than one message: {more[0][:100]!r}"
    if max(map(len, lines)) > LONGEST_LINE:
        return f"a line of {max(map(len, lines))} characters"
    return "" if PLACE.search(lines[0][len("lampblack: "):]) else f"names no place: {lines[0][:100]!r}"


def common_faults(ended: Ended) -> Verdict | None:
    """What no run may do, whatever its input was."""
    if ended.over_time:
        if ended.stopped_in is None:
            return Verdict(HANG, "and SIGTERM does not end it")
        if ended.hung:
            return Verdict(HANG, f"silent for {ended.silent:.0f} s")
        return Verdict(LONG)
    if ended.left:
        return Verdict(LEFT, f"{len(ended.left)} processes")
    if ended.signal or ended.code < 0:
        return Verdict(CRASH, f"signal {ended.signal}: {last_line(ended.err)}")
    if ended.code not in (0, 2, 3):
        return Verdict(BUG, f"exit {ended.code}: {last_line(ended.err)}")
    if ended.code != 0:
        fault = faults_of_message(ended.err)
        return Verdict(MESSAGE, fault) if fault else None
    return None


def last_line(text: str) -> str:
    lines = [line for line in text.splitlines() if line.strip()]
    message = [line for line in lines if line.startswith("lampblack: ")]
    return (message or lines or [""])[-1][:200]


def judge(check: Ended | None, run: Ended, out: pathlib.Path, expected: str = "") -> Verdict:
    """The outcome of a deck; `expected` is "", "accepted", "refused", "numerics" or "refused or numerics"."""
    for ended in (check, run):
        fault = common_faults(ended) if ended else None
        if fault:
            if ended is check:
                fault = Verdict(HANG if fault.outcome == LONG else fault.outcome, f"check: {fault.why}")
            elif fault.outcome == LONG and expected == "refused":
                fault = Verdict(ACCEPTED, "expected: refused; it goes on")
            return fault
    if check and check.code == 0 and run.code == 2:
        return Verdict(LATE, last_line(run.err))
    if check and check.code != 0 and run.code != check.code:
        return Verdict(INCONSISTENT, last_line(check.err))
    if run.code == 2 and out.exists():
        return Verdict(LEFT, f"{out.name}: {', '.join(sorted(path.name for path in out.iterdir())) or 'an empty folder'}")
    got = {0: "accepted", 2: "refused", 3: "numerics"}[run.code]
    if expected and got not in expected:
        said = last_line(run.err)
        return Verdict(ACCEPTED, f"expected: {expected}") if got == "accepted" else \
            Verdict(WRONGLY_REFUSED, f"expected: {expected}, found {got}: {said}")
    if run.code == 0:
        fault = oracles.faults_of_results(out)
        return Verdict(UNSOUND, fault) if fault else Verdict(RAN)
    if run.code == 3 and (out / "run.json").is_file():
        status = json.loads((out / "run.json").read_text(encoding="utf-8"))["status"]
        if status == "running":
            return Verdict(UNSOUND, "run.json says running after exit 3")
    return Verdict(REFUSED if run.code == 2 else NUMERICS, last_line(run.err))
