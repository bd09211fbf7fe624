"""Opening whatever a run or study left."""

import pathlib

from .analysis.folder import Analysis, is_analysis
from .results import Results
from .study import Study, is_study


def open(path):
    """The results of a run, named by its folder or by its results.h5, or a study or an analysis, by its folder. ResultsError where there are none."""
    path = pathlib.Path(path)
    if path.is_file() and path.name.startswith("results.h5"):
        path = path.parent
    if is_analysis(path):
        return Analysis(path)
    return Study(path) if is_study(path) else Results(path)
