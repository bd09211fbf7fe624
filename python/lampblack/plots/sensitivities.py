"""A picture of what a result depends on: the reactions with the largest sensitivities, of ignition delays or a flame's speed."""

import csv

import numpy as np

from ..damage import reading
from .style import plt

MOST_REACTIONS = 15


def plot_sensitivities(results, pictures):
    path = results.folder / "sensitivities.csv"
    if not path.is_file():
        return
    with open(reading(path), newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    if len(header) < 3 or not rows:
        pictures.skip("sensitivities", "no criterion of ignition was met")
        return
    values = np.array([[float(word) for word in row[2:]] for row in rows])
    order = np.argsort(-np.max(np.abs(values), axis=1))[:MOST_REACTIONS][::-1]
    figure, axes = plt.subplots(figsize=(7.0, 0.8 + 0.32 * len(order)))
    places = np.arange(len(order))
    height = 0.8 / values.shape[1]
    for c in range(values.shape[1]):
        name = header[2 + c].split(" [")[0]
        axes.barh(places + (c - 0.5 * (values.shape[1] - 1)) * height, values[order, c], height=height, label=name)
    axes.set_yticks(places, [f"{rows[i][0]}: {rows[i][1]}" for i in order], fontsize=8)
    axes.axvline(0, color="black", lw=0.8)
    of_speed = header[2].startswith("flame_speed")
    axes.set_xlabel(f"d ln({'flame speed' if of_speed else 'ignition delay'}) / d ln k")
    if not of_speed:
        axes.legend(fontsize=8)
    pictures.save(figure, "sensitivity")
