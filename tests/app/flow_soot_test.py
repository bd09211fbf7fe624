"""A flow's soot over a few steps against the closed solution: a gas of one temperature whose only reactant is naphthalene, which
dimerises by its second-order law whatever the coupling and the step. Boxes that begin with soot of given sizes. And what a cold wall
takes of it: tables, history, report and budgets agree, from a checkpoint too, and with ensembles.

Usage: flow_soot_test.py EXECUTABLE MPIEXEC...
"""

import csv
import math
import pathlib
import sys
import tempfile

import restart_test
import running

h5py = running.package("h5py")

AVOGADRO, BOLTZMANN = 6.02214076e23, 1.380649e-23
CARBON, HYDROGEN = 12.011e-3, 1.008e-3
T, PRESSURE, FRACTION, END = 1000.0, 101325.0, 1e-3, 20e-6
GAS = f"temperature={T} K", f'composition="A2: {FRACTION}, N2: {1 - FRACTION}"'


def expected():
    """Carbon in soot at the end, kg/m3: Wang (2025), eqs. 7-34 to 7-42 for one PAH of sticking coefficient 0.002."""
    mass = (10 * CARBON + 8 * HYDROGEN) / AVOGADRO
    density = 1e6 * (10 * CARBON + 8 * HYDROGEN) / 18 / (0.260884 * 2.46**2 * 3.35)
    diameter = (6 * mass / (math.pi * density)) ** (1 / 3)
    rate = 0.002 * math.sqrt(math.pi * BOLTZMANN * T / mass) * 4 * diameter**2 * AVOGADRO
    start = FRACTION * PRESSURE / (AVOGADRO * BOLTZMANN * T)
    return 10 * CARBON * (start - start / (1 + rate * start * END))


# Two modes; nothing reacts.
BOX = f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/{running.MECHANISM}
mesh: {{geometry: planar, x: [{{to: 1 mm, cells: 2}}], y: [{{to: 1 mm, cells: 2}}]}}
boundaries: {{west: {{type: wall, side: x-min, particles: reflect}}, east: {{type: wall, side: x-max, particles: reflect}}, south: {{type: wall, side: y-min, particles: reflect}}, north: {{type: wall, side: y-max, particles: reflect}}}}
initial: {{layer: none, composition: "N2: 1", temperature: 600 K}}
time: {{end: 20 us, maximum_step: 10 us, first_step: 10 us}}
output: {{interval: 10 us}}
"""
WIDE, EQUAL = (1e16, 20e-9, 1.4), (1e15, 50e-9)
START = (f"[{{distribution: lognormal, number: {WIDE[0]} 1/m^3, diameter: {WIDE[1]} m, geometric_deviation: {WIDE[2]}@}}, "
         f"{{distribution: monodisperse, number: {EQUAL[0]} 1/m^3, diameter: {EQUAL[1]} m@}}]")
SOOT = "particles: {description: none, pah: [A2], initial: " + START.replace("@", "") + "}\n"
ENSEMBLE = SOOT.replace("description: none", "description: ensemble, number: 200, method: sammc")
TREES = "particles: {description: trees, number: 200, initial: " + START.replace("@", ", units: [1, 0]") + "}\n"
BEGINS = {**{model: SOOT.replace("none", model) for model in ("two_equation_dimer", "leung", "sectional", "momic", "hmom")},
          **{method: ENSEMBLE.replace("sammc", method) for method in ("dsmc", "swa", "sammc")},
          "trees": TREES}


def check_begins(program, folder):
    """Number and volume fraction at the start are those of the deck in every cell, and no carbon is lost."""
    number = WIDE[0] + EQUAL[0]
    volume = math.pi / 6 * (WIDE[0] * WIDE[1] ** 3 * math.exp(4.5 * math.log(WIDE[2]) ** 2) + EQUAL[0] * EQUAL[1] ** 3)
    for name, particles in BEGINS.items():
        deck, out = folder / f"{name}.yaml", folder / name
        deck.write_text(BOX + particles, encoding="utf-8")
        result = program("run", deck, "--out", out)
        assert result.code == 0, (name, result.err)
        with h5py.File(out / "results.h5", "r") as file:
            first = file["steps"][min(file["steps"])]
            for field, expected_value in (("soot_number_density", number), ("soot_volume_fraction", volume)):
                found = first[field][()]
                error = abs(found / expected_value - 1).max()
                assert error < 1e-9 and len(found) == 4, (name, field, found, expected_value)
            content = file["history/C_content"][()]
            # What copies of numerical trees come and go with is counted.
            assert abs(content[-1] / content[0] - 1) < (0.2 if name == "trees" else 1e-11), (name, content)
            assert file["history/C_budget_error"][-1] < 1e-11, name
    for text, expected_message in ((BOX + SOOT, "expected a model as 'particles.description'"),
                                   (BOX + ENSEMBLE[:ENSEMBLE.index("initial")] + "initial: {number: 1e15}}\n", "need a 'distribution'")):
        deck.write_text(text, encoding="utf-8")
        result = program("check", deck)
        assert result.code == 2 and expected_message in result.err, (result.code, result.err)


def table(path):
    """Rows, with numbers by the names of the columns without their units."""
    with open(path, newline="", encoding="utf-8") as file:
        return [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def check_walls(program, other, deck, folder, *options):
    """What the walls took, kg/rad."""
    settings = running.settings(*(f"boundaries.{inlet}.{value}" for inlet in ("fuel", "oxidiser") for value in GAS),
                                "boundaries.fuel_flange.temperature=600 K", "boundaries.oxidiser_flange.particles=reflect",
                                "time.end=160 us", "time.maximum_step=20 us", "time.first_step=20 us", "output.interval=80 us",
                                "output.boundaries=[all]", *options)
    out = folder / "walls"
    result = restart_test.run(program, deck, *settings, "--set", "checkpoint.steps=5", "--out", out)
    last = table(out / "history.csv")[-1]
    for element in ("mass", "C", "H"):
        assert last[f"{element}_budget_error"] < 1e-12, (element, last)
    rows = table(out / "tables/boundary_fuel_flange.csv")
    assert abs(rows[-1]["deposited"] / last["soot_deposited"] - 1) < 1e-12 and rows[-1]["deposited"] > 0, (rows[-1], last)
    gathered = sum(20e-6 * row["deposition"] for row in rows)
    assert abs(rows[-1]["deposited"] / gathered - 1) < 1e-9, (rows[-1], gathered)
    assert all(row["deposited"] == row["deposition"] == 0 for row in table(out / "tables/boundary_oxidiser_flange.csv"))
    faces = [row for row in table(out / "tables/deposit_fuel_flange.csv") if row["step"] == rows[-1]["step"]]
    assert [row["r"] for row in faces] == sorted(row["r"] for row in faces) and len(faces) == 2, faces
    for column, name in (("deposited", "deposited"), ("deposition", "deposition")):
        total = sum(row["area"] * row[column] for row in faces)
        assert abs(total - rows[-1][name]) <= 1e-12 * total, (column, faces, rows[-1])
    assert max(row["deposition"] for row in faces) == rows[-1]["largest_deposition"], (faces, rows[-1])
    assert rows[-1]["mean_deposition"] * rows[-1]["area"] == rows[-1]["deposition"] or \
        abs(rows[-1]["mean_deposition"] * rows[-1]["area"] / rows[-1]["deposition"] - 1) < 1e-12
    assert not (out / "tables/deposit_oxidiser_flange.csv").exists()
    assert f"soot on the wall fuel_flange: {rows[-1]['deposition']:.3g} kg/s/rad" in result.out, result.out
    assert f"{rows[-1]['deposited']:.4g} kg/rad since the start" in result.out and "oxidiser_flange" not in result.out, result.out
    restart_test.run(program, deck, *settings, "--out", folder / "rest", "--restart", out / "checkpoint/step_000005.h5")
    restart_test.assert_equal(folder / "rest", out)
    restart_test.run(other, deck, *settings, "--out", folder / "other", "--restart", out / "checkpoint/step_000005.h5")
    elsewhere = table(folder / "other/history.csv")[-1]
    assert abs(elsewhere["soot_deposited"] / last["soot_deposited"] - 1) < 1e-6, (elsewhere, last)
    return rows[-1]["deposited"]


def main(executable, *mpiexec):
    program, other = (running.Program(executable, list(mpiexec), ranks) for ranks in (1, 2))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        same = [f"boundaries.{inlet}.{value}" for inlet in ("fuel", "oxidiser") for value in GAS]
        for step in ("10 us", "4 us"):
            out = folder / step
            result = program("run", deck, "--out", out, *running.settings(
                *same, f"time.end={END} s", f"time.maximum_step={step}", f"time.first_step={step}"))
            assert result.code == 0, result.err
            with h5py.File(out / "results.h5", "r") as file:
                last = file["steps"][max(file["steps"])]
                carbon = last["soot_carbon"][()]
            # Away from the inlets. What a third of the naphthalene gives off warms the gas by some 1.5 K, of which rate and
            # concentration feel one part in 1e4.
            ratio = carbon.max() / expected()
            print(f"steps of {step}: {ratio:.6f}")
            assert abs(ratio - 1) < 5e-4, ratio
        check_begins(program, folder)
        taken = check_walls(program, other, deck, folder)
        ensembles = check_walls(program, other, deck, folder / "ensembles",
                                "particles={description: ensemble, number: 50, minimum_number_density: 1e9 1/m^3}")
        print(f"walls took {taken:.3g} kg/rad of the model's particles, {ensembles:.3g} of ensembles")
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
