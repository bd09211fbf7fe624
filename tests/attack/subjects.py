"""What is run where a run is to be disturbed: one of each problem that writes now and then for a second or more, and a
study.
"""

import dataclasses
import pathlib

import bases
import deck_text

STUDY = """study: flames
deck: deck.yaml
vary:
  - {key: inlet.equivalence_ratio, values: [0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.3, 1.4]}
"""

# Name, base, changes for a run of a second or two.
DECKS = {
    "flow": ("app/flame", {"time.end": "40 us", "time.maximum_step": "1 us", "output.interval": "4 us", "trajectories.duration": "1 ms"}),
    "flame1d": ("counterflow_ethylene_abf", {"grid": {"slope": "0.2", "curve": "0.3"}}),
    "flame1d in time": ("unsteady_hydrogen", {"unsteady.output_interval": "0.05 ms", "unsteady.end": "5 ms"}),
    "reactor": ("ignition_methane", {"sensitivity": {"of": "ignition_delay", "reactions": ["all"]}}),
    "population_balance": ("soot_families", {"repeats": "20", "methods.dsmc.particles": "2000"}),
    "study": ("free_hydrogen", {}),
}


@dataclasses.dataclass
class Subject:
    name: str
    command: str  # run or sweep
    input: pathlib.Path

    def arguments(self, out: pathlib.Path, *more) -> list:
        return [self.command, self.input, "--out", out, *more]


def prepare(name: str, folder: pathlib.Path) -> Subject:
    """Writes the deck (and study) into a folder."""
    base, changes = DECKS[name]
    deck = folder / "deck.yaml"
    folder.mkdir(parents=True, exist_ok=True)
    deck.write_text(deck_text.write(deck_text.changed(bases.by_name(base).tree, changes)), encoding="utf-8")
    if name != "study":
        return Subject(name, "run", deck)
    study = folder / "study.yaml"
    study.write_text(STUDY, encoding="utf-8")
    return Subject(name, "sweep", study)
