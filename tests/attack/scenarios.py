"""Decks written by hand, each with what has to come of it: mistakes that were once accepted, hung or crashed, and odd
problems that are legitimate.
"""

import dataclasses
import pathlib

import bases
import deck_text
import scenarios_flame
import scenarios_flow
import scenarios_population
import scenarios_reactor
import scenarios_study
from decks import check_and_run
from execution import Limits, Program


@dataclasses.dataclass
class Scenario:
    """A deck by its base and changes; or, of a study, its text."""
    name: str
    base: str
    changes: dict
    expected: str  # a part of "accepted refused numerics", or "" for any orderly end
    problem: str = ""
    files: dict = dataclasses.field(default_factory=dict)  # beside the deck


def all_scenarios() -> list:
    rooms = (scenarios_flow, scenarios_flame, scenarios_reactor, scenarios_population)
    found = [Scenario(*entry) for room in rooms for entry in room.SCENARIOS]
    for entry in scenarios_study.SCENARIOS:
        name, text, expected = entry
        found.append(Scenario(name, "", {"": text}, expected, "study"))
    return found


class Scenarios:
    def __init__(self, program: Program, limits: Limits):
        self.program = program
        self.limits = limits
        self.list = all_scenarios()

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        scenario = self.list[number]
        for name, data in scenario.files.items():
            (folder / name).write_bytes(data)
        ranks = 2 if number % 7 == 3 else 1
        what = f"{scenario.name}, {ranks} rank(s)"
        if scenario.problem == "study":
            text = scenario.changes[""].replace("CASES", str(bases.SOURCE / "cases"))
            verdict = check_and_run(self.program, text, folder, ranks, self.limits, scenario.expected, "sweep")
            return "study", what, verdict
        base = bases.by_name(scenario.base)
        tree = deck_text.changed(base.tree, scenario.changes)
        return base.problem, what, check_and_run(self.program, tree, folder, ranks, self.limits, scenario.expected)
