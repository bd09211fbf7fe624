"""Inputs written by hand, each with what has to come of it: mistakes that were once accepted, hung or crashed, and odd
problems that are legitimate. What is expected is a part of "accepted refused numerics", or "" for any orderly end.
"""

import dataclasses
import pathlib

import bases
import deck_text
import judging
import scenarios_command
import scenarios_flame
import scenarios_flow
import scenarios_population
import scenarios_reactor
import scenarios_study
import scenarios_text
from decks import check_and_run
from execution import Limits, Program, run

# What reads a deck of any text has to be done with it soon.
QUICK = Limits(time=5, silence=4)


class Scenarios:
    """All of them in a fixed order; each is (group, name, what does it in a folder on some ranks)."""

    def __init__(self, program: Program, limits: Limits):
        self.program = program
        self.limits = limits
        self.quick = dataclasses.replace(QUICK, memory=limits.memory)
        self.list = []
        for module in (scenarios_flow, scenarios_flame, scenarios_reactor, scenarios_population):
            self.list += [self.deck(*scenario) for scenario in module.SCENARIOS]
        self.list += [self.study(*scenario) for scenario in scenarios_study.SCENARIOS]
        self.list += [self.text(*scenario) for scenario in scenarios_text.SCENARIOS]
        self.list += [self.command(*scenario) for scenario in scenarios_command.SCENARIOS]

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        group, name, work = self.list[number]
        ranks = 2 if number % 7 == 3 else 1
        return group, f"{name}, {ranks} rank(s)", work(folder, ranks)

    def deck(self, name: str, base: str, changes: dict, expected: str, files: dict | None = None) -> tuple:
        """A shipped deck with changes, and files beside it."""
        known = bases.by_name(base)

        def work(folder: pathlib.Path, ranks: int) -> judging.Verdict:
            for file, data in (files or {}).items():
                (folder / file).write_bytes(data)
            tree = deck_text.changed(known.tree, changes)
            return check_and_run(self.program, tree, folder, ranks, self.limits, expected)

        return known.problem, name, work

    def study(self, name: str, text: str, expected: str) -> tuple:
        def work(folder: pathlib.Path, ranks: int) -> judging.Verdict:
            return check_and_run(self.program, placed(text, folder), folder, ranks, self.limits, expected, "sweep")

        return "study", name, work

    def text(self, name: str, make, expected: str) -> tuple:
        """A deck as text: `make` spoils that of a reactor."""
        def work(folder: pathlib.Path, ranks: int) -> judging.Verdict:
            text = make(deck_text.write(bases.by_name("stirred_methane").tree))
            return check_and_run(self.program, text, folder, ranks, self.quick, expected)

        return "text of a deck", name, work

    def command(self, name: str, words: list, expected: str) -> tuple:
        """A command line; the words name a deck and places by DECK, STUDY, CASES and FOLDER."""
        def work(folder: pathlib.Path, ranks: int) -> judging.Verdict:
            (folder / "deck.yaml").write_text(deck_text.write(bases.by_name("ignition_hydrogen").tree), encoding="utf-8")
            scenarios_command.prepare(folder)
            line = self.program.command(ranks, *[placed(word, folder) for word in words])
            ended = run(line, folder, self.quick)
            fault = judging.common_faults(ended)
            if fault:
                return fault
            got = {0: "accepted", 2: "refused", 3: "numerics"}[ended.code]
            if got not in (expected or got):
                wrong = judging.ACCEPTED if ended.code == 0 else judging.WRONGLY_REFUSED
                return judging.Verdict(wrong, f"expected: {expected}, found {got}: {judging.last_line(ended.err)}")
            outcome = {0: judging.RAN, 2: judging.REFUSED, 3: judging.NUMERICS}[ended.code]
            return judging.Verdict(outcome, judging.last_line(ended.err))

        return "command line", name, work


def placed(text: str, folder: pathlib.Path) -> str:
    for word, path in (("CASES", bases.SOURCE / "cases"), ("DECK", folder / "deck.yaml"), ("FOLDER", folder)):
        text = text.replace(word, str(path))
    return text
