"""Numbers with their units, and tables of them."""

import collections.abc
import csv

import numpy as np

from .damage import reading
from .errors import InputError
from .units import quantity

trapezoid = getattr(np, "trapezoid", None) or np.trapz  # its name since numpy 2


class Array(np.ndarray):
    """Numbers with `name`, `unit` (SI, '1' for plain numbers) and `description`, which parts of it keep. What is computed from it
    is a plain array, as its unit is another."""

    def __new__(cls, values, name="", unit="", description=""):
        array = np.asarray(values).view(cls)
        array.name, array.unit, array.description = name, unit, description
        return array

    def __array_finalize__(self, source):
        for word in ("name", "unit", "description"):
            setattr(self, word, getattr(source, word, ""))

    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **more):
        if out is not None:
            more["out"] = tuple(_plain(one) for one in out)
        return getattr(ufunc, method)(*map(_plain, inputs), **more)

    def __array_function__(self, function, types, arguments, more):
        return function(*map(_plain, arguments), **{name: _plain(value) for name, value in more.items()})

    @property
    def label(self):
        """For an axis: 'temperature, K'."""
        return f"{self.name}, {self.unit}" if self.unit not in ("", "1") else self.name


def of_particles(group, name):
    """The dataset of a group that begins with the particles' material, such as soot_mean_diameter; or None."""
    return next((group[key] for key in group if key.endswith("_" + name)), None)


def _plain(value):
    if isinstance(value, Array):
        return np.asarray(value)
    return type(value)(map(_plain, value)) if type(value) in (list, tuple) else value


def _sortable(column):
    """A column of quantities as their values, any other as it is."""
    if column.dtype.kind not in "UO" or not len(column):
        return column
    try:
        values, dimensions = zip(*(quantity(str(text)) for text in column))
    except InputError:
        return column
    return np.array(values) if len(set(dimensions)) == 1 else column


class Table(collections.abc.Mapping):
    """Columns by name, each an Array with a row for each point, time or cell. The first is what the rows go along."""

    def __init__(self, columns):
        self._columns = dict(columns)

    def __getitem__(self, name):
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    @property
    def rows(self):
        """How many."""
        return len(next(iter(self.values()))) if self else 0

    @property
    def units(self):
        """By column."""
        return {name: column.unit for name, column in self.items()}

    def __repr__(self):
        return f"<Table of {self.rows} rows: {', '.join(name + (f' [{c.unit}]' if c.unit else '') for name, c in self.items())}>"

    def sorted_by(self, *names, descending=False):
        """The rows in the order of a column, of those alike by the next; numbers that are not known come last. Texts such as '900 K' are
        in the order of their values where all of a column are values of one kind."""
        order = np.lexsort([_sortable(np.asarray(self[name])) for name in reversed(names)], axis=0)
        if descending:
            order = order[::-1]
            known = np.asarray(self[names[0]])[order]
            unknown = np.isnan(known) if known.dtype.kind == "f" else np.zeros(len(order), bool)
            order = np.concatenate([order[~unknown], order[unknown]])
        return Table((name, column[order]) for name, column in self.items())

    def joined(self, other, on):
        """Each row with the columns of the row of another table that has the same in the columns `on` (a name or several); rows without one
        are left out, columns of other kinds than `on` that both have get `_2`. ValueError where the other has two such rows."""
        on = [on] if isinstance(on, str) else list(on)
        places = {}
        for row, key in enumerate(zip(*(np.asarray(other[name]).tolist() for name in on))):
            if key in places:
                raise ValueError(f"two rows of the other table have {', '.join(map(str, key))} in {', '.join(on)}")
            places[key] = row
        pairs = [(row, places[key]) for row, key in enumerate(zip(*(np.asarray(self[name]).tolist() for name in on))) if key in places]
        here, there = (np.array(rows, int) for rows in (zip(*pairs) if pairs else ((), ())))
        columns = {name: column[here] for name, column in self.items()}
        columns.update((name if name not in self else f"{name}_2", column[there]) for name, column in other.items() if name not in on)
        return Table(columns)

    def to_pandas(self):
        """A DataFrame, with the units in attrs['units']; columns of several numbers a row become columns name_0, name_1, ..."""
        import pandas

        flat = {}
        for name, column in self.items():
            parts = {name: column} if column.ndim < 2 else {f"{name}_{i}": column[:, i] for i in range(column.shape[1])}
            flat.update((part, np.asarray(values)) for part, values in parts.items())
        frame = pandas.DataFrame(flat)
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self):
        """A Dataset along the first column, each variable with its unit and description."""
        import xarray

        along = next(iter(self))
        variables = {}
        for name, column in self.items():
            dimensions = (along, *(f"{name}_{i}" for i in range(1, column.ndim)))
            variables[name] = (dimensions, np.asarray(column), {"units": column.unit, "description": column.description})
        return xarray.Dataset(variables)


def text_of(value):
    """h5py gives texts of fixed length as bytes."""
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)


def array_of(dataset, name=None):
    """A dataset of HDF5 with its unit and description; texts as texts."""
    values = dataset[()]
    if values.dtype.kind in "SO":
        values = np.array([text_of(value) for value in np.ravel(values)])
    return Array(values, name or dataset.name.rpartition("/")[2], *(text_of(dataset.attrs.get(word, "")) for word in ("unit", "description")))


def table_of(group):
    """The datasets of a group, those of groups in it left out; what the rows go along comes first."""
    names = [name for name in group if hasattr(group[name], "shape")]
    along = [name for name in ("time", "position", "z", "distance", "step") if name in names]
    return Table((name, array_of(group[name], name)) for name in [*along, *(n for n in names if n not in along)])


def table_of_csv(path):
    """A CSV table of the program, with the units that stand in its header. Columns that are not numbers are texts; a row that is
    being written is left out."""
    lines = list(csv.reader(reading(path).read_text(encoding="utf-8").splitlines()))
    head, rows = (lines[0], [row for row in lines[1:] if len(row) == len(lines[0])]) if lines else ([], [])
    columns = {}
    for place, title in enumerate(head):
        name, _, unit = title.partition(" [")
        columns[name] = Array(_numbers([row[place] for row in rows]), name, unit.rstrip("]"))
    return Table(columns)


def _numbers(texts):
    """Empty fields among numbers are not known: nan."""
    try:
        return np.array([float(text) if text else np.nan for text in texts]) if any(texts) or not texts else np.array(texts)
    except ValueError:
        return np.array(texts)
