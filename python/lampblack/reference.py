"""Reference profiles along the centreline: CSV files with the columns z_m, T_K, u_m_s, X_<species>, ..."""

import csv
import pathlib

import numpy as np

from .damage import ResultsError, reading


class ProfileError(ResultsError):
    """The file is not a reference profile."""


def _table(path):
    """The names in the header of a CSV file and its numbers; lines of comments left out."""
    path = pathlib.Path(path)
    try:
        with reading(path).open(newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    except OSError as error:
        raise ProfileError(f"{path}: {error.strerror}") from error
    if len(rows) < 2:
        raise ProfileError(f"{path}: not a profile; a header and rows of numbers are expected")
    try:
        table = np.array([[float(x) for x in row] for row in rows[1:]])
    except ValueError as error:
        raise ProfileError(f"{path}: {error}") from error
    if table.ndim != 2 or table.shape[1] != len(rows[0]):
        raise ProfileError(f"{path}: its rows are not all as long as its header")
    return rows[0], table.T


def read_reference(path):
    """The columns of a reference profile as {name: values}."""
    names, columns = _table(path)
    if "z_m" not in names:
        raise ProfileError(f"{path}: not a profile; a column 'z_m' and rows are expected")
    return dict(zip(names, columns))


def read_profile(path):
    """The columns of a flame1d's profile.csv as {name without unit: values}, None where it is another file."""
    names, columns = _table(path)
    return dict(zip((name.split(" [")[0] for name in names), columns)) if names[0] == "z [m]" else None


def find_references(results):
    """Profiles beside the deck of a run: <case>/reference/*.csv with a column z_m."""
    deck = results.record().get("deck_path")
    if not deck:
        return []
    found = []
    for path in sorted((pathlib.Path(deck).parent / "reference").glob("*.csv")):
        try:
            read_reference(path)
        except ProfileError:
            continue
        found.append(path)
    return found


def peak(z, values):
    """The largest value and its place, from the parabola through the largest sample and its neighbours."""
    z, values = np.asarray(z, float), np.asarray(values, float)
    i = int(np.nanargmax(values))
    if i == 0 or i == len(values) - 1:
        return float(values[i]), float(z[i])
    left, right = z[i - 1] - z[i], z[i + 1] - z[i]
    a = values[i - 1] - values[i]
    b = values[i + 1] - values[i]
    curvature = (a / left - b / right) / (left - right)
    if not curvature < 0:
        return float(values[i]), float(z[i])
    slope = a / left - curvature * left
    offset = float(np.clip(-slope / (2 * curvature), left, right))
    return float(values[i] + slope * offset + curvature * offset**2), float(z[i] + offset)
