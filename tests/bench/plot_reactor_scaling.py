#!/usr/bin/python3
"""Draws the cost of the reactor against the number of species, with the fitted power and the power of 1.5.

Usage: reactor_bench --no_errors --benchmark_filter=igniting --benchmark_repetitions=5 --benchmark_out=scaling.json
       plot_reactor_scaling.py scaling.json docs/images/reactor_scaling.png
"""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def least(file: pathlib.Path) -> list:
    """(species, seconds a state, steps, mechanism) of each mechanism, the fastest of its repetitions."""
    best = {}
    for run in json.loads(file.read_text(encoding="utf-8"))["benchmarks"]:
        if run["run_type"] != "iteration" or "species" not in run:
            continue
        name = run["name"].split("/")[1]
        row = (int(run["species"]), run["per_state"], run["steps"], name)
        if name not in best or row[1] < best[name][1]:
            best[name] = row
    return sorted(best.values())


def main(source: str, picture: str) -> None:
    rows = least(pathlib.Path(source))
    species = np.array([row[0] for row in rows], dtype=float)
    cost = np.array([row[1] for row in rows])
    power, offset = np.polyfit(np.log(species), np.log(cost), 1)
    for count, seconds, steps, name in rows:
        print(f"{name:32} {count:4} species {1e3 * seconds:8.3f} ms {steps:7.1f} steps {1e6 * seconds / steps:8.2f} us a step")
    print(f"cost ~ species^{power:.2f} (least squares), ^{np.log(cost[-1] / cost[0]) / np.log(species[-1] / species[0]):.2f} (first to last)")
    line = np.geomspace(species[0], species[-1], 50)
    figure, axes = plt.subplots(figsize=(5.5, 4))
    axes.loglog(species, 1e3 * cost, "o", color="black", label="measured")
    axes.loglog(line, 1e3 * np.exp(offset) * line**power, "-", color="tab:blue", label=f"species$^{{{power:.2f}}}$ (fit)")
    axes.loglog(line, 1e3 * cost[0] * (line / species[0]) ** 1.5, "--", color="tab:red", label="species$^{1.5}$ from the first")
    ticks = [int(count) for count in species if count != 53]
    axes.set_xticks(ticks, labels=[str(tick) for tick in ticks])
    costs = [0.2, 0.5, 1, 2, 5]
    axes.set_yticks(costs, labels=[f"{value:g}" for value in costs])
    axes.minorticks_off()
    axes.set_xlabel("species")
    axes.set_ylabel("mean cost of 10 µs, ms")
    axes.set_title("Igniting methane and air, 1 atm, rtol 1e-6, atol 1e-12", fontsize=9)
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(picture, dpi=120)


main(*sys.argv[1:])
