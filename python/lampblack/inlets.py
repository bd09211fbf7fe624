"""Tables of what comes in at the inlets of a turbulent flow: velocity, turbulent energy and its dissipation over the radius."""

import csv

import numpy as np

from .errors import ResultsError
from .results import Results

C_MU = 0.09
COLUMNS = ("r [mm]", "velocity [m/s]", "turbulent_kinetic_energy [m^2/s^2]", "turbulent_dissipation [m^2/s^3]")


def of_pipe(folder, mean):
    """Rows of the profiles of a developed pipe, scaled to a mean velocity, and the mean velocity that the run has. Energy goes as its
    square, dissipation as its cube. The run is of a model with omega."""
    results = Results(folder)
    centres = np.asarray(results.centres)
    names = ("turbulent_kinetic_energy", "omega_root")
    k, root = (results.field(name) for name in names)
    if k is None or root is None:
        raise ResultsError(f"{folder}: expected the fields {names[0]} and {names[1]}, of a model with omega")
    section = np.flatnonzero(centres[:, 1] == centres[:, 1].min())
    section = section[np.argsort(centres[section, 0])]
    r, u = centres[section, 0], np.asarray(results.field("velocity"))[section, 1]
    k, omega = np.asarray(k)[section], np.asarray(root)[section] ** -2.0
    area = np.asarray(results.file["mesh/cellVolume"])[section]
    bulk = float((u * area).sum() / area.sum())
    scale = mean / bulk
    rows = [[1e3 * radius, scale * speed, scale**2 * energy, scale**3 * C_MU * energy * rate]
            for radius, speed, energy, rate in zip(r, u, k, omega)]
    return rows, bulk


def dissipation(energy, length):
    """m2/s3, of eddies of that length (m)."""
    return C_MU**0.75 * energy**1.5 / length


def write(path, rows):
    """A row: radius (mm), velocity (m/s), energy (m2/s2), dissipation (m2/s3)."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows([f"{value:.6g}" for value in row] for row in rows)
