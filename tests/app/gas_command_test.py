"""`lampblack gas` against Cantera 3.2.0, in every state of the tables of tests/chemistry/data.

Usage: gas_command_test.py EXECUTABLE RANKS MPIEXEC...

The tables have 13 digits and are in kmol.
"""

import collections
import csv
import json
import re
import sys

import running

DATA = running.SOURCE / "tests/chemistry/data"
MECHANISMS = {"h2o2": "hydrogen_h2o2_10.yaml", "gri30": "methane_gri30_53.yaml"}
KEYS = ["temperature", "pressure", "density", "mean_molecular_weight", "cp_mass", "enthalpy_mass", "entropy_mass",
        "viscosity", "thermal_conductivity", "mole_fractions", "mixture_diffusion_coefficients",
        "thermal_diffusion_coefficients", "forward_rate_constants", "reverse_rate_constants", "net_production_rates"]


class Worst:
    """The largest deviation of each quantity, and what it may be."""

    def __init__(self):
        self.found = collections.defaultdict(float)
        self.allowed = {}

    def compare(self, what: str, value: float, reference: float, scale: float, allowed: float) -> None:
        deviation = abs(value - reference) / scale if value != reference else 0.0
        # NaN compares false with everything.
        self.found[what] = deviation if not deviation <= self.found[what] else self.found[what]
        self.allowed[what] = allowed

    def relative(self, what: str, value: float, reference: float, allowed: float) -> None:
        self.compare(what, value, reference, abs(reference), allowed)

    def report(self) -> bool:
        for what, deviation in self.found.items():
            verdict = "ok" if deviation <= self.allowed[what] else "FAILED"
            print(f"{verdict:8}{what}: {deviation:.2g} (allowed {self.allowed[what]:g})")
        return all(deviation <= self.allowed[what] for what, deviation in self.found.items())


def table(name: str) -> list:
    with (DATA / name).open(encoding="utf-8", newline="") as file:
        next(file)  # the source
        return list(csv.DictReader(file))


def by_state(rows: list) -> dict:
    states = collections.defaultdict(list)
    for row in rows:
        states[row["state"]].append(row)
    return states


def orders(mechanism) -> list:
    """Numbers of reactants and products of each reaction; [M] counts, the (+M) of a fall-off reaction does not."""
    counts = []
    for equation in re.findall(r"^ *- equation: (.*?) *(?:#.*)?$", mechanism.read_text(encoding="utf-8"), re.M):
        sides = re.split(r" <=> | => | = ", equation.strip("\"'"))
        assert len(sides) == 2, equation
        counts.append(tuple(
            sum(int((re.match(r"(\d+) ", term.strip()) or [0, 1])[1])
                for term in re.split(r" \+ ", re.sub(r"\(\+ ?\w+\)", "", side))) for side in sides))
    return counts


def mole_fractions(row: dict) -> str:
    return ", ".join(f"{name[2:]}: {value}" for name, value in row.items() if name.startswith("X_"))


def ask(program: running.Program, mechanism, state: dict, *options: str) -> dict:
    result = program("gas", mechanism, "--T", state["T"], "--p", state["p"], "--X", mole_fractions(state), "--json", *options)
    assert result.code == 0, result.err
    return json.loads(result.out)


def compare_transport(program: running.Program, name: str, worst: Worst) -> None:
    """Collision integrals come from the same tables, through other fits: viscosity, conductivity and diffusion to 0.5 %,
    thermal diffusion, which hangs on their small differences, to 1 % of the largest."""
    mechanism = running.SOURCE / "cases/mechanisms" / MECHANISMS[name]
    species = by_state(table(f"transport_{name}_species.csv"))
    mixture = by_state(table(f"transport_{name}_mixture.csv"))
    models = {"mixture-averaged": ("lambda_mixavg", "DT_mixavg_model"), "multicomponent": ("lambda_multi", "DT_multi")}
    tasks = [(state, model) for state in table(f"transport_{name}_states.csv") for model in models]
    answers = running.at_once(lambda task: ask(program, mechanism, task[0], "--transport", task[1]), tasks)
    for (state, model), gas in zip(tasks, answers):
        rows, [row] = species[state["state"]], mixture[state["state"]]
        conductivity, thermal = models[model]
        assert gas["transport_model"] == model
        worst.relative(f"{name} viscosity", gas["viscosity"], float(row["mu_mixavg"]), 5e-3)
        worst.relative(f"{name} {model} conductivity", gas["thermal_conductivity"], float(row[conductivity]), 5e-3)
        largest = max(abs(float(entry[thermal])) for entry in rows)
        for entry in rows:
            worst.relative(f"{name} mixture diffusion coefficients",
                           gas["mixture_diffusion_coefficients"][entry["species"]], float(entry["D_mix_avg"]), 5e-3)
            worst.compare(f"{name} {model} thermal diffusion, of the largest",
                          gas["thermal_diffusion_coefficients"][entry["species"]], float(entry[thermal]), largest, 1e-2)


def compare(program: running.Program, name: str, worst: Worst) -> None:
    mechanism = running.SOURCE / "cases/mechanisms" / MECHANISMS[name]
    reactants_and_products = orders(mechanism)
    species = by_state(table(f"kinetics_{name}_species.csv"))
    reactions = by_state(table(f"kinetics_{name}_reactions.csv"))
    mixture = by_state(table(f"kinetics_{name}_mixture.csv"))
    states = table(f"kinetics_{name}_states.csv")
    for state, gas in zip(states, running.at_once(lambda state: ask(program, mechanism, state), states)):
        assert all(key in gas for key in KEYS), sorted(gas)
        number = state["state"]
        [row] = mixture[number]
        worst.relative(f"{name} molecular weight", gas["mean_molecular_weight"] * 1e3, float(row["W"]), 1e-12)
        worst.relative(f"{name} density", gas["density"], float(row["rho"]), 1e-12)
        worst.relative(f"{name} heat capacity", gas["cp_mass"], float(row["cp"]), 1e-11)
        worst.relative(f"{name} entropy", gas["entropy_mass"], float(row["s"]), 1e-11)
        # Enthalpies may cancel: relative to c_p T.
        worst.compare(f"{name} enthalpy", gas["enthalpy_mass"], float(row["h"]), gas["cp_mass"] * gas["temperature"],
                      1e-11)
        assert len(gas["forward_rate_constants"]) == len(reactions[number]) == len(reactants_and_products)
        for r, row in enumerate(reactions[number]):
            for key, column, order in (("forward", "kf", reactants_and_products[r][0]),
                                       ("reverse", "kr", reactants_and_products[r][1])):
                value = gas[f"{key}_rate_constants"][r] * 1e3 ** (order - 1)
                worst.relative(f"{name} {key} rate constants", value, float(row[column]), 1e-11)
        assert list(gas["net_production_rates"]) == [row["species"] for row in species[number]]
        for row in species[number]:
            gross = max(float(row["creation"]), float(row["destruction"]))
            if gross > 0:
                worst.compare(f"{name} net rates, of the species' gross rate",
                              gas["net_production_rates"][row["species"]] / 1e3, float(row["net"]), gross, 1e-11)


def main() -> int:
    program = running.Program(sys.argv[1], sys.argv[3:], int(sys.argv[2]))
    worst = Worst()
    for name in MECHANISMS:
        compare(program, name, worst)
        compare_transport(program, name, worst)
    return 0 if worst.report() else 1


if __name__ == "__main__":
    sys.exit(main())
