"""Fields of OpenFOAM, and how far a run is from a tight one of the same program on the same mesh: used by scripts/compare_openfoam."""

import pathlib
import re
import sys

import numpy as np

from ..damage import ResultsError, guarded, reading
from ..results import Results

SPECIES = ["CH4", "O2", "CO2", "CO", "OH"]


def last_time(case):
    """The folder of a case's largest time."""
    times = {}
    for folder in pathlib.Path(case).iterdir():
        try:
            times[float(folder.name)] = folder
        except ValueError:
            continue
    if not times or max(times) == 0:
        raise ResultsError(f"{case}: holds no time but the start; reconstructPar makes them from those of the ranks")
    return times[max(times)]


def read_field(path):
    """A scalar of every cell, as OpenFOAM writes it in ascii. One number where the field is uniform."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise ResultsError(f"{path}: there is no such file")
    text = reading(path).read_text(encoding="utf-8")
    uniform = re.search(r"^internalField\s+uniform\s+([^;(]+);", text, re.MULTILINE)
    if uniform:
        return np.array([float(uniform.group(1))])
    listed = re.search(r"^internalField\s+nonuniform\s+List<scalar>\s+(\d+)\s*\(([^()]*)\)", text, re.MULTILINE)
    if not listed:
        raise ResultsError(f"{path}: holds no field of scalars in ascii")
    values = np.array(listed.group(2).split(), dtype=float)
    if values.size != int(listed.group(1)):
        raise ResultsError(f"{path}: {values.size} values where {listed.group(1)} are announced")
    return values


def openfoam_fields(case):
    folder = last_time(case)
    return {name: read_field(folder / name) for name in ["T"] + SPECIES}


def own_fields(folder):
    results = Results(folder)
    fields = {name: results.field("temperature" if name == "T" else "X_" + name) for name in ["T"] + SPECIES}
    missing = [name for name, values in fields.items() if values is None]
    if missing:
        raise ResultsError(f"{folder}: holds no field of {', '.join(missing)}")
    return fields


def fields_of(path):
    """T and the species of a run of either program: mass fractions of OpenFOAM, mole fractions of Lampblack."""
    return openfoam_fields(path) if (pathlib.Path(path) / "system").is_dir() else own_fields(path)


def differences(run, tight):
    """{name: (largest, mean)}: of T in K, of a species over its largest value in the tight run."""
    rows = {}
    for name in run:
        scale = 1.0 if name == "T" else np.max(np.abs(tight[name])) or 1.0
        away = np.abs(run[name] - tight[name]) / scale
        rows[name] = float(np.max(away)), float(np.mean(away))
    return rows


def short(value):
    """Two digits, without an exponent where that is shorter."""
    return f"{value:.0f}" if value >= 100 else f"{value:.2g}"


def main():
    """LABEL RUN TIGHT, any number of times: a table of largest and mean differences."""
    names = ["T"] + SPECIES
    print(f"{'largest / mean difference':<30}{'T, K':>20}" + "".join(f"{name + ', %':>20}" for name in SPECIES))
    words = sys.argv[1:]
    for label, run, tight in zip(words[::3], words[1::3], words[2::3]):
        rows = differences(fields_of(run), fields_of(tight))
        cells = [" / ".join(short(value * (1 if name == "T" else 100)) for value in rows[name]) for name in names]
        print(f"{label:<30}" + "".join(f"{cell:>20}" for cell in cells))
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
