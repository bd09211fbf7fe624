"""Nucleation, coagulation and diffusion in a closed box: stochastic ensembles in the cells against 35 sections.

A row of cells of hot nitrogen has naphthalene at one end. Particles form there, coagulate, and diffuse to the other end as the
naphthalene does; nothing else happens. Both models take from the gas what they make particles of.

Usage: ensembles_closed_box_test.py EXECUTABLE MPIEXEC...

In each cell the mean of the repeats has to be that of many sections, within the 99.9 % interval of the repeats and the distance of 35
sections from many, which is their error of discretisation.
"""

import pathlib
import sys
import tempfile

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/app"))
import running  # noqa: E402

DECK = f"""
problem: flow
mechanism: {SOURCE}/cases/mechanisms/{running.MECHANISM}
pressure: 1 atm
mesh: {{geometry: planar, x: [{{to: 8 mm, cells: 8}}], y: [{{to: 1 mm, cells: 1}}]}}
boundaries:
  west: {{type: wall, side: x-min, temperature: 1600 K}}
  east: {{type: wall, side: x-max, temperature: 1600 K}}
  floor: {{type: symmetry, side: y-min}}
  ceiling: {{type: symmetry, side: y-max}}
initial:
  layer: none
  composition: "N2: 1"
  temperature: 1600 K
  formula: {{X_A2: "2e-5*(1 + tanh((x - 0.004)/0.001))"}}
time: {{end: 30 ms, maximum_step: 0.1 ms}}
output: {{interval: 30 ms, species: [A2]}}
particles: {{description: two_equation_dimer, pah: [A2], density: 1800 kg/m^3, condensation: false, growth: false, oxidation: false}}
"""
FIELDS = ("soot_number_density", "soot_volume_fraction")
SEEDS = 8
STUDENT = 5.41  # 99.9 % to both sides, of so many repeats


def sections(count: int, factor: float) -> tuple:
    return ("particles.description=sectional", f"particles.sectional={{nucleation: dimer, aggregation: spheres, growth_scheme: limited, sections: {count}, factor: {factor}}}")


def ensembles(seed: int) -> tuple:
    return (f"seed={seed}", "particles.description=ensemble", "particles.number=500", "particles.averaging_time=0 s", "particles.keep_hydrogen=false")


def profiles(program: running.Program, deck: pathlib.Path, options: tuple) -> np.ndarray:
    """Of each field, along the row, at the end; then the mean over the row."""
    out = deck.parent / f"run{len(list(deck.parent.iterdir()))}"
    result = program("run", deck, *running.settings(*options), "--out", out)
    assert result.code == 0, result.err
    with h5py.File(out / "results.h5") as file:
        order = np.argsort(file["mesh/cellCentre"][:, 0])
        fields = file["steps"][max(file["steps"])]
        rows = np.array([fields[name][()][order] for name in FIELDS])
    return np.hstack([rows, rows.mean(axis=1, keepdims=True)])


def main(executable: str, mpiexec: list) -> None:
    program = running.Program(executable, mpiexec, 1)
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder) / "box.yaml"
        deck.write_text(DECK, encoding="utf-8")
        few = profiles(program, deck, sections(35, 1.7))
        many = profiles(program, deck, sections(110, 1.17))
        repeats = np.array([profiles(program, deck, ensembles(seed)) for seed in range(1, SEEDS + 1)])
    mean = repeats.mean(axis=0)
    half = STUDENT * repeats.std(axis=0, ddof=1) / np.sqrt(SEEDS)
    for i, name in enumerate(FIELDS):
        off = np.abs(mean[i] - many[i])
        print(f"{name}: differs from 110 sections by {100 * np.max(off / many[i]):.2f} % at most, its half intervals are up to "
              f"{100 * np.max(half[i] / many[i]):.2f} %, 35 sections differ by up to {100 * np.max(np.abs(few[i] / many[i] - 1)):.2f} %; "
              f"mean of the row {100 * (mean[i][-1] / many[i][-1] - 1):+.2f} +- {100 * half[i][-1] / many[i][-1]:.2f} %, "
              f"of 35 sections {100 * (few[i][-1] / many[i][-1] - 1):+.2f} %")
        assert many[i].max() > 1.2 * many[i].min() > 0.0
        assert half[i][-1] < 0.05 * many[i][-1]  # it could tell
        # All naphthalene becomes soot: the row's volume has no noise, and is that of either model's steps in time.
        assert abs(mean[i][-1] / many[i][-1] - 1) < 0.003 or name == "soot_number_density"
        compared = slice(None) if name == "soot_number_density" else slice(-1)
        assert np.all((off <= half[i] + np.abs(few[i] - many[i]))[compared]), (mean[i] / many[i], half[i] / many[i], few[i] / many[i])
    print("passed")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
