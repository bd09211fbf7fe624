"""Pictures of fields that are asked for by name: over the plane of a flow, over z of a one-dimensional flame."""

import re

import numpy as np

from ..errors import ResultsError
from .planes import plot_plane
from .style import plt

FRACTIONS = {"X": "mole fraction", "Y": "mass fraction"}


def plot_fields(results, names, pictures):
    """One picture a field, called as it is; ResultsError where a name is that of no field."""
    if results.is_flame:
        there = dict(results.profile())
        find, known = there.get, list(there)
    elif results.is_flow and results.steps:
        find, known = results.field, list(results.fields(results.steps[-1]))
    else:
        raise ResultsError(f"{results.folder}: --fields is for the results of flows and one-dimensional flames")
    fields = {}
    for words in names:
        # Names of species may have commas.
        for name in [words] if find(words) is not None else words.split(","):
            fields[name] = find(name)
            if fields[name] is None:
                wanted = " (mass fractions need the mole fractions of all species: output.species: [all])" if name[:2] == "Y_" else ""
                raise ResultsError(f"{results.folder}: there is no field '{name}'{wanted}; these are there: {', '.join(known)}")
    for name, values in fields.items():
        kind = FRACTIONS.get(name.partition("_")[0]) if "_" in name else None
        title = f"{name[2:]} {kind}" if kind else name.replace("_", " ").capitalize()
        picture = re.sub(r"[^\w+-]", "_", name)
        if results.is_flame:
            _plot_over_z(results, picture, np.asarray(values), title, values.unit, pictures)
        elif np.ndim(values) > 1 and values.shape[1] != 3:
            pictures.skip(f"{name} picture", "it has several numbers a cell")
        else:
            plot_plane(results, picture, np.asarray(values), title, None if kind else values.unit, pictures)


def _plot_over_z(results, picture, values, title, unit, pictures):
    figure, axes = plt.subplots(figsize=(6.4, 4.0))
    axes.plot(results.profile()["z"] * 1e3, values, marker=".", ms=2.5, lw=1.2)
    axes.set_xlabel("z, mm")
    axes.set_ylabel(f"{title}, {unit}" if unit not in ("", "1") else title)
    pictures.save(figure, picture)
