"""What an analysis left, as tables. Needs numpy alone."""

import json
import pathlib

from ..arrays import table_of_csv
from ..damage import reading
from ..errors import ResultsError


def is_analysis(folder):
    return (pathlib.Path(folder) / "analysis.json").is_file()


class Analysis:
    """`record` is analysis.json; tables by the name of their file without its ending: fit, residuals, points, sensitivity, bands, front."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not is_analysis(self.folder):
            raise ResultsError(f"{self.folder}: there is no analysis.json here; expected the folder of an analysis")
        self.record = json.loads(reading(self.folder / "analysis.json").read_text(encoding="utf-8"))

    def has(self, name):
        return (self.folder / f"{name}.csv").is_file()

    def table(self, name):
        if not self.has(name):
            raise ResultsError(f"{self.folder}: this analysis has no table {name}.csv")
        return table_of_csv(self.folder / f"{name}.csv")
