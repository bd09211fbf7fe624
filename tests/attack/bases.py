"""The decks that are spoilt: all that are shipped, shortened by the settings of .ci/smoke and by some more, so that one
takes a second or a few; the mechanisms and other files they name by absolute paths.
"""

import dataclasses
import functools
import pathlib

import deck_text

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MECHANISMS = SOURCE / "cases/mechanisms"

# Beyond the settings of .ci/smoke: what makes one of many runs short.
SHORTER = {
    "counterflow_ethylene": ["mesh.refinement=0.25", "time.end=0.05 ms", "output.interval=0.02 ms",
                             "trajectories.duration=1 ms", "trajectories.particles=64"],
    "population_balance": ["repeats=2"],
    "isf_premixed": ["grid.slope=0.5", "grid.curve=0.7"],
    "counterflow_ethylene_soot": ["grid.slope=0.5", "grid.curve=0.7"],
}
FILES = ("mechanism", "initial", "file")


@dataclasses.dataclass
class Base:
    name: str
    problem: str
    tree: dict


def absolute(tree, folder: pathlib.Path) -> None:
    """Makes the names of files in a tree absolute."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in items:
        if isinstance(value, (dict, list)):
            absolute(value, folder)
        elif key in FILES and isinstance(value, str):
            # The deck of the tests is meant to be copied beside a folder of mechanisms.
            files = [folder / value, MECHANISMS / pathlib.Path(value).name]
            tree[key] = next((str(file.resolve()) for file in files if file.is_file()), value)


def settings(case: str, name: str) -> list:
    lines = []
    for word in dict.fromkeys((case, name)):
        file = SOURCE / ".ci/smoke" / f"{word}.txt"
        if file.is_file():
            lines += [line for line in file.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
        lines += SHORTER.get(word, [])
    return lines


def load(path: pathlib.Path) -> Base:
    tree = deck_text.read(path)
    case = path.parent.name
    name = case if path.stem == "deck" else path.stem
    absolute(tree, path.parent)
    for line in settings(case, name):
        deck_text.put(tree, *deck_text.from_setting(line))
    return Base(name if name == case else f"{case}/{name}", tree["problem"], tree)


def is_deck(path: pathlib.Path) -> bool:
    return path.parent.name != "mechanisms" and "problem:" in path.read_text(encoding="utf-8")


@functools.cache
def shipped() -> list:
    """All decks of cases/ and the small flow of the tests, in a fixed order."""
    paths = [path for path in sorted((SOURCE / "cases").rglob("*.yaml")) if is_deck(path)]
    return [load(path) for path in paths] + [load(SOURCE / "tests/app/flame.yaml")]


def by_name(name: str) -> Base:
    return next(base for base in shipped() if base.name in (name, f"population_balance/{name}", f"isf_premixed/{name}"))
