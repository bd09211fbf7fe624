"""A results folder: the mesh, the steps, their fields, trajectories, history and run record."""

import contextlib
import csv
import json
import pathlib

import h5py
import numpy as np

from .arrays import Array, Table, array_of, table_of, table_of_csv, text_of
from .damage import reading
from .distributions import distributions_of
from .errors import ResultsError
from .places import LineOfPlaces


# Other names that mechanisms use for the same species.
ALIASES = {"A1": ["A1", "C6H6"], "A2": ["A2", "C10H8"], "A4": ["A4", "C16H10"]}


def unit_of(dataset):
    """The unit of a dataset."""
    return text_of(dataset.attrs.get("unit", ""))


@contextlib.contextmanager
def opened(path, what):
    """The results of a run, named by its folder or by themselves. ResultsError where they are missing or, while they are
    open, turn out to lack what is read from them: `what`, in words."""
    path = pathlib.Path(path)
    file = path / "results.h5" if path.is_dir() else path
    if not file.is_file():
        raise ResultsError(f"{file}: there is no such file; expected the folder of a run or its results.h5")
    try:
        with h5py.File(reading(file), "r") as results:
            yield results
    except OSError as error:
        raise ResultsError(f"{file}: cannot be read ({error})") from error
    except KeyError as error:
        raise ResultsError(f"{file}: holds no {what} ({error.args[0]})") from error


class Results:
    """A run's results; `file` is results.h5 itself, opened by h5py."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        candidates = [self.folder / "results.h5", self.folder / "results.h5.part"]
        path = next((p for p in candidates if p.is_file()), None)
        if path is None:
            raise ResultsError(f"{self.folder}: there is no results.h5 here; expected the folder of a run or study")
        try:
            self.file = h5py.File(reading(path), "r")
        except OSError as error:
            raise ResultsError(f"{path}: cannot be opened ({error}); is the run still going?") from error
        self.partial = path.name.endswith(".part")
        # Reactors, populations and one-dimensional flames have no mesh.
        problem = "flow" if "mesh" in self.file else self.record().get("deck", {}).get("problem")
        self.is_reactor = problem == "reactor"
        self.is_population = problem == "population_balance"
        self.is_flame = "flame" in self.file
        self.is_along = problem in ("prescribed_gas", "particles_along")  # the second: before version 0.2
        self.is_pah = problem == "pah"
        self.is_aggregates = problem == "aggregates"
        self.is_engine = problem == "engine"
        self.is_flow = not (self.is_along or self.is_reactor or self.is_population or self.is_flame or self.is_pah or self.is_aggregates or self.is_engine)
        if not self.is_flow:
            return
        if "mesh" not in self.file or "cellCentre" not in self.file["mesh"]:
            raise ResultsError(f"{path}: holds no mesh")
        mesh = self.file["mesh"]
        self.centres = mesh["cellCentre"][()]
        self.vertices = mesh["vertices"][()]
        self.cells = mesh["cells"][()]
        self.is_plane = int(mesh.attrs["dimension"]) == 2 if "dimension" in mesh.attrs else self.cells.shape[1] <= 4

    @property
    def material(self):
        """What the particles of a flow are called, as the names of their fields begin: "soot" where there are none."""
        return next((name.removesuffix("_sizes") for name in self.file if name.endswith("_sizes")), "soot")

    @property
    def steps(self):
        """Names of the steps in order of time."""
        group = self.file.get("steps", {})
        return sorted(group, key=lambda name: int(name))

    def time(self, step):
        return float(self.file["steps"][step].attrs.get("time", np.nan))

    def fields(self, step):
        return self.file["steps"][step]

    def field(self, name, step=None):
        """A field of a step (the last one), or None where it was not written."""
        steps = self.steps
        if not steps:
            return None
        group = self.fields(step or steps[-1])
        names = [name]
        if name.startswith("X_"):
            names += ["X_" + alias for alias in ALIASES.get(name[2:], [])]
        by_lower = {key.lower(): key for key in group}
        for candidate in names:
            if candidate in group:
                return array_of(group[candidate])
            if candidate.lower() in by_lower:
                return array_of(group[by_lower[candidate.lower()]])
        return self._mass_fraction(name[2:], group) if name.startswith("Y_") else None

    def _mass_fraction(self, species, group):
        """From the mole fractions of all species; None where they were not all written."""
        if "species" not in self.file:
            return None
        names = [text_of(name) for name in self.file["species/name"][()]]
        by_lower = {name.lower(): name for name in names}
        species = species if species in names else by_lower.get(species.lower())
        if species is None or any("X_" + name not in group for name in names):
            return None
        masses = dict(zip(names, self.file["species/molar_mass"][()]))
        mean = sum(masses[name] * group["X_" + name][()] for name in names)
        return Array(masses[species] * group["X_" + species][()] / mean, "Y_" + species, "1", f"mass fraction of {species}")

    def centreline(self):
        """Cells of the column nearest the axis, of a planar mesh nearest its middle, sorted along it; and their places in m.
        Where cells do not stand in columns: those that the axis, or the line through the middle, goes through."""
        r = self.centres[:, 0]
        away = np.abs(r - (0.5 * (self.vertices[:, 0].min() + self.vertices[:, 0].max()) if self._is_planar() else r.min()))
        nearest = r[np.argmin(away)]
        column = np.flatnonzero(np.abs(r - nearest) <= 1e-6 * max(np.ptp(r), 1e-300))
        if not self.is_box():
            corners = self.vertices[self.cells][:, :, 0]
            inside = nearest if self._is_planar() else 1e-6 * np.ptp(r) + corners.min()
            column = np.flatnonzero((corners.min(axis=1) <= inside) & (corners.max(axis=1) > inside))
        column = column[np.argsort(self.centres[column, 1])]
        return column, self.centres[column, 1]

    def is_box(self):
        """Whether the cells stand in columns, one over the other."""
        return not any(key in self._mesh_of_deck() for key in ("file", "floor", "ceiling"))

    def touches_axis(self):
        """Whether the mesh is the right half of something mirrored about r = 0."""
        r = self.vertices[:, 0]
        return bool(r.min() > -1e-12 and r.min() < 1e-9 + 1e-6 * np.ptp(r)) and not self._is_planar()

    def axis_names(self):
        """Of the two axes of the plane."""
        return ("x", "y") if self._is_planar() else ("r", "z")

    def _mesh_of_deck(self):
        deck = self.record().get("deck") or {}
        mesh = deck.get("mesh") if isinstance(deck, dict) else {}
        return mesh if isinstance(mesh, dict) else {}

    def _is_planar(self):
        words = [str(value).lower() for value in self._mesh_of_deck().values()]
        return "planar" in words or "cartesian" in words or "space" in words

    def record(self):
        """run.json, or nothing where it is missing or damaged."""
        try:
            record = json.loads(reading(self.folder / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return record if isinstance(record, dict) else {}

    def trajectories(self):
        group = self.file.get("trajectories", {})
        return {name: group[name] for name in group}

    def ignition_delays(self):
        """Seconds by the name of the criterion; nan where it was not met."""
        group = self.file.get("ignition", {})
        return {name: float(group[name]["delay"][()]) for name in group}

    def reactors(self):
        """Names and columns {name: values} of the reactors in a network, or nothing."""
        group = self.file.get("reactors")
        if group is None:
            return None
        names = group.attrs["names"]
        names = names.decode("utf-8") if isinstance(names, bytes) else str(names)
        return next(csv.reader([names])), {name: group[name][()] for name in group}

    def history(self):
        """The rows of the history, from the results file or else from history.csv; none where there is no history."""
        group = self.file.get("history")
        if group is not None:
            return table_of(group)
        path = self.folder / "history.csv"
        return table_of_csv(path) if path.is_file() else Table({})

    def profile(self):
        """Of a one-dimensional flame: what /flame has at its points, species as X_<name> and Y_<name>, soot as soot_<name>; the
        columns of profile.csv, and mass fractions."""
        if not self.is_flame:
            raise ResultsError(f"{self.folder}: these are not the results of a one-dimensional flame")
        flame = self.file["flame"]
        points = flame["z"].shape[0]
        columns = dict(table_of(flame))
        for group, prefix in (("X", "X_"), ("Y", "Y_"), ("soot", "soot_"), ("soot/processes", "soot_")):
            for name, dataset in flame.get(group, {}).items():
                if getattr(dataset, "shape", None) == (points,):
                    columns[prefix + name] = array_of(dataset, prefix + name)
        return Table(columns)

    def cell_table(self, step=None):
        """Of a flow: the centres of the cells and all fields of a step (the last one)."""
        if not self.steps:
            raise ResultsError(f"{self.folder}: these results have no fields of a flow")
        axes = self.axis_names() if self.is_plane else ("x", "y", "z")
        columns = {name: Array(self.centres[:, i], name, "m", "centre of the cell") for i, name in enumerate(axes)}
        return Table({**columns, **table_of(self.fields(step or self.steps[-1]))})

    def line(self, start, end, points=101, fields=None, step=None):
        """Of a flow: a step (the last one) along a straight line between two places in m, (r, z), (x, y) or (x, y, z). Columns are
        `distance` and the coordinates of the points, then all fields, or those of these names. Values are linear between the centre
        of a cell and its corners, where they come from the cells around and never lie beyond what these have."""
        if self.is_flame or self.is_reactor or self.is_population or self.is_along or not self.steps:
            raise ResultsError(f"{self.folder}: these results have no fields of a flow")
        if step is not None and step not in self.file["steps"]:
            raise ResultsError(f"{self.folder}: there is no step '{step}'; these are there: {', '.join(self.steps)}")
        named = {}
        for name in fields if fields is not None else self.fields(step or self.steps[-1]):
            named[name] = self.field(name, step)
            if named[name] is None:
                raise ResultsError(f"{self.folder}: the results hold no field '{name}'")
        line = LineOfPlaces(self, start, end, points)
        axes = self.axis_names() if self.is_plane else ("x", "y", "z")
        columns = {"distance": Array(line.distance, "distance", "m", "from the line's first point")}
        columns.update((axis, Array(line.places[:, i], axis, "m", "coordinate of the point")) for i, axis in enumerate(axes))
        columns.update((name, Array(line.values(np.asarray(values)), name, values.unit, values.description))
                       for name, values in named.items())
        return Table(columns)

    def table(self, name):
        """Any group of results.h5 as a table ('probes/tip', 'rates', 'methods/dsmc/history'), or a CSV file of the folder."""
        group = self.file.get(name)
        if group is not None and hasattr(group, "keys"):
            return table_of(group)
        path = self.folder / name
        if path.is_file() and path.suffix == ".csv":
            return table_of_csv(path)
        raise ResultsError(f"{self.folder}: there is no table '{name}', neither a group of results.h5 nor a CSV file")

    def distributions(self):
        """Size distributions by name (`Distribution`)."""
        return distributions_of(self)

    def numbers(self):
        """The results that are single numbers: the object "results" of run.json."""
        return self.record().get("results", {})
