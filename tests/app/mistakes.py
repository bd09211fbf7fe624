"""Decks with one mistake each: every one ends in exit code 2 and exactly one message that names the deck and what is wrong."""

import pathlib
import re
import tempfile

import running


def failures_of(program: running.Program, mistakes: list) -> int:
    """How many mistakes are not refused as they should be; what each came to is printed. A mistake: its name, a deck, a text that is
    once in it, what takes its place, and parts of the message."""
    first = mistakes[0][0]

    def check(task: tuple) -> int:
        (name, deck, old, new, expected), also_check = task
        assert deck.count(old) == 1, f"{name}: '{old}' is not once in the deck"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "deck.yaml"
            path.write_text(deck.replace(old, new), encoding="utf-8")
            # The first one as users start the program.
            run = program.process_of_its_own if name == first else program
            result = run("run", path, "--out", pathlib.Path(folder) / "out")
            problems = [] if result.code == 2 else [f"exit code {result.code}"]
            problems += running.differs_from_check(program, result, path) if also_check else []
            lines = result.err.splitlines()
            if not lines or not re.match(rf"lampblack: {re.escape(str(path))}:", lines[0]):
                problems.append("does not start with the deck's name")
            if any(line.startswith("lampblack: ") for line in lines[1:]) or result.out:
                problems.append("says more than one message")
            problems += [f"does not say \"{part}\"" for part in expected if part not in (lines or [""])[0]]
            if (pathlib.Path(folder) / "out").exists():
                problems.append("left something behind")
            print(f"FAILED  {name}: {'; '.join(problems)}\n{result.err}" if problems else f"ok      {name}")
            return 1 if problems else 0

    # All messages on one rank; that only one of several ranks speaks does not need every one of them.
    some = mistakes if program.ranks == 1 else mistakes[::6]
    failures = sum(running.at_once(check, running.thinned(some)))
    print(f"{len(some) - failures} passed, {failures} failed on {program.ranks} rank(s)")
    return failures
