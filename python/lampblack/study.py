"""The results of a study: a table with a row a run, and the runs."""

import collections.abc
import csv
import json
import pathlib

from .arrays import table_of_csv
from .damage import reading
from .errors import ResultsError


def is_study(folder):
    return (pathlib.Path(folder) / "study.json").is_file()


def read_table(path):
    """Rows of a CSV table as dictionaries; units in brackets are cut off the names."""
    if not path.is_file():
        return []
    with open(reading(path), newline="", encoding="utf-8") as file:
        return [{key.split(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]


class Study(collections.abc.Mapping):
    """Runs by name, each opened when it is asked for. `table` has a row for each, with what was varied and what came out."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not is_study(self.folder):
            raise ResultsError(f"{self.folder}: there is no study.json here; expected the folder of a finished study")
        self.record = json.loads(reading(self.folder / "study.json").read_text(encoding="utf-8"))
        self._names = [run["run"] for run in self.record["runs"]]

    @property
    def table(self):
        return table_of_csv(self.folder / "study.csv")

    @property
    def failed(self):
        """Messages of the runs that failed, by name."""
        return {run["run"]: run["message"] for run in self.record["runs"] if run["status"] != "done"}

    def stacked(self, name="table.csv"):
        """A table of the runs, one below the other, as far as the study collected it."""
        path = self.folder / f"study_{name}"
        if not path.is_file():
            raise ResultsError(f"{path}: there is no such table; a study collects those of its key collect.tables")
        return table_of_csv(path)

    def __getitem__(self, name):
        from .results import Results

        if name not in self._names:
            raise KeyError(name)
        return Results(self.folder / name)

    def __iter__(self):
        return iter(self._names)

    def __len__(self):
        return len(self._names)
