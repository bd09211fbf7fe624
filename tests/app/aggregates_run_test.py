"""Aggregates of spheres in space, from the deck to the pictures: the same numbers on any number of ranks, spheres that are joined as
they say, a gas from a table, a signal.

Usage: aggregates_run_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running
import stopping

np = running.package("numpy")

DECK = """problem: aggregates
spheres: {radius: 5 nm, density: 2000 kg/m^3, deviation: 1.3}
build: {by: equal_pairs, doublings: 4, aggregates: 12}
gas: {temperature: 1500 K, growth: 1 um/s}
sintering: {mechanism: grain_boundary, prefactor: 7.4e16, activation_temperature: 3.1e4 K}
time: {end: 0.5 ms, outputs: 3}
repeats: 3
output: {fit_from: 2}
"""
COLLISIONS = """problem: aggregates
spheres: {radius: 5 nm, density: 2000 kg/m^3}
build: {by: collisions, sample: 64, expected_number: 1e17 1/m^3}
gas: {file: gas.csv, birth_diameter: 4 nm}
time: {end: 20 ms, outputs: 4}
repeats: 2
"""
TABLE = "time [ms],temperature [K],pressure [atm],births [1/m^3/s],growth [nm/s]\n0,1500,1,1e19,0\n10,1500,1,1e19,0\n11,1400,1,0,100\n"


def check_numbers(data: dict) -> None:
    h = {name.removeprefix("history/"): values for name, values in data.items() if name.startswith("history/")}
    assert np.allclose(h["time"], np.array([0, 0, 0, 0, 0, 1, 2, 3]) * 0.5e-3 / 3)
    assert np.all(h["spheres"][:5] == [1, 2, 4, 8, 16]) and np.all(h["spheres_error"][:5] == 0)
    assert np.allclose(h["coordination"][:5], 2 * (1 - 1 / h["spheres"][:5]))
    assert np.all(np.diff(h["gyration"][:5]) > 0) and np.all(h["gyration"] > h["gyration_points"])
    assert 1.2 < h["fractal_dimension"][4] < 2.6, h["fractal_dimension"]
    assert np.isclose(h["radius_deviation"][0], 1.3, rtol=0.15)
    assert h["neck_ratio"][4] == 0 and np.all(np.diff(h["neck_ratio"][4:]) > 0)
    assert np.all(np.diff(h["volume"][4:]) > 0), "growth"
    # Spheres are as far apart as their necks say, and cut as much.
    s = {name.removeprefix("aggregates/spheres/"): values for name, values in data.items() if name.startswith("aggregates/")}
    places = np.stack([s[axis] for axis in "xyz"], axis=1)
    first = np.searchsorted(s["aggregate"], s["aggregate"])
    partner = first + s["partner"].astype(int)
    mine = np.arange(len(partner))
    joined = np.flatnonzero(mine != first)
    assert np.all(partner[joined] < joined) and len(first) == np.sum(mine == first) + len(joined)
    planes = np.sqrt(s["radius"][joined] ** 2 - s["neck"][joined] ** 2) + np.sqrt(s["radius"][partner[joined]] ** 2 - s["neck"][joined] ** 2)
    apart = np.linalg.norm(places[joined] - places[partner[joined]], axis=1)
    assert np.allclose(apart, planes, rtol=1e-9), np.abs(apart / planes - 1).max()


def check_collisions(program, folder: pathlib.Path) -> None:
    (folder / "gas.csv").write_text(TABLE, encoding="utf-8")
    (folder / "collisions.yaml").write_text(COLLISIONS, encoding="utf-8")
    running.run_deck(program, folder / "collisions.yaml", folder / "collisions")
    data = running.datasets(folder / "collisions/results.h5")
    volume = data["history/number"] * data["history/volume"]
    born = 4 / 3 * np.pi * (2e-9) ** 3 * 1e19 * np.array([5e-3, 10e-3])
    assert np.allclose(volume[1:3], born, rtol=0.15), volume[1:3] / born
    assert np.all(np.diff(data["history/temperature"]) <= 0) and data["history/temperature"][-1] == 1400
    assert data["history/spheres"][-1] > 1.2 and data["history/collision_diameter"][-1] > 4e-9
    assert data["history/radius"][-1] > 2e-9 + 0.8e-9, "growth"
    assert np.isnan(data["history/number"][0]) and np.isnan(data["history/spheres"][0]), "nothing at the start"


def check_signal(executable: str, mpiexec: list, folder: pathlib.Path) -> None:
    process = running.Process(executable, mpiexec, 1)
    command = [*process.command, "run", str(folder / "deck.yaml"), *running.settings("build.doublings=14", "build.aggregates=1000")]
    err = stopping.stopped_in_the_middle(command, folder / "stopped")
    assert "in the middle of the repeats" in err, err


def main(executable: str, *mpiexec: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "deck.yaml"
        deck.write_text(DECK, encoding="utf-8")
        runs = {}
        for ranks in (1, 2):
            result = running.run_deck(running.Program(executable, list(mpiexec), ranks), deck, folder / str(ranks))
            assert not result.err, result.err
            runs[ranks] = running.datasets(folder / str(ranks) / "results.h5")
        different = [name for name in runs[1] if runs[1][name].tobytes() != runs[2][name].tobytes()]
        assert not different, f"2 ranks: other numbers than on one in {different}"
        check_numbers(runs[1])
        program = running.Program(executable, list(mpiexec), 1)
        check_collisions(program, folder)
        check_signal(executable, list(mpiexec), folder)
        for run_folder in ("1", "collisions"):
            drawn = running.script(running.SOURCE / "scripts/plot", folder / run_folder)
            assert drawn.code == 0, drawn
            for picture in ("history", "micrographs"):
                assert (folder / run_folder / "pictures" / f"{picture}.png").exists(), picture
    print("ranks, joints, tables, signals and pictures agree")


main(*sys.argv[1:])
