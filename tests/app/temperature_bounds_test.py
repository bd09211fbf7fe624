"""Every flame, reactor and flow runs at the lowest and highest temperatures a deck may ask for, and `check` refuses those
beyond with the range of the mechanism.

Usage: temperature_bounds_test.py EXECUTABLE RANKS MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

MECHANISMS = running.SOURCE / "cases/mechanisms"
HYDROGEN = MECHANISMS / "hydrogen_h2o2_10.yaml"
GRI = MECHANISMS / "methane_gri30_53.yaml"
PREMIXED = 'fuel: "H2: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 1'
GRID = "grid: {slope: 0.2, curve: 0.3, prune: 0.05}\n"


def flame(keys: str) -> str:
    return f"problem: flame1d\nmechanism: {HYDROGEN}\n{keys}{GRID}"


def premixed(kind: str, stream: str = "") -> str:
    return flame(f"flame: {{type: {kind}}}\ninlet: {{temperature: 200 K, {PREMIXED}{stream}}}\n")


def counterflow(keys: str, stream: str) -> str:
    return flame(f'flame: {{type: counterflow{keys}}}\nleft: {{temperature: 200 K, composition: "H2: 1, N2: 1"{stream}}}\n'
                 f'right: {{temperature: 200 K, composition: "O2: 1, N2: 3.76"{stream}}}\n')


def reactor(kind: str, temperature: str, energy: str = "adiabatic") -> str:
    return (f"problem: reactor\nmechanism: {HYDROGEN}\nreactor: {{type: {kind}, energy: {energy}}}\n"
            f'initial: {{temperature: {temperature}, composition: "N2: 1, O2: 1, H2: 1"}}\ntime: {{end: 1 us}}\n')


ALLOWED = {
    "free": premixed("free"),
    "burner": premixed("burner", ", velocity: 0.5 m/s"),
    "wall": premixed("wall, wall_temperature: 200 K", ", velocity: 1 m/s"),
    "counterflow": counterflow("", ", velocity: 0.5 m/s"),
    "counterflow in potential flow": counterflow(", nozzles: potential, strain_rate: 100 1/s", ""),
    "coldest reactor": reactor("constant_pressure", "200 K"),
    "hottest reactor": reactor("constant_volume", "5500 K"),
    "hottest isothermal reactor": reactor("constant_pressure", "5500 K", "isothermal"),
    "flow": "",  # tests/app/flame.yaml
}

METHANE = f"""problem: flame1d
mechanism: {GRI}
flame: {{type: free}}
inlet: {{temperature: 150 K, composition: "CH4: 1, O2: 2, N2: 7.52"}}
"""

# Name, deck, the key, the range.
REFUSED = [
    ("GRI at 150 K", METHANE, "inlet.temperature", "from 200 to 4000 K"),
    ("flame below", ALLOWED["free"].replace("200 K", "199.9 K"), "inlet.temperature", "from 200 to 4000 K"),
    ("flame above", ALLOWED["burner"].replace("200 K", "4000.1 K"), "inlet.temperature", "from 200 to 4000 K"),
    ("right stream", ALLOWED["counterflow"].replace("right: {temperature: 200", "right: {temperature: 150"),
     "right.temperature", "from 200 to 4000 K"),
    ("wall of a flame", ALLOWED["wall"].replace("wall_temperature: 200", "wall_temperature: 150"),
     "flame.wall_temperature", "from 200 to 4000 K"),
    ("profile of a burner",
     ALLOWED["burner"].replace("type: burner", "type: burner, energy: given")
     + "temperature_profile: {position: [0 m, 1 mm], temperature: [300 K, 4500 K]}\n",
     "temperature_profile.temperature[1]", "from 200 to 4000 K"),
    ("reactor below", reactor("constant_pressure", "150 K"), "initial.temperature", "from 200 to 5500 K"),
    ("reactor above", reactor("constant_pressure", "5501 K"), "initial.temperature", "from 200 to 5500 K"),
    ("temperature of a reactor",
     reactor("constant_pressure", "300 K", "isothermal, temperature: 150 K"), "reactor.temperature", "200 to 5500 K"),
    ("profile of a reactor",
     reactor("constant_pressure", "300 K", "profile") + "temperature_profile: {time: [0 s], temperature: [150 K]}\n",
     "temperature_profile.temperature[0]", "200 to 5500 K"),
]


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))

    def allowed(folder: pathlib.Path, name: str, text: str) -> list:
        deck = running.small_case(folder)
        if name == "flow":
            text = deck.read_text(encoding="utf-8").replace("299 K", "200 K").replace("298 K", "200 K")
        deck.write_text(text, encoding="utf-8")
        result = program("run", deck, "--out", folder / "out")
        return [] if result.code == 0 else [f"exit code {result.code}\n{result.err}"]

    def refused(folder: pathlib.Path, text: str, key: str, expected: str) -> list:
        deck = folder / "deck.yaml"
        deck.write_text(text, encoding="utf-8")
        result = program("check", deck)
        problems = [] if result.code == 2 else [f"exit code {result.code}"]
        return problems + [f"does not say '{part}': {result.err}" for part in (f"{deck}:", f" {key}: ", expected)
                           if part not in result.err.split("\n", 1)[0]]

    def check(task: tuple) -> int:
        name, work, *arguments = task
        with tempfile.TemporaryDirectory() as folder:
            problems = work(pathlib.Path(folder), *arguments)
        print(f"FAILED  {name}: {'; '.join(problems)}" if problems else f"ok      {name}")
        return len(problems) > 0

    tasks = [(name, allowed, name, text) for name, text in ALLOWED.items()]
    tasks += [(name, refused, *rest) for name, *rest in REFUSED]
    failures = sum(running.at_once(check, tasks))
    print(f"{len(tasks) - failures} passed, {failures} failed")
    return 1 if failures else 0


sys.exit(main(*sys.argv[1:]))
