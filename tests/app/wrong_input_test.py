"""Every way in which a run's input can be wrong ends in exit code 2 and exactly one message, and leaves no trace.

Usage: wrong_input_test.py EXECUTABLE RANKS MPIEXEC...

The message names the place (file, line, key) and what was expected. Nothing else is printed, no folder is made, and a
folder that holds another run stays as it is, to the last byte and time stamp.
"""

import dataclasses
import json
import pathlib
import re
import sys
import tempfile

import running

MECHANISM_KEY = f"mechanism: ../mechanisms/{running.MECHANISM}"
SOOT = "particles:\n  description: two_equation_dimer\n  pah: [A2]\n"
LONGEST = 1100  # letters of a line
# A line of the deck under a message, or the mark below it.
QUOTE = re.compile(r"^ *(\d+|--set)? \| ")


@dataclasses.dataclass
class Wrong:
    """One mistake: an edit of the deck (or settings), the line (a text in it) and key it is in, and what to be told."""
    name: str
    old: str = ""
    new: str = ""
    at: str = ""
    key: str = ""
    expected: tuple = ()
    settings: tuple = ()


MISTAKES = [
    Wrong("unknown key", "  geometry: axisymmetric", "  geometri: axisymmetric", "geometri:", "mesh.geometri",
          ("unknown key 'geometri'", "did you mean 'geometry'?")),
    Wrong("unknown boundary key", "    velocity: 20", "    velocty: 20", "velocty", "boundaries.fuel.velocty",
          ("did you mean 'velocity'?",)),
    Wrong("repeated key", "pressure: 1 atm", "pressure: 1 atm\npressure: 2 atm", "pressure: 2 atm", "pressure",
          ("line",)),
    Wrong("wrong unit", "  end: 10 us", "  end: 50 mm", "end: 50 mm", "time.end",
          ("expected a time", "found '50 mm', a length")),
    Wrong("word for a number", "  courant: 0.5", "  courant: half", "courant: half", "time.courant",
          ("expected a plain number", "found 'half'")),
    Wrong("unknown species in a composition", "\"C2H4: 1\"", "\"C2H4X: 1\"", "C2H4X", "boundaries.fuel.composition",
          ("unknown species 'C2H4X'", "nearest", "'C2H4'")),
    Wrong("missing composition", "    composition: \"C2H4: 1\"\n", "", "  fuel:", "boundaries.fuel",
          ("inlet needs the key 'composition'",)),
    Wrong("empty composition", "\"C2H4: 1\"", "\"\"", "composition: \"\"", "boundaries.fuel.composition"),
    Wrong("unknown species in the output", "species: [all]", "species: [OHH]", "OHH", "output.species",
          ("unknown species 'OHH'", "'OH'")),
    Wrong("unknown PAH", "pah: [A2]", "pah: [A22]", "A22", "particles.pah", ("unknown species 'A22'", "'A2'")),
    Wrong("negative temperature", "299 K", "-5 K", "-5 K", "boundaries.fuel.temperature",
          ("expected a temperature from 100 to 6000 K", "found '-5 K'")),
    Wrong("temperature beyond the gas data", "299 K", "9000 K", "9000 K", "boundaries.fuel.temperature",
          ("expected", "9000 K")),
    Wrong("missing mechanism", MECHANISM_KEY, "mechanism: nowhere.yaml", "nowhere", "mechanism",
          ("nowhere.yaml: there is no such file; expected a mechanism",)),
    Wrong("garbage mechanism", MECHANISM_KEY, "mechanism: garbage.yaml", "garbage", "mechanism",
          ("garbage.yaml:2: not valid YAML",)),
    Wrong("binary mechanism", MECHANISM_KEY, "mechanism: binary.yaml", "binary", "mechanism", ("binary.yaml",)),
    Wrong("mechanism of something else", MECHANISM_KEY, "mechanism: deck.yaml", "mechanism: deck", "mechanism",
          ("no 'phases'",)),
    Wrong("zero cells", "{to: 10 mm, cells: 4}", "{to: 10 mm, cells: 0}", "cells: 0", "mesh.r[0].cells",
          ("expected an integer at least 1", "found '0'")),
    Wrong("no cells along an axis", "  r:\n    - {to: 10 mm, cells: 4}\n    - {to: 14 mm, cells: 2}\n",
          "", "mesh:", "mesh", ("no cells along r",)),
    Wrong("segments backwards", "{to: 14 mm", "{to: 9 mm", "  r:", "mesh.r"),
    Wrong("boundary faces without a patch", "    to: 10 mm", "    to: 5 mm", "boundaries:",
          "boundaries", ("the side z-min belongs to no boundary from 0.005 to 0.01 m",)),
    Wrong("gravity through the axis", "initial:\n", "gravity: {r: 1 m/s^2}\ninitial:\n", "r: 1 m/s^2", "gravity.r",
          ("gravity would point through 'axis', where the flow is symmetric",)),
    Wrong("gravity along an axis of another mesh", "initial:\n", "gravity: {x: 1 m/s^2}\ninitial:\n", "x: 1 m/s^2", "gravity.x",
          ("the axes of this mesh are r and z",)),
    Wrong("layer without a stream", "  low: fuel\n", "", "initial:", "initial", ("a layer needs the key 'low'",)),
    Wrong("composition on a wall", "{type: outlet, side: r-max, temperature: 298 K,", "{type: wall, side: r-max,",
          "{type: wall, side: r-max,", "boundaries.outflow.composition",
          ("'boundaries.outflow.type: wall' does not have this; leave it out, or choose: inlet, outlet",)),
    Wrong("velocity of an outlet", "{type: outlet,", "{type: outlet, velocity: 1 m/s,", "{type: outlet, velocity",
          "boundaries.outflow.velocity", ("'boundaries.outflow.type: outlet' does not have this", "choose: inlet")),
    Wrong("slip of an inlet", "    velocity: 20", "    slip: true\n    velocity: 20", "slip: true",
          "boundaries.fuel.slip", ("choose: wall",)),
    Wrong("temperature of the axis", "{type: symmetry,", "{type: symmetry, temperature: 300 K,", "{type: symmetry,",
          "boundaries.axis.temperature", ("choose: inlet, outlet, wall",)),
    Wrong("inlet on the axis", "{type: symmetry, side: r-min}",
          "{type: inlet, side: r-min, velocity: 1 m/s, temperature: 300 K, composition: \"N2: 1\"}", "side: r-min",
          "boundaries.axis.type", ("r-min is the axis", "expected symmetry, found inlet")),
    Wrong("overlapping boundaries", "side: z-min, from: 10 mm", "side: z-min, from: 5 mm", "  fuel_flange:",
          "boundaries.fuel_flange", ("overlaps the boundary 'fuel' on the side z-min from 0.005 to 0.01 m",)),
    Wrong("one boundary over another", "side: z-max, from: 10 mm}", "side: z-max}", "  oxidiser_flange:",
          "boundaries.oxidiser_flange", ("overlaps the boundary 'oxidiser' on the side z-max from 0 to 0.01 m",)),
    Wrong("boundary beyond its side", "side: z-min, from: 10 mm}", "side: z-min, from: 10 mm, to: 15 mm}", "to: 15 mm",
          "boundaries.fuel_flange.to", ("the side z-min goes from 0 to 0.014 m, found 0.015 m",)),
    Wrong("boundary before its side", "    to: 10 mm", "    from: -1 mm\n    to: 10 mm", "from: -1", "boundaries.fuel.from",
          ("goes from 0 to 0.014 m",)),
    Wrong("boundary backwards", "    to: 10 mm", "    from: 12 mm\n    to: 10 mm", "  fuel:", "boundaries.fuel",
          ("expected 'from' below 'to'",)),
    Wrong("boundary between two faces", "  axis: {",
          "  slit: {type: wall, side: r-max, to: 0.2 mm}\n  axis: {", "  slit:", "boundaries.slit",
          ("no face of the mesh has its centre between",)),
    Wrong("colder than the data", "299 K", "199 K", "199 K", "boundaries.fuel.temperature",
          ("expected a temperature from 200 to 4000 K", "transport data of ethylene_bisetti2012_47.yaml", "found 199 K")),
    Wrong("hot start beyond the data", "  width: 2 mm", "  width: 2 mm\n  temperature: 4001 K", "4001 K",
          "initial.temperature", ("from 200 to 4000 K",)),
    Wrong("faster than the equations", "    velocity: 20 cm/s", "    velocity: 110 m/s", "velocity: 110",
          "boundaries.fuel.velocity", ("is Mach 0.3", "at most 99.44 m/s")),
    Wrong("hot layer of a burnt start", "  width: 2 mm", "  width: 2 mm\n  hot_position: 3 mm", "hot_position",
          "initial.hot_position", ("'initial.layer: burnt' does not have this",)),
    Wrong("hot layer without a place", "  width: 2 mm", "  width: 2 mm\n  layer: hot", "initial:", "initial",
          ("a hot layer needs the key 'hot_position'",)),
    Wrong("start outside the domain", "  position: 3.6 mm", "  position: 3.6 cm", "3.6 cm", "initial.position",
          ("from 0 to 0.008 m, found 0.036 m",)),
    Wrong("Lewis numbers of another model", "initial:\n", "transport: {lewis_numbers: \"H2: 0.3\"}\ninitial:\n",
          "transport:", "transport.lewis_numbers", ("'transport.model: mixture_averaged' does not have this",)),
    Wrong("species twice in the output", "species: [all]", "species: [OH, H, OH]", "species: [OH", "output.species",
          ("'OH' is named twice",)),
    Wrong("first step beyond the largest", "  courant: 0.5", "  first_step: 2 ms", "2 ms", "time.first_step",
          ("no more than 'maximum_step'",)),
    Wrong("trajectory shorter than a sample", "  duration: 1 ms", "  duration: 1 us", "trajectories:",
          "trajectories.time_step", ("no more than 'duration'",)),
    Wrong("a side of the other geometry", "{type: symmetry, side: r-min}", "{type: symmetry, side: x-min}", "x-min",
          "boundaries.axis.side", ("the axes of this mesh are r and z",)),
    Wrong("a stream that is no inlet", "  low: fuel", "  low: fuell", "fuell", "initial.low",
          ("'fuell' is not an inlet", "fuel, oxidiser")),
    Wrong("trajectories without soot", SOOT, "", "trajectories:", "trajectories", ("need the section 'particles'",)),
    Wrong("trajectory outside", "{r: 2 mm, z: 4.5 mm}", "{r: 2 mm, z: 45 mm}", "z: 45 mm", "trajectories.start[1]",
          ("outside the mesh",)),
    Wrong("unknown key in --set", key="mesh.refinment", expected=("did you mean 'refinement'?",),
          settings=("mesh.refinment=1",)),
    Wrong("wrong unit in --set", key="time.end", expected=("expected a time", "found '1 m', a length"),
          settings=("time.end=1 m",)),
    Wrong("--set without a value", key="time.end", expected=("expected 'key=value'",), settings=("time.end",)),
    Wrong("cells beyond 32 bits", "cells: 4}", "cells: 4294967297}", "cells: 4294967297", "mesh.r[0].cells",
          ("expected an integer of at most 2147483647, found 4294967297",)),
    Wrong("history steps beyond 32 bits", key="output.history_steps", expected=("at most 2147483647",),
          settings=("output.history_steps=4294967296",)),
    Wrong("particles beyond 32 bits", key="trajectories.particles", expected=("at most 2147483647",),
          settings=("trajectories.particles=4294967312",)),
    Wrong("bins beyond 32 bits", key="trajectories.bins", expected=("from 2 to 10000",),
          settings=("trajectories.bins=4294967312",)),
    Wrong("refinement beyond the memory", key="mesh.refinement", expected=("cells with 47 species needs at least",),
          settings=("mesh.refinement=1e9",)),
    Wrong("cells beyond the memory", "cells: 4}", "cells: 1000000000}", "mesh:", "mesh",
          ("a mesh of 1e+10 cells with 47 species needs at least", "of memory; there are")),
    Wrong("outputs beyond the disk", key="output.interval", expected=("about 1e+10 outputs of the fields",),
          settings=("output.interval=1e-15 s",)),
    Wrong("steps of trajectories beyond the memory", key="trajectories.time_step",
          expected=("1e+12 time steps along each path", "needs at least"), settings=("trajectories.time_step=1e-15 s",)),
    Wrong("species of the output named twice", key="output.species", expected=("'OH' is named twice",),
          settings=("output.species=[OH, CO, OH]",)),
    Wrong("formula of an unknown variable", "    velocity: 20 cm/s", "    formula: {velocity: 2*radius}", "2*radius",
          "boundaries.fuel.formula.velocity", ("the formula '2*radius' cannot be read", "its variables are r, z, t")),
    Wrong("formula and key", "    velocity: 20 cm/s", "    velocity: 20 cm/s\n    formula: {velocity: 0.2}", "velocity: 20 cm/s",
          "boundaries.fuel.velocity", ("is given by a formula or a table, too",)),
    Wrong("formula of an unknown quantity", "    velocity: 20 cm/s", "    velocity: 20 cm/s\n    formula: {velocitty: 0.2}",
          "velocitty", "boundaries.fuel.formula.velocitty", ("cannot be given here", "did you mean 'velocity'?")),
    Wrong("formula of an unknown species", "    velocity: 20 cm/s", "    velocity: 20 cm/s\n    formula: {X_C2H44: 0.2}",
          "X_C2H44", "boundaries.fuel.formula.X_C2H44", ("the mechanism has no species 'C2H44'",)),
    Wrong("formula that is too hot", "    temperature: 299 K", "    formula: {temperature: 9000 + r}", "9000 + r",
          "boundaries.fuel.formula.temperature", ("from 200 to 4000 K", "9000")),
    Wrong("formula without a value at the start", "    velocity: 20 cm/s", "    formula: {velocity: 0.2/t}", "0.2/t",
          "boundaries.fuel.formula.velocity", ("gives no finite number at", "t = 0")),
    Wrong("a table that is not there", "    velocity: 20 cm/s", "    table: nowhere.csv", "nowhere.csv",
          "boundaries.fuel.table", ("nowhere.csv",)),
    Wrong("a wall with two heats", "{type: wall, side: z-min, from: 10 mm}",
          "{type: wall, side: z-min, from: 10 mm, temperature: 300 K, heat_flux: 1 W/m^2}", "  fuel_flange:",
          "boundaries.fuel_flange", ("either a 'temperature' or a 'heat_flux'",)),
    Wrong("a slippery wall that turns", "{type: wall, side: z-min, from: 10 mm}",
          "{type: wall, side: z-min, from: 10 mm, slip: true, formula: {swirl_velocity: 5*r}}", "5*r",
          "boundaries.fuel_flange.formula.swirl_velocity", ("expected slip: false",)),
    Wrong("a flame under a layer", "  low: fuel", "  low: fuel\n  flame1d: {file: nowhere.csv, axis: z}", "  flame1d:",
          "initial.flame1d", ("expected 'layer: none'",)),
    Wrong("trajectory that starts on the outlet", "{r: 2 mm, z: 4.5 mm}", "{r: 14 mm, z: 4.5 mm}", "r: 14 mm",
          "trajectories.start[1]", ("lies on the outlet 'outflow'",)),
    Wrong("mechanism without an end", MECHANISM_KEY, "mechanism: /dev/urandom", "/dev/urandom", "mechanism",
          ("/dev/urandom: this is no regular file",)),
    Wrong("composition without quotes in --set", key="boundaries.fuel.composition",
          expected=("'C2H44'",), settings=("boundaries.fuel.composition=C2H44: 1",)),
    Wrong("a hundred thousand letters", "C2H4: 1", f"C2H4: {100_000 * 'a'}", "C2H4: aa", "boundaries.fuel.composition",
          (" ... ",)),
    Wrong("not YAML", "pressure: 1 atm", "pressure: [1 atm", "", ""),
]

# Found where ranks differ: in files that one of them reads, in cells and faces that one of them has.
OF_RANKS = ("unknown key", "missing mechanism", "garbage mechanism", "unknown PAH", "boundary faces without a patch",
            "gravity through the axis", "trajectory outside", "unknown key in --set", "not YAML")

# As users start the program, each in a process of its own.
REAL = ("unknown key", "missing mechanism", "unknown PAH", "unknown key in --set", "not YAML", "unknown option", "no deck", "done",
        "running")

USAGE = [
    ("unknown option", ("run", "DECK", "--frobnicate"), "--frobnicate"),
    ("no subcommand", (), "subcommand"),
    ("unknown subcommand", ("walk", "DECK"), ""),
    ("no deck", ("run",), "deck"),
    ("--set without an argument", ("run", "DECK", "--set"), "--set"),
    ("deck without an end", ("check", "/dev/zero"), "/dev/zero: this is no regular file"),
    ("replay of a folder", ("replay", "."), ".: this is a folder"),
    ("missing deck", ("run", "nowhere/deck.yaml"), "nowhere/deck.yaml"),
]


class Checker:
    def __init__(self, program: running.Program, folder: pathlib.Path):
        self.program = program
        self.folder = folder
        self.failures = 0

    def run(self, name: str, *arguments) -> running.Result:
        return (self.program.process_of_its_own if name in REAL else self.program)(*arguments)

    def require(self, name: str, result: running.Result, problems: list) -> None:
        if result.code != 2:
            problems.append(f"exit code {result.code}, expected 2")
        if result.out:
            problems.append("something on standard output")
        if not problems:
            print(f"ok      {name}")
            return
        self.failures += 1
        print(f"FAILED  {name}: {'; '.join(problems)}\n{result.out}{result.err}")

    def one_message(self, err: str) -> list:
        """Problems of a standard error that is to hold one message, with the place quoted below it at most."""
        lines = err.splitlines()
        if not lines or not lines[0].startswith("lampblack: "):
            return ["the first line is no message of lampblack"]
        if max(map(len, lines)) > LONGEST:
            return ["a line that no console shows"]
        return [f"more than one message: '{line}'" for line in lines[1:] if not QUOTE.match(line)]

    def mistake(self, wrong: Wrong, also_check: bool) -> None:
        deck = running.small_case(self.folder)
        text = deck.read_text(encoding="utf-8")
        assert text.count(wrong.old) == 1 or not wrong.old, f"{wrong.name}: '{wrong.old}' is not once in the deck"
        if wrong.old:
            text = text.replace(wrong.old, wrong.new)
            deck.write_text(text, encoding="utf-8")
        (deck.parent / "garbage.yaml").write_text("species: [1, 2\n}: - x", encoding="utf-8")
        (deck.parent / "binary.yaml").write_bytes(bytes(range(256)) * 8)
        before = running.snapshot(self.folder)
        result = self.run(wrong.name, "run", deck, *running.settings(*wrong.settings), "--out", self.folder / "out")
        problems = self.one_message(result.err)
        if also_check or wrong.name in OF_RANKS:
            problems += running.differs_from_check(self.program, result, deck, *running.settings(*wrong.settings))
        message = result.err.split("\n", 1)[0]
        place = f"--set {wrong.settings[0]}: " if wrong.settings else f"{deck}:"
        if wrong.at:
            place += str(text[:text.index(wrong.at)].count("\n") + 1) + ":"
        if not message.startswith(f"lampblack: {place}"):
            problems.append(f"does not start with 'lampblack: {place}'")
        if wrong.key and not re.search(rf"(^|[: '\"]){re.escape(wrong.key)}(:|'| )", message):
            problems.append(f"does not name the key {wrong.key}")
        problems += [f"does not say \"{part}\"" for part in wrong.expected if part not in message]
        if running.snapshot(self.folder) != before:
            problems.append("left something behind")
        self.require(wrong.name, result, problems)

    def usage(self, name: str, arguments: tuple, expected: str) -> None:
        deck = running.small_case(self.folder)
        before = running.snapshot(self.folder)
        result = self.run(name, *[deck if word == "DECK" else word for word in arguments])
        lines = [line for line in result.err.splitlines() if line.strip()]
        # The message, and where to find help.
        problems = [] if 1 <= len(lines) <= 2 and len(set(lines)) == len(lines) else ["not exactly one message"]
        if expected not in result.err:
            problems.append(f"does not say \"{expected}\"")
        if running.snapshot(self.folder) != before:
            problems.append("left something behind")
        self.require(f"usage: {name}", result, problems)

    def occupied(self, name: str, files: dict) -> None:
        """Another run in the output folder: whole, failed or cut off."""
        deck = running.small_case(self.folder)
        out = self.folder / "occupied"
        out.mkdir()
        for file, text in files.items():
            (out / file).write_text(text, encoding="utf-8")
        before = running.snapshot(self.folder)
        result = self.run(name, "run", deck, "--out", out)
        problems = self.one_message(result.err)
        problems += [f"does not say \"{part}\"" for part in (f"{out}: ", "--out", "--force") if part not in result.err]
        if running.snapshot(self.folder) != before:
            problems.append("changed the other run")
        self.require(f"occupied folder: {name}", result, problems)


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))

    def check(task: tuple) -> int:
        method, *arguments = task
        with tempfile.TemporaryDirectory() as folder:
            checker = Checker(program, pathlib.Path(folder))
            getattr(checker, method)(*arguments)
            return checker.failures

    # All messages on one rank; that only one of several ranks speaks does not need every one of them.
    mistakes = [wrong for i, wrong in enumerate(MISTAKES) if program.ranks == 1 or i % 8 == 0 or wrong.name in OF_RANKS]
    assert {wrong.name for wrong in mistakes}.issuperset(OF_RANKS)
    usage = USAGE if program.ranks == 1 else USAGE[::3]
    tasks = [("mistake", *pair) for pair in running.thinned(mistakes)] + [("usage", *case) for case in usage]
    run = {"results.h5": "not to be lost", "results.xdmf": "<Xdmf/>", "history.csv": "time [s]\n0\n", "notes.txt": "mine"}
    tasks += [("occupied", status, {"run.json": json.dumps({"status": status}), **run})
              for status in ("done", "failed", "running")]
    tasks += [("occupied", "results only", {"results.h5.part": "not to be lost"})]
    failures = sum(running.at_once(check, tasks))
    print(f"{len(tasks) - failures} passed, {failures} failed on {ranks} rank(s)")
    return 1 if failures else 0


sys.exit(main(*sys.argv[1:]))
