#!/usr/bin/python3
"""Rate at which a ring of six grows on a free edge by the steps of MOpS's source of 2022, over that of set R1.

Seven intermediates in steady state, or in partial equilibrium with benzene by the steps below, feed the steps that close the
second ring; a sixth of a benzene's rate is that of one edge.
"""
import csv
import math
import pathlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
R = 1.98720425e-3  # kcal/mol/K
INTERMEDIATES = ["A1-", "A1C2H3", "A1C2H3*", "A1C2H", "A1C2H*", "A1C2H2", "A1C2HX2"]
RINGS = {"A2", "A2-", "A2*"}
# Each from what stands before it.
EQUILIBRIA = [("A1-", "A1 + H <=> A1- + H2", "A1"), ("A1C2H", "A1- + C2H2 <=> A1C2H + H", "A1-"),
              ("A1C2H2", "A1- + C2H2 <=> A1C2H2", "A1-"), ("A1C2H3*", "A1- + C2H2 <=> A1C2H3*", "A1-"),
              ("A1C2H*", "A1C2H + H <=> A1C2H* + H2", "A1C2H"), ("A1C2HX2", "A1C2H* + C2H2 <=> A1C2HX2 + H", "A1C2H*"),
              ("A1C2H3", "A1C2H3* + H <=> A1C2H3", "A1C2H3*")]


def rows(name):
    with open(HERE / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def aromatic(side):
    return next(part.strip() for part in side.split(" + ") if part.strip().startswith("A"))


def rates(temperature, gas):
    """[(from, to, 1/s, reaction, direction)]"""
    steps = []
    for row in rows("free_edge_steps.csv"):
        k = float(row["A"]) * temperature ** float(row["n"]) * math.exp(-float(row["E"]) / (R * temperature))
        left, right = (aromatic(side) for side in row["reaction"].split(" <=> "))
        if row["direction"] == "reverse":
            left, right = right, left
        steps.append((left, right, k * (gas[row["gas"]] if row["gas"] else 1), row["reaction"], row["direction"]))
    return steps


def steady(steps):
    matrix, source = np.zeros((7, 7)), np.zeros(7)
    place = {name: k for k, name in enumerate(INTERMEDIATES)}
    for left, right, k, *_ in steps:
        if left in place:
            matrix[place[left], place[left]] += k
        if right in place and left == "A1":
            source[place[right]] += k
        elif right in place and left in place:
            matrix[place[right], place[left]] -= k
    return {"A1": 1.0, **dict(zip(INTERMEDIATES, np.linalg.solve(matrix, source)))}


def equilibrium(steps):
    k = {(reaction, direction): rate for _, _, rate, reaction, direction in steps}
    amounts = {"A1": 1.0}
    for name, reaction, before in EQUILIBRIA:
        amounts[name] = amounts[before] * k[reaction, "forward"] / k[reaction, "reverse"]
    return amounts


def growth(steps, amounts):
    return sum(amounts[left] * k for left, right, k, *_ in steps if right in RINGS and left not in RINGS) / 6


def set_r1(temperature, gas):
    def k(a, n, e):
        return a * temperature**n * math.exp(-e / (R * temperature))

    opens = k(4.2e13, 0, 13) * gas["H"] + k(1e10, 0.734, 1.43) * gas["OH"]
    closes = k(3.9e12, 0, 11) * gas["H2"] + k(3.68e8, 1.139, 17.1) * gas["H2O"] + k(2e13, 0, 0) * gas["H"]
    grows = (k(1.1e7, 1.71, 3.9) + k(3.3e33, -5.7, 25.5)) * gas["C2H2"]
    return grows * opens / (opens + closes + grows)


def main():
    print("time, ms  set R1, 1/s  steady state over it  partial equilibrium over it")
    for row in rows("free_edge_gas.csv"):
        temperature = float(row["temperature [K]"])
        total = 1e-6 * 1e5 / (8.314462618 * temperature)
        gas = {name: total * float(row[name]) for name in ("H2", "H", "OH", "H2O", "C2H2", "C2H3", "C2H4", "C4H4")}
        steps, reference = rates(temperature, gas), set_r1(temperature, gas)
        print(f"{1e3 * float(row['time [s]']):8.2f}  {reference:11.4g}  {growth(steps, steady(steps)) / reference:20.4f}  "
              f"{growth(steps, equilibrium(steps)) / reference:27.4f}")


main()
