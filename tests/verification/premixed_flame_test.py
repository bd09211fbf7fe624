"""A flat premixed flame that is marched in time (cases/flow/premixed_methane) against the one-dimensional flame that it starts from:
it has to burn at that flame's speed and keep its shape.

Usage: premixed_flame_test.py EXECUTABLE MPIEXEC...

The bounds are twice what the case's README has measured on its mesh.
"""

import csv
import pathlib
import sys
import tempfile

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/app"))
import running  # noqa: E402

CASE = SOURCE / "cases/flow/premixed_methane"
SPEED = 0.39642  # m/s, of the one-dimensional flame and of the fresh gas
TRACE = 1e-4  # mole fraction, below which a species is not looked at
FRONT = 1000.0  # K, where the flame is


def place_of_front(x: np.ndarray, temperature: np.ndarray) -> float:
    return float(np.interp(FRONT, temperature, x))


def main(executable: str, mpiexec: list) -> None:
    with tempfile.TemporaryDirectory() as folder:
        results = pathlib.Path(folder) / "run"
        run = running.Program(executable, mpiexec, 2)("run", CASE / "deck.yaml", "--set", "time.end=2 ms", "--out", results)
        assert run.code == 0, run.err
        with h5py.File(results / "results.h5") as file:
            x = file["mesh/cellCentre"][:, 0]
            order = np.argsort(x)
            x = x[order]
            outputs = [file["steps"][name] for name in sorted(file["steps"])]
            times = [step.attrs["time"] for step in outputs]
            places = [place_of_front(x, step["temperature"][:].ravel()[order]) for step in outputs]
            last = {name: outputs[-1][name][:].ravel()[order] for name in outputs[-1] if name == "temperature" or name[:2] == "X_"}
    speed = SPEED - (places[-1] - places[-2]) / (times[-1] - times[-2])
    print(f"speed {speed:.5f} m/s, {speed / SPEED - 1:+.3%}")
    assert abs(speed / SPEED - 1) < 2e-3

    with open(CASE / "reference/flame1d.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    reference = {name.split(" [")[0]: np.array([float(row[name]) for row in table]) for name in table[0]}
    z = reference["z"] - place_of_front(reference["z"], reference["temperature"]) + places[-1]
    inside = x < 0.9 * x[-1]  # the outlet is felt in the last cell
    for name, values in last.items():
        largest = reference[name].max()
        if largest < TRACE:
            continue
        off = np.abs(values - np.interp(x, z, reference[name]))[inside].max() / largest
        print(f"{name}: {off:.3%} of its largest value")
        assert off < 1e-2, name


main(sys.argv[1], sys.argv[2:])
