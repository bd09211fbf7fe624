"""What scripts/bluff_body_inlets makes of a pipe's run, and what scripts/compare_bluff_body and
scripts/bluff_body_soot say of runs, on results written here."""

import csv
import json
import pathlib
import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

from flow_scripts_test import called, write_run

R, D = 0.025, 0.05
BODY = {"boundaries": {"jet": {"to": 1.8e-3}, "body": {"from": 1.8e-3, "to": R}}}


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [[float(value) for value in row.values()] for row in csv.DictReader(file)]


def check_inlets(folder):
    """A velocity that falls from the axis as the square of the radius, k as the cube of it, omega 5e4 1/s: of mean velocity 50 m/s."""
    r = np.linspace(0, 1.8e-3, 41)
    run = write_run(folder / "pipe", r, np.array([0, 1e-3, 2e-3]), lambda r, z: 294 + 0 * r)
    with h5py.File(run / "results.h5", "r+") as file:
        step, at = file["steps/000003"], file["mesh/cellCentre"][()][:, 0]
        inner = np.tile(r[:-1], 2)
        file["mesh/cellVolume"] = 0.5 * (np.tile(r[1:], 2) ** 2 - inner**2) * 1e-3
        u = 1.0 - (at / 1.8e-3) ** 2
        volume = file["mesh/cellVolume"][()]
        u *= 50.0 / (np.sum(u * volume) / np.sum(volume))
        step["velocity"] = np.stack([0 * at, u, 0 * at], axis=1)
        step["turbulent_kinetic_energy"], step["omega_root"] = 2.0 + 1e9 * at**3, 0 * at + 5e4**-0.5
    code, told, err = called("bluff_body_inlets", run, "--jet", 100, "--coflow", 20, "--out", folder / "tables")
    assert code == 0 and "mean velocity of 50.00 m/s" in told, told + err
    jet = np.array(rows(folder / "tables/jet.csv"))
    at = jet[:, 0] * 1e-3
    energy = 4 * (2.0 + 1e9 * at**3)
    assert len(jet) == 40 and np.allclose(jet[:, 2], energy, rtol=1e-5) and np.allclose(jet[:, 3], 2 * 0.09 * energy * 5e4, rtol=1e-5)
    shares = np.diff(r**2) / 1.8e-3**2
    assert abs(np.sum(jet[:, 1] * shares) - 100) < 1e-3
    stream = np.array(rows(folder / "tables/coflow.csv"))
    assert 25 <= stream[0, 0] < stream[-1, 0] <= 30.01 and abs(stream[-1, 1] - 20) < 1e-3
    # Beyond the layer: fluctuations of 2.81 % along the stream, three quarters of that across; eddies of 4 mm.
    k = 0.5 * (1 + 2 * 0.75**2) * (0.0281 * 20) ** 2
    assert abs(stream[-1, 2] / k - 1) < 1e-4 and abs(stream[-1, 3] / (0.09**0.75 * k**1.5 / 4e-3) - 1) < 1e-4
    # The same pipe's time of eddies, 1/(0.09 omega), in the measured velocity and energy of Sandia's flame D.
    code, told, err = called("sandia_d_inlets", run, "--length", 2e-3, "--out", folder / "sandia_d")
    assert code == 0 and "mean velocity of 51.2" in told, told + err
    jet, pilot = (np.array(rows(folder / f"sandia_d/{name}.csv")) for name in ("jet", "pilot"))
    assert len(jet) == 9 and jet[0, 1] == 62.9543 and abs(jet[0, 2] - 0.5 * (6.1283676 + 2 * 2.2074115)) < 1e-4 and jet[-1, 0] == 3.6
    mean = float(told.split("velocity of ")[1].split()[0])
    assert np.allclose(jet[:-1, 3], jet[:-1, 2] * 0.09 * 5e4 * mean / 50, rtol=1e-3), jet
    assert len(pilot) == 11 and pilot[1, 1] == 11.4645 and np.allclose(pilot[:, 3], 0.09**0.75 * pilot[:, 2] ** 1.5 / 2e-3, rtol=1e-4), pilot
    code, _, err = called("bluff_body_inlets", write_run(folder / "laminar", r, r, lambda r, z: 294 + 0 * r), "--out", folder)
    assert code == 2 and "omega_root" in err, err


def check_comparison(folder):
    """Gas that goes back behind the body up to 1.37 diameters; a temperature and a mixture fraction that fall along the axis."""
    r, z = np.linspace(0, 0.05, 51), np.linspace(0, 0.3, 121)
    run = write_run(folder / "flame", r, z, lambda r, z: np.where(np.abs(r - 0.02) < 1.2e-3, 2000 - 1000 * z, 300), BODY)
    with h5py.File(run / "results.h5", "r+") as file:
        step, centres = file["steps/000003"], file["mesh/cellCentre"][()]
        radius, place = centres[:, 0], centres[:, 1] / D
        u = np.where(radius < 2e-3, 100 - 20 * place, np.where(radius < R, 10 * (place - 1.37), 35))
        step["velocity"] = np.stack([0 * u, u, 0 * u], axis=1)
        step["mixture_fraction"] = np.where(radius < 1e-3, 1 - 0.3 * place, 0)
    code, told, err = called("compare_bluff_body", run, "--json", "--picture", folder / "flame.png")
    assert code == 0 and (folder / "flame.png").stat().st_size > 1000, err
    (found,) = json.loads(told)
    assert abs(found["bubble_end"] - 1.37) < 1e-9 and found["cells"] == 6000, found
    assert len(found["measured_bubble_end"]) == 2 and all(1.5 < end < 1.7 for end in found["measured_bubble_end"]), found
    row = next(row for row in found["velocity"] if row["at"] == 0.6)
    assert abs(row["axis"] - 88) < 1e-9 and abs(row["least"] + 7.7) < 1e-9, row
    assert row["measured_axis"] == [101.03, 102.46] and row["measured_least"] == [-10.53, -10.01], row
    row = found["scalars"][1]
    assert row["at"] == 0.6 and abs(row["mixture"] - 0.82) < 1e-9 and row["measured_mixture"] == 0.8091, row
    assert abs(row["peak"] - 1970) < 1e-6 and row["measured_peak"] == 2134, row
    with h5py.File(run / "results.h5", "r+") as file:
        del file["steps/000003/mixture_fraction"]
    code, told, err = called("compare_bluff_body", run)
    assert code == 0 and "1.370 diameters (measured 0.95, 1.01)" in told and "mixture" not in told, told + err
    code, _, err = called("compare_bluff_body", folder / "nowhere")
    assert code == 2 and "nowhere" in err, err


def check_soot(folder):
    """Gas that goes back up to z/R 2.74, soot around z/R 1, r/R 0.8, sections with modes at 3 and 8 on the axis and one at 5 beside it."""
    r, z = np.linspace(0, 0.05, 51), np.linspace(0, 0.3, 121)
    run = write_run(folder / "sooting", r, z, lambda r, z: 2000 - 1000 * z, BODY)
    with h5py.File(run / "results.h5", "r+") as file:
        step, centres = file["steps/000003"], file["mesh/cellCentre"][()]
        radius, place = centres[:, 0] / R, centres[:, 1] / R
        step["velocity"] = np.stack([0 * place, np.where(radius < 0.08, 30 - place, 10 * (place - 2.74)), 0 * place], axis=1)
        step["mixture_fraction"] = 0.9 - 0.1 * place
        step["soot_volume_fraction"] = 1e-7 * np.exp(-((radius - 0.8) ** 2) - (place - 1) ** 2)
        for section in range(1, 11):
            on_axis = np.exp(-((section - 3) ** 2)) + 0.1 * np.exp(-((section - 8) ** 2)) + 1e-3 * (section == 10)
            step[f"soot_section_{section:02}_aggregates"] = 1e15 * np.where(radius < 0.3, on_axis, np.exp(-((section - 5) ** 2)))
    code, told, err = called("bluff_body_soot", run, "--json")
    assert code == 0, err
    (found,) = json.loads(told)
    assert abs(found["recirculation_end"] - 2.74) < 1e-9, found
    assert abs(found["soot"]["z"] - 1) < 0.1 and abs(found["soot"]["r"] - 0.8) < 0.03 and abs(found["soot"]["largest"] - 1e-7) < 1e-9, found
    assert found["zone"] == found["soot"], found
    row = next(row for row in found["places"] if row["at"] == 2.0)
    assert abs(row["axis"] - 28) < 1e-9 and abs(row["mixture"] - 0.7) < 1e-9 and abs(row["peak"] - 1950) < 1e-6, row
    assert abs(row["soot_at"] - 0.8) < 0.03 and abs(row["soot"] / 1e-7 - np.exp(-1)) < 0.02 and row["soot_on_axis"] < 0.6 * row["soot"], row
    assert row["modes"] == [[3, 8], [5], [5]], row
    code, _, err = called("bluff_body_soot", run, run, "--picture", folder / "soot.png")
    assert code == 0 and (folder / "soot.png").stat().st_size > 1000, err
    code, told, err = called("bluff_body_soot", run)
    assert code == 0 and "gas last goes back at z/R 2.74" in told and "r/R 0: 2 (3 8)" in told, told + err
    code, _, err = called("bluff_body_soot", folder / "nowhere")
    assert code == 2 and "nowhere" in err, err


def main():
    with tempfile.TemporaryDirectory() as scratch:
        check_inlets(pathlib.Path(scratch))
        check_comparison(pathlib.Path(scratch))
        check_soot(pathlib.Path(scratch))
    return 0


if __name__ == "__main__":
    sys.exit(main())
