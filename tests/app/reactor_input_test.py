"""Every way in which a reactor deck can be wrong ends in exit code 2 and exactly one message that names the place.

Usage: reactor_input_test.py EXECUTABLE RANKS MPIEXEC...
"""

import pathlib
import re
import sys
import tempfile

import running

HYDROGEN = running.SOURCE / "cases/mechanisms/hydrogen_h2o2_10.yaml"

CLOSED = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: constant_pressure
initial:
  temperature: 1200 K
  fuel: "H2: 1"
  oxidizer: "O2: 1, N2: 3.76"
  equivalence_ratio: 1
time:
  end: 1 ms
sensitivity:
  reactions: [all]
"""

STIRRED = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: stirred
  residence_time: 1 ms
inlet:
  temperature: 300 K
  composition: "H2: 2, O2: 1, N2: 3.76"
"""

PLUG_FLOW = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: plug_flow
  length: 1 m
inlet:
  temperature: 1200 K
  composition: "H2: 2, O2: 1, N2: 3.76"
  velocity: 1 m/s
"""

NETWORK = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: network
network:
  reactors:
    one: {{volume: 1 cm^3}}
    two: {{residence_time: 1 ms}}
  inlets:
    feed: {{to: one, mass_flow: 1 g/s, temperature: 300 K, composition: "H2: 2, O2: 1, N2: 3.76"}}
  connections:
    - {{from: one, to: two}}
"""

# Name, deck, text to replace, its replacement, what the message says.
MISTAKES = [
    ("no problem", CLOSED, "problem: reactor\n", "", ("problem: this key is missing", "flow, flame1d, reactor")),
    ("misspelt problem", CLOSED, "problem:", "probelm:", ("unknown key 'probelm'", "did you mean 'problem'?")),
    ("unknown problem", CLOSED, "problem: reactor", "problem: reacter", ("expected one of: flow, flame1d, reactor", "did you mean 'reactor'?")),
    ("key of another problem", CLOSED, "time:", "mesh:\n  refinement: 1\ntime:", ("mesh: unknown key 'mesh'",)),
    ("unknown type", CLOSED, "constant_pressure", "constant_presure", ("reactor.type", "constant_pressure")),
    ("no initial state", CLOSED, CLOSED[CLOSED.index("initial:"):CLOSED.index("time:")], "", ("needs the section 'initial'",)),
    ("no end", CLOSED, "time:\n  end: 1 ms\n", "", ("needs the key 'end'",)),
    ("no mixture", CLOSED, CLOSED[CLOSED.index("  fuel:"):CLOSED.index("time:")], "", ("initial: the mixture is missing",)),
    ("two mixtures", CLOSED, "  fuel:", '  composition: "H2: 1"\n  fuel:', ("initial: the mixture is given twice",)),
    ("no ratio", CLOSED, "  equivalence_ratio: 1\n", "", ("'equivalence_ratio' is missing",)),
    ("fuel that is none", CLOSED, '"H2: 1"', '"N2: 1"', ("the fuel needs no oxygen",)),
    ("oxidizer that is none", CLOSED, '"O2: 1, N2: 3.76"', '"N2: 1"', ("the oxidizer has no oxygen",)),
    ("unknown species", CLOSED, '"H2: 1"', '"HH2: 1"', ("initial.fuel", "unknown species 'HH2'", "'H2'")),
    ("too hot", CLOSED, "1200 K", "12000 K", ("initial.temperature", "12000 K")),
    ("unknown reaction", CLOSED, "[all]", "['H + O2 <=> O + HO']", ("no reaction 'H + O2 <=> O + HO'", "did you mean")),
    ("reaction out of range", CLOSED, "[all]", "[30]", ("there is no reaction 30; expected 1 to 29",)),
    ("species of ignition", CLOSED, "sensitivity:", "ignition:\n  species: [OHX]\nsensitivity:", ("ignition.species", "unknown species 'OHX'")),
    ("profile without energy", CLOSED, "time:", "temperature_profile:\n  time: [0 s]\n  temperature: [300 K]\ntime:", ("'reactor.energy: adiabatic' does not have this; leave it out, or choose: profile",)),
    ("energy without profile", CLOSED, "  type: constant_pressure", "  type: constant_pressure\n  energy: profile", ("needs the section 'temperature_profile'",)),
    ("section of another type", CLOSED, "time:", "network: {reactors: {a: {volume: 1 m^3}}, inlets: {b: {to: a, mass_flow: 1, temperature: 300}}}\ntime:", ("network: 'reactor.type: constant_pressure' does not have this",)),
    ("stirred without a size", STIRRED, "  residence_time: 1 ms\n", "", ("needs either 'volume' or 'residence_time'",)),
    ("volume without flow", STIRRED, "residence_time: 1 ms", "volume: 1 cm^3", ("needs the key 'mass_flow'",)),
    ("ignition of a stirred reactor", STIRRED, "inlet:", "ignition:\n  species: [OH]\ninlet:", ("ignition: 'reactor.type: stirred' does not have this",)),
    ("plug flow without flow", PLUG_FLOW, "  velocity: 1 m/s\n", "", ("needs either 'velocity' or 'mass_flow'",)),
    ("plug flow without length", PLUG_FLOW, "  length: 1 m\n", "", ("needs the key 'length'",)),
    ("unknown reactor", NETWORK, "to: two", "to: twoo", ("network.connections[0].to", "no reactor 'twoo'", "did you mean 'two'?")),
    ("reactor without inflow", NETWORK, "    - {from: one, to: two}\n", "    - {from: two, to: one}\n", ("network.reactors.two: nothing flows into this reactor",)),
    ("more out than in", NETWORK, "to: two}", "to: two, mass_flow: 2 g/s}", ("network.reactors.one", "only 0.001 kg/s flow through it")),
    ("loop that lets nothing out", NETWORK, "    - {from: one, to: two}\n", "    - {from: one, to: two}\n    - {from: two, to: one}\n", ("lets nothing out",)),
]


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))

    def check(mistake: tuple) -> int:
        name, deck, old, new, expected = mistake
        assert deck.count(old) == 1, f"{name}: '{old}' is not once in the deck"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "deck.yaml"
            path.write_text(deck.replace(old, new), encoding="utf-8")
            result = program("run", path, "--out", pathlib.Path(folder) / "out")
            problems = [] if result.code == 2 else [f"exit code {result.code}"]
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
    mistakes = MISTAKES if int(ranks) == 1 else MISTAKES[::3]
    failures = sum(running.at_once(check, mistakes))
    print(f"{len(mistakes) - failures} passed, {failures} failed on {ranks} rank(s)")
    return 1 if failures else 0


sys.exit(main(*sys.argv[1:]))
