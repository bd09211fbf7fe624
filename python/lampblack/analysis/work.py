"""What the tasks of an analysis share: the problem, its runs, its folder, what is said."""

import pathlib

import numpy as np

from ..errors import InputError, NumericsError
from ..spreadsheet import Sheet
from . import designs
from .runs import BEYOND, Runs
from .surrogate import Surrogate


class Work:
    """`beside`: the folder is that of a fit, whose files stay as they are."""

    def __init__(self, problem, folder, ranks=None, jobs=None, beside=False):
        self.problem, self.folder, self.beside = problem, pathlib.Path(folder), beside
        named = problem.options.get("runs")
        self.runs = Runs(problem, problem.folder / named if named else self.folder / "runs", ranks, jobs)
        self.lines, self.warnings = [], []

    @property
    def options(self):
        return self.problem.options

    @property
    def seed(self):
        return self.options["design"]["seed"]

    def file(self, name):
        """Where a table, the record or the report is written."""
        return self.folder / ({"analysis.json": "propagated.json"}.get(name, f"propagated_{name}") if self.beside else name)

    def say(self, text):
        """On the console and in the report."""
        print(text, flush=True)
        self.lines.append(text)

    def warn(self, text):
        self.warnings.append(text)
        self.say(f"warning: {text}")

    def design(self):
        """The points of the section `design`."""
        design, d = self.options["design"], self.problem.dimensions
        if design["type"] == "sobol":
            return designs.sobol(design["points"], d, self.seed)
        if design["type"] == "latin_hypercube":
            return designs.latin_hypercube(design["points"], d, self.seed)
        if design["type"] == "factorial":
            return designs.factorial(design["levels"], d)
        if design["type"] == "one_at_a_time":
            return designs.one_at_a_time(self.problem.start, design["levels"])
        if "file" not in design:
            raise InputError("design.file: the type file needs the name of a CSV file with a column a parameter")
        try:
            sheet = Sheet(self.problem.folder / design["file"])
        except OSError as error:
            raise InputError(f"design.file: {design['file']}: {error.strerror}") from error
        (_, head), *rows = sheet.rows or [(1, [])]
        for p in self.problem.parameters:
            if p.name not in head:
                raise InputError(f"design.file: {design['file']} has no column {p.name}")
        for line, row in rows:
            if len(row) != len(head):
                raise InputError(f"{design['file']}:{line}: {len(head)} fields are expected, found {len(row)}")
        points = np.column_stack([p.place(np.array([sheet.number(row[head.index(p.name)], f"{design['file']}:{line}") for line, row in rows]))
                                  for p in self.problem.parameters])
        if not np.all((points > -1e-9) & (points < 1 + 1e-9)):
            raise InputError(f"design.file: a row {int(np.argmin(np.all((points > -1e-9) & (points < 1 + 1e-9), axis=1))) + 1} is beyond the bounds")
        return np.clip(points, 0, 1)

    def asked(self, points, outputs, what):
        """Values and errors of runs, and what was run."""
        before = self.runs.begun
        values, errors = self.runs.values(points, outputs)
        failed = int(np.sum(~np.all(np.isfinite(values), axis=1)))
        self.say(f"{what}: {len(points)} points, {self.runs.begun - before} new runs" + (f", {failed} points failed" if failed else ""))
        if failed == len(points):
            raise NumericsError(f"{what}: no point has all its numbers: {self.runs.failure(points[0], outputs) or BEYOND}")
        for k, o in enumerate(outputs):
            lost = int(np.sum(values[:, k] <= 0)) if o.quantity.is_log else 0
            if lost:
                self.warn(f"{what}: {lost} of {len(points)} values of {o.name} are not above 0 and have no logarithm; these points are left out. Choose "
                          f"ranges in which it is above 0, or quantities.{o.quantity.name}.transform: none")
        return values, errors

    def surrogates(self, points, values, names, noise, enough=None):
        """One of each column of values, from the points that ran, of which `noise` is the standard error in the mean. NumericsError where one is too poor, unless it misses by less than is
        `enough` for its column: what hardly changes need not be known well."""
        options = self.options["surrogate"]
        made = []
        for k, name in enumerate(names):
            good = np.isfinite(values[:, k])
            made.append(Surrogate(points[good], values[good, k], options["order"], options["pairs"], noise[k]))
            if made[-1].r2 < options["least_r2"] and (enough is None or made[-1].deviation > enough[k]):
                raise NumericsError(
                    f"surrogate: that of {name} has R2 = {made[-1].r2:.3f} at the points held out, below surrogate.least_r2 = {options['least_r2']:g}; "
                    "more points (design.points), smaller ranges, a higher order, or a transform of the quantity may help")
        self.say(f"surrogates: R2 of the points held out {min(s.r2 for s in made):.4f} at least, {np.median([s.r2 for s in made]):.4f} in the middle; "
                 f"{max(len(s.terms) for s in made)} terms at most")
        return made
