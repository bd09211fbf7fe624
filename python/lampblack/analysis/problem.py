"""An analysis as it was read by its schema: parameters, experiments, quantities."""

import math
import pathlib
import re

import numpy as np
from scipy.stats import norm

from ..errors import InputError

_NAME = re.compile(r"[A-Za-z_]\w*$")
_PLACE = re.compile(r"\{([A-Za-z_]\w*)(?:\*([\d.]+(?:[eE][+-]?\d+)?))?\}")  # {A}, or a multiple of it: {f*0.002}

_BRACES = re.compile(r"\{[^{}:,]*\}")  # what looks like a place: a map of YAML has a colon


class Parameter:
    """One parameter; on its scale the range goes from 0 to 1."""

    def __init__(self, given, where):
        self.name, self.low, self.high = given["name"], given["from"], given["to"]
        self.is_log = given["scale"] == "log"
        self.set, self.shift = given["set"], given["shift"]
        if not _NAME.match(self.name):
            raise InputError(f"{where}.name: letters, digits and _ are expected, found '{self.name}'")
        if not self.low < self.high:
            raise InputError(f"{where}.to: a value above from ({self.low:g}) is expected, found {self.high:g}")
        if self.is_log and self.low <= 0:
            raise InputError(f"{where}.from: a logarithmic scale needs bounds above 0, found {self.low:g}")
        prior = given.get("prior", {"type": "uniform"})
        self.prior, self.prior_mean, self.prior_deviation = prior["type"], prior.get("mean"), prior.get("deviation")
        if self.prior == "lognormal" and (self.prior_mean <= 0 or self.low <= 0):
            raise InputError(f"{where}.prior: a lognormal parameter has a mean and bounds above 0")
        if self.prior != "uniform" and np.ptp(self._prior_ends()) < 1e-12:
            raise InputError(f"{where}.prior: nothing of it lies between the bounds {self.low:g} and {self.high:g}")
        self.start = given.get("start", self.value(0.5))
        if not self.low <= self.start <= self.high:
            raise InputError(f"{where}.start: a value from {self.low:g} to {self.high:g} is expected, found {self.start:g}")

    def value(self, x):
        """Of a place on the scale."""
        return self.low * (self.high / self.low) ** x if self.is_log else self.low + (self.high - self.low) * x

    def place(self, value):
        return np.log(value / self.low) / math.log(self.high / self.low) if self.is_log else (value - self.low) / (self.high - self.low)

    def slope(self, x):
        """d value / d x."""
        return self.value(x) * math.log(self.high / self.low) if self.is_log else self.high - self.low

    def score(self, x):
        """Distance from the prior's mean in its deviations; nothing with a uniform prior."""
        if self.prior == "uniform":
            return None
        value = self.value(x)
        return (np.log(value / self.prior_mean) if self.prior == "lognormal" else value - self.prior_mean) / self.prior_deviation

    def log_prior(self, x):
        """Of the density over x, but for a constant; uniform means uniform on the parameter's scale."""
        score = self.score(x)
        if score is None:
            return np.zeros(np.shape(x))
        measure = self.slope(x) / self.value(x) if self.prior == "lognormal" else self.slope(x)
        return -0.5 * score**2 + np.log(measure)

    def _prior_ends(self):
        """Shares of the prior below both bounds."""
        return norm.cdf([self.score(0.0), self.score(1.0)])

    def drawn(self, share):
        """The place on the scale below which this share of the prior between the bounds lies."""
        if self.prior == "uniform":
            return np.asarray(share)
        ends = self._prior_ends()
        score = norm.ppf(ends[0] + np.asarray(share) * (ends[1] - ends[0]))
        value = self.prior_mean * np.exp(score * self.prior_deviation) if self.prior == "lognormal" else self.prior_mean + score * self.prior_deviation
        return np.clip(self.place(value), 0, 1)


class Experiment:
    def __init__(self, given, folder, where):
        self.deck = (folder / given["deck"]).resolve()
        if not self.deck.is_file():
            raise InputError(f"{where}.deck: there is no file {self.deck}")
        stem = self.deck.parent.name if self.deck.stem == "deck" else self.deck.stem
        self.name, self.set, self.weight, self.use = given.get("name", stem), given["set"], given.get("weight", 1.0), given["use"]
        self.abscissa_from, self.abscissa_to = given.get("abscissa_from", -math.inf), given.get("abscissa_to", math.inf)


class Quantity:
    def __init__(self, name, given, where):
        self.name, self.result, self.table = name, given.get("result"), given.get("table")
        self.column, self.along, self.error = given.get("column"), given.get("along"), given.get("error")
        self.take, self.is_log = given["take"], given["transform"] == "log10"
        if (self.result is None) == (self.table is None):
            raise InputError(f"{where}: either result or table is expected")
        if self.table is not None and self.column is None:
            raise InputError(f"{where}.column: a table needs the name of a column")
        for key, given_too in (("column", self.column), ("along", self.along), ("take", self.take != "last")):
            if self.result is not None and given_too:
                raise InputError(f"{where}.{key}: this is for a table; a result is one number already")

    def transformed(self, values):
        if not self.is_log:
            return np.asarray(values, float)
        with np.errstate(divide="ignore", invalid="ignore"):
            values = np.asarray(values, float)
            return np.where(values > 0, np.log10(values), np.nan)

    def transformed_error(self, values, errors):
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(errors) / (np.asarray(values, float) * math.log(10)) if self.is_log else np.asarray(errors, float)

    def back(self, values):
        return 10 ** np.asarray(values) if self.is_log else np.asarray(values)


class Problem:
    """`options` is the analysis as the program has resolved it, defaults included; `path` its file."""

    def __init__(self, options, path):
        self.options, self.path = options, pathlib.Path(path)
        self.name, folder = options["analysis"], self.path.resolve().parent
        self.folder = folder
        try:
            self.parameters = [Parameter(one, f"parameters[{i}]") for i, one in enumerate(options["parameters"])]
            self.experiments = [Experiment(one, folder, f"decks[{i}]") for i, one in enumerate(options["decks"])]
            self.quantities = {name: Quantity(name, one, f"quantities.{name}") for name, one in options["quantities"].items()}
            self._check()
        except InputError as error:
            raise InputError(f"{path}: {error.message}") from error

    def _check(self):
        for what, names in (("parameters", [p.name for p in self.parameters]), ("decks", [e.name for e in self.experiments])):
            for name in names:
                if names.count(name) > 1:
                    raise InputError(f"{what}: the name {name} is given twice")
        names, decks, keys = [p.name for p in self.parameters], [e.name for e in self.experiments], {}
        for i, parameter in enumerate(self.parameters):
            for assignment in parameter.set:
                key = assignment.partition("=")[0]
                if "=" not in assignment or not key:
                    raise InputError(f"parameters[{i}].set: assignments such as 'particles.alpha={{{parameter.name}}}' are expected, found '{assignment}'")
                if key in keys:
                    raise InputError(f"parameters[{i}].set: {key} is set by the parameter {keys[key]} already; one assignment may have several "
                                     "parameters in it")
                keys[key] = parameter.name
                for braces in _BRACES.findall(assignment):
                    if braces != "{}" and not _PLACE.fullmatch(braces):
                        raise InputError(f"parameters[{i}].set: '{braces}' is not understood; a parameter {{{parameter.name}}} or a multiple "
                                         f"{{{parameter.name}*0.5}} is expected")
                for name, _ in _PLACE.findall(assignment):
                    if name not in names:
                        raise InputError(f"parameters[{i}].set: there is no parameter {name}, which stands in '{assignment}'")
            for name in parameter.shift:
                if name not in decks:
                    raise InputError(f"parameters[{i}].shift: there is no deck of the name {name}; expected one of {', '.join(decks)}")
        used = {name for p in self.parameters for assignment in p.set for name, _ in _PLACE.findall(assignment)}
        for i, parameter in enumerate(self.parameters):
            if parameter.name not in used and not parameter.shift:
                raise InputError(f"parameters[{i}].set: {{{parameter.name}}} stands in no assignment, so that the parameter changes nothing")

    @property
    def dimensions(self):
        return len(self.parameters)

    @property
    def start(self):
        return np.array([float(p.place(p.start)) for p in self.parameters])

    def values(self, x):
        """Parameters by name at a point of the unit cube."""
        return {p.name: float(p.value(float(at))) for p, at in zip(self.parameters, x)}

    def settings(self, experiment, x):
        """What a run of this experiment is told at a point."""
        values = self.values(x)
        filled = [_PLACE.sub(lambda match: repr(values[match[1]] * float(match[2] or 1)), text) for p in self.parameters for text in p.set]
        return [*experiment.set, *filled]

    def shift(self, experiment, x):
        """What is added to the abscissae of its measurements."""
        return sum(p.value(float(at)) for p, at in zip(self.parameters, x) if experiment.name in p.shift)
