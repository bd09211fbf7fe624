"""Damaged files of every kind that is read: mechanisms, decks, profiles, results to start from, studies, cells to replay,
and results for the scripts that draw them.
"""

import pathlib
import random
import re
import shutil
import threading

import bases
import deck_text
import judging
from damage import damage
from deck_text import REMOVE
from execution import Limits, Program, run

CORPUS = bases.SOURCE / "tests/fuzz/corpus"
PLOT = bases.SOURCE / "scripts/plot"
DRAWN = {"flow": "app/flame", "flame1d": "free_hydrogen", "branch": "extinction_hydrogen",
         "reactor": "ignition_hydrogen", "population_balance": "soot_growth"}
STUDY = "study: flames\ndeck: deck.yaml\nvary:\n  - {key: inlet.equivalence_ratio, values: [1, 1.2]}\ncollect: {results: [points]}\n"
STUDY_FILES = ("study.csv", "study.json")
ROWS = b"# z, T\nz,T\n0,298\n0.001,1000\n0.01,1600\n0.03,1500\n"


class Damaged:
    def __init__(self, program: Program, seed: int, limits: Limits, originals: pathlib.Path):
        self.program = program
        self.seed = seed
        self.limits = limits
        self.originals = originals
        self.lock = threading.Lock()
        shutil.rmtree(originals, ignore_errors=True)
        self.subjects = {"mechanism": self.mechanism, "CHEMKIN": self.chemkin, "deck": self.deck, "profile": self.profile,
                         "initial": self.initial, "study": self.study, "replay": self.replay, "results drawn": self.drawn}

    def original(self, name: str) -> pathlib.Path:
        """The folder of results that are whole, to be damaged; made when first asked for."""
        folder = self.originals / name
        with self.lock:
            if (folder / "out").exists():
                return folder / "out"
            if name == "study":
                self.write_deck(folder, bases.by_name("free_hydrogen").tree)
                (folder / "study.yaml").write_text(STUDY, encoding="utf-8")
                self.must(0, folder, "sweep", folder / "study.yaml", "--out", folder / "out")
            elif name == "replay":
                # More than double precision has: the cell that fails is kept for a replay.
                too_much = {"chemistry": {"relative_tolerance": "1e-18", "absolute_tolerance": "1e-40"}}
                self.write_deck(folder, deck_text.changed(bases.by_name("app/flame").tree, too_much))
                self.must(3, folder, "run", folder / "deck.yaml", "--out", folder / "out")
            else:
                self.write_deck(folder, bases.by_name(DRAWN[name]).tree)
                self.must(0, folder, "run", folder / "deck.yaml", "--out", folder / "out")
        return folder / "out"

    def must(self, code: int, folder: pathlib.Path, *words) -> None:
        ended = run(self.program.command(1, *words), folder, self.limits)
        if ended.code != code:
            raise SystemExit(f"damaged: cannot prepare {folder}: exit {ended.code}\n{ended.err}")

    @staticmethod
    def write_deck(folder: pathlib.Path, tree) -> pathlib.Path:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "deck.yaml").write_text(deck_text.write(tree), encoding="utf-8")
        return folder / "deck.yaml"

    def __call__(self, number: int, folder: pathlib.Path) -> tuple:
        chance = random.Random(f"damage {self.seed} {number}")
        name = list(self.subjects)[number % len(self.subjects)]
        what, verdict = self.subjects[name](folder, chance)
        return name, what, verdict

    def judge(self, folder: pathlib.Path, words: tuple, refused: bool, ranks: int = 1) -> judging.Verdict:
        """A command that reads the file and leaves nothing where it refuses it."""
        out = folder / "out"
        ended = run(self.program.command(ranks, *words), folder, self.limits)
        fault = judging.common_faults(ended)
        if fault:
            return fault
        if ended.code == 2 and out.exists():
            return judging.Verdict(judging.LEFT, "the folder of the run")
        if refused and ended.code != 2:
            return judging.Verdict(judging.ACCEPTED if ended.code == 0 else judging.OTHER_CODE, judging.last_line(ended.err))
        outcome = {0: judging.RAN, 2: judging.REFUSED, 3: judging.NUMERICS}[ended.code]
        return judging.Verdict(outcome, judging.last_line(ended.err))

    def ran(self, tree, folder: pathlib.Path, refused: bool, chance: random.Random) -> judging.Verdict:
        deck = self.write_deck(folder, tree)
        return self.judge(folder, ("run", deck, "--out", folder / "out"), refused, chance.choice([1, 1, 1, 2]))

    def mechanism(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        file = folder / "mechanism.yaml"
        shutil.copyfile(bases.MECHANISMS / "hydrogen_h2o2_10.yaml", file)
        what, refused = damage(file, chance)
        tree = deck_text.changed(bases.by_name("ignition_hydrogen").tree, {"mechanism": "mechanism.yaml", "sensitivity": REMOVE})
        return what, self.ran(tree, folder, refused, chance)

    def chemkin(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        text = (CORPUS / "chemkin/three_files.txt").read_bytes()
        files = [folder / name for name in ("chem.inp", "therm.dat", "tran.dat")]
        for file, part in zip(files, text.split(b"\n!====\n")):
            file.write_bytes(part)
        chosen = chance.choice(files)
        what, refused = damage(chosen, chance)
        words = ("mechanism", *files, "--output", folder / "converted.yaml")
        return f"{chosen.name}: {what}", self.judge(folder, words, refused)

    def deck(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        base = chance.choice([base for base in bases.shipped() if base.problem != "flow"])
        file = self.write_deck(folder, base.tree)
        what, refused = damage(file, chance)
        return f"{base.name}: {what}", self.judge(folder, ("run", file, "--out", folder / "out"), refused)

    def profile(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        (folder / "profile.csv").write_bytes(ROWS)
        what, refused = damage(folder / "profile.csv", chance)
        changes = {"temperature_profile": {"file": "profile.csv"}, "particles": REMOVE}
        return what, self.ran(deck_text.changed(bases.by_name("two_equation_dimer").tree, changes), folder, refused, chance)

    def initial(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        shutil.copyfile(self.original("flame1d") / "results.h5", folder / "earlier.h5")
        what, refused = damage(folder / "earlier.h5", chance)
        tree = deck_text.changed(bases.by_name("free_hydrogen").tree, {"initial": "earlier.h5"})
        return what, self.ran(tree, folder, refused, chance)

    def study(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        self.write_deck(folder, bases.by_name("free_hydrogen").tree)
        (folder / "study.yaml").write_text(STUDY, encoding="utf-8")
        chosen = chance.choice(["study.yaml", "study.yaml", "deck.yaml"])
        what, refused = damage(folder / chosen, chance)
        return f"{chosen}: {what}", self.judge(folder, ("sweep", folder / "study.yaml", "--out", folder / "out"), refused)

    def replay(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        file = folder / "cell.yaml"
        shutil.copyfile(next(self.original("replay").glob("failed_cell_*.yaml")), file)
        what, refused = damage(file, chance)
        return what, self.judge(folder, ("replay", file), refused)

    def drawn(self, folder: pathlib.Path, chance: random.Random) -> tuple:
        name = chance.choice([*DRAWN, "study"])
        out = folder / "results"
        shutil.copytree(self.original(name), out, symlinks=True)
        files = [path for path in sorted(out.rglob("*")) if path.is_file() and path.suffix in (".h5", ".csv", ".json", ".xdmf")]
        chosen = chance.choice([*files, *[path for path in files if path.suffix == ".h5" or path.name in STUDY_FILES] * 3])
        what, _ = damage(chosen, chance)
        ended = run([PLOT, out], folder, self.limits)
        what = f"{name}, {chosen.relative_to(out)}: {what}"
        if ended.over_time:
            return what, judging.Verdict(judging.HANG, f"after {ended.seconds:.0f} s")
        if ended.signal:
            return what, judging.Verdict(judging.CRASH, f"signal {ended.signal}")
        if "Traceback" in ended.err or len(ended.err.splitlines()) > 3 or re.search("warning", ended.err, re.IGNORECASE):
            return what, judging.Verdict(judging.MESSAGE, judging.last_line(ended.err))
        if ended.code not in (0, 2):
            return what, judging.Verdict(judging.OTHER_CODE, f"exit {ended.code}: {judging.last_line(ended.err)}")
        return what, judging.Verdict(judging.RAN if ended.code == 0 else judging.REFUSED, judging.last_line(ended.err))
