"""Strange decks: random mutations of the shipped ones, checked and then run."""

import pathlib
import random

import bases
import deck_text
import judging
import mutations
import schema as schemas
from execution import Limits, Program, run

PROBLEMS = {"flow": 20, "flame1d": 38, "reactor": 20, "population_balance": 22}


class Decks:
    def __init__(self, program: Program, seed: int, limits: Limits):
        self.program = program
        self.seed = seed
        self.limits = limits
        self.schemas = schemas.of_program(program)
        self.bases = bases.shipped()

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        """Case `number` depends on the seed and on nothing else."""
        chance = random.Random(f"deck {self.seed} {number}")
        problem = chance.choices(list(PROBLEMS), list(PROBLEMS.values()))[0]
        base = chance.choice([base for base in self.bases if base.problem == problem])
        tree, changes = mutations.mutate(base.tree, self.schemas[problem], chance)
        ranks = 2 if chance.random() < 0.12 else 1
        expected = "refused" if any(change.refused for change in changes) and len(changes) == 1 else ""
        what = f"{base.name}, {ranks} rank(s): " + "; ".join(change.what for change in changes)
        return problem, what, check_and_run(self.program, tree, folder, ranks, self.limits, expected)


def check_and_run(program: Program, tree, folder: pathlib.Path, ranks: int, limits: Limits, expected: str = "",
                  command: str = "run") -> judging.Verdict:
    deck = folder / "deck.yaml"
    text = tree if isinstance(tree, (str, bytes)) else deck_text.write(tree)
    deck.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    words = ["sweep", "--check", deck] if command == "sweep" else ["check", deck]
    check = run(program.command(1, *words), folder, limits, "check")
    out = folder / "out"
    ended = run(program.command(ranks, command, deck, "--out", out), folder, limits)
    return judging.judge(check, ended, out, expected)
