"""Fields of a flow behind a bluff body, on a box whose boundaries `body` and `jet` are on its bottom."""

import pathlib

import numpy as np

from .results import Results, ResultsError


class Plane:
    """A run's fields on rows of the radius (m) along z (m)."""

    def __init__(self, folder):
        self.results = Results(folder)
        self.name = pathlib.Path(folder).name
        deck = self.results.record()["deck"]
        self.radius = deck["boundaries"]["body"]["to"]
        self.jet = deck["boundaries"]["jet"]["to"]
        centres = np.asarray(self.results.centres)
        self.r, self.z = (np.unique(np.round(centres[:, axis], 12)) for axis in (0, 1))
        self.order = np.lexsort((centres[:, 0], centres[:, 1]))
        if len(self.r) * len(self.z) != len(self.order):
            raise ResultsError(f"{folder}: not a mesh of rows and columns")
        self.u = self.field("velocity", 1)
        self.mixture = self.field("mixture_fraction")
        self.temperature = self.field("temperature")

    def field(self, name, component=None):
        values = self.results.field(name)
        if values is None:
            return None
        values = np.asarray(values)
        values = values if component is None else values[:, component]
        return values[self.order].reshape(len(self.z), len(self.r))

    def across(self, field, diameters):
        """Over the radius, at a distance from the body."""
        place = 2 * self.radius * diameters
        k = int(np.clip(np.searchsorted(self.z, place), 1, len(self.z) - 1))
        share = np.clip((place - self.z[k - 1]) / (self.z[k] - self.z[k - 1]), 0, 1)
        return (1 - share) * field[k - 1] + share * field[k]

    def bubble_end(self):
        behind = self.u[:, (self.r < self.radius) & (self.r > self.jet)].min(axis=1)
        last = np.flatnonzero(behind < 0)
        if last.size == 0 or last[-1] + 1 == len(self.z):
            return None
        k = last[-1]
        place = self.z[k] - behind[k] * (self.z[k + 1] - self.z[k]) / (behind[k + 1] - behind[k])
        return float(place / (2 * self.radius))
