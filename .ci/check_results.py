"""Looks whether what a run or study left is there, finite and plausible: a flow through its XDMF with meshio, a reactor
a one-dimensional flame and a population balance by their tables, a study by its runs."""

import csv
import json
import pathlib
import sys

import h5py
import meshio
import numpy as np


def check_reactor(folder):
    with h5py.File(folder / "results.h5", "r") as file:
        assert "history" in file or "reactors" in file, "no table"
        for name in ("history", "reactors"):
            for column, values in file.get(name, {}).items():
                assert np.all(np.isfinite(values[()])), f"{name}/{column} is not finite"
        table = file["history"] if "history" in file else file["reactors"]
        temperature = table["temperature"][()]
        assert len(temperature) > 0 and temperature.min() > 200 and temperature.max() < 4000, "an odd temperature"
        print(f"{folder}: {len(temperature)} rows of {len(table)} columns")


def check_population(folder):
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    with h5py.File(folder / "results.h5", "r") as file:
        assert set(file["methods"]) == set(record["deck"]["methods"]), "not all methods have results"
        for name, group in file["methods"].items():
            history = group["history"]
            for k in range(3):
                moment = history[f"M{k}"][()]
                assert np.all(np.isfinite(moment)) and np.all(moment[1:] > 0), f"{name}: M{k} is not positive"
            assert np.all(np.diff(history["time"][()]) > 0), f"{name}: the times do not rise"
    with open(folder / "table.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["method"] for row in rows] == list(record["deck"]["methods"]), "table.csv lacks methods"
    print(f"{folder}: {len(rows)} methods")


def check_molecules(folder):
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    with h5py.File(folder / "results.h5", "r") as file:
        history, spectrum, formulas = file["history"], file["spectrum"], file["molecules/formulas"]
        assert np.all(np.diff(history["time"][()]) > 0), "the times do not rise"
        rings = history["six_rings"][()] + history["five_rings"][()]
        assert np.allclose(history["carbon"][()] - history["hydrogen"][()], 2 * (rings - 1)), "C - H is not 2 (R - 1)"
        isCounted = record["deck"].get("description") == "sites"  # these have no shape that could be drawn
        assert np.all(spectrum["molecules"][()] > 0) and (isCounted or len(formulas["carbon"]) > 0), "no molecules"
        print(f"{folder}: {len(rings)} rows, {len(spectrum['time'])} formulas, {len(formulas['carbon'])} molecules drawn")


def check_aggregates(folder):
    with h5py.File(folder / "results.h5", "r") as file:
        history, spheres = file["history"], file["aggregates/spheres"]
        assert np.all(np.diff(history["time"][()]) >= 0), "the times fall"
        for name in ("spheres", "volume", "surface", "radius", "gyration", "shadow"):
            assert np.all(history[name][()] > 0), f"{name} is not positive"
        assert np.all(spheres["radius"][()] > 0), "spheres without a radius"
        assert np.all(spheres["volume"][()] <= 4.18880 * spheres["radius"][()] ** 3), "cut spheres are larger than spheres"
        print(f"{folder}: {len(history['time'])} rows, {len(spheres['radius'])} spheres drawn")


def check_flame(folder):
    with h5py.File(folder / "results.h5", "r") as file:
        flame = file["flame"]
        z, temperature = flame["z"][()], flame["temperature"][()]
        assert len(z) > 10 and np.all(np.diff(z) > 0), "the grid does not rise"
        assert temperature.min() > 200 and temperature.max() < 4000, "an odd temperature"

        def finite(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                assert np.all(np.isfinite(item[()])), f"{name} is not finite"

        flame.visititems(finite)
        if "unsteady" not in file:
            imbalance = np.abs(file["budgets/relative_imbalance"][()])
            assert np.all(imbalance < 1e-8), f"budgets do not close: {imbalance}"
        print(f"{folder}: {len(z)} points, {len(flame['X'])} species" + (", soot" if "soot" in flame else ""))


def check_study(folder):
    study = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    assert study["failed_runs"] == 0, f"{study['failed_runs']} runs failed"
    for run in study["runs"]:
        main(folder / run["run"])
    if (folder / "convergence.csv").is_file():
        with open(folder / "convergence.csv", newline="", encoding="utf-8") as file:
            points = list(csv.DictReader(file))
        assert points and all(0 < float(point["error_M0"]) < 1 for point in points), "odd errors"
        assert (folder / "convergence_slopes.csv").is_file()
    else:
        assert study["runs"], "no runs"
    print(f"{folder}: {len(study['runs'])} runs")


def check_engine(folder):
    with h5py.File(folder / "results.h5") as file:
        pressure, temperature, mass = (file[f"history/{name}"][()] for name in ("pressure", "temperature", "mass"))
        assert np.all((pressure > 1e4) & (pressure < 1e8)) and np.all((temperature > 250) & (temperature < 4000)), "odd gas"
        if "history/soot_mass" in file:
            mass = mass + file["history/soot_mass"][()]
        assert np.ptp(mass) < 1e-9 * mass[0] or np.all(np.diff(mass) > -1e-9 * mass[0]), "gas or soot is lost"
    results = json.loads((folder / "run.json").read_text(encoding="utf-8"))["results"]
    assert results["energy_error"] < 1e-9 and results["element_error"] < 1e-9, "balances"
    print(f"{folder}: {len(pressure)} rows of an engine, energy balanced to {results['energy_error']:.2g}")


def check_flow(folder):
    with meshio.xdmf.TimeSeriesReader(folder / "results.xdmf") as reader:
        points, cells = reader.read_points_cells()
        # A mesh of several kinds of cells comes in blocks of one kind.
        assert np.all(np.isfinite(points)) and len(cells) > 0 and all(len(block.data) > 0 for block in cells), "no mesh"
        assert max(block.data.max() for block in cells) == len(points) - 1, "the cells do not use all vertices"
        assert all(len(np.unique(block.data, axis=0)) == len(block.data) and np.all(np.diff(np.sort(block.data)) > 0)
                   for block in cells), "a cell has a vertex twice, or stands there twice"
        assert reader.num_steps > 0, "no steps"
        times = []
        for k in range(reader.num_steps):
            time, _, data = reader.read_data(k)
            times.append(time)
            for name, values in data.items():
                assert np.all(np.isfinite(np.concatenate(values))), f"{name} at {time} s is not finite"
            temperature = np.concatenate(data["temperature"])
            assert temperature.min() > 200 and temperature.max() < 4000, "temperature out of any flame's range"
        assert times == sorted(times), "the steps are not in order of time"
    print(f"{folder}: meshio reads {len(times)} steps of {sum(len(block.data) for block in cells)} cells, {len(data)} fields")


def main(folder):
    if (folder / "study.json").is_file():
        check_study(folder)
        return
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    kinds = {"reactor": check_reactor, "prescribed_gas": check_reactor, "particles_along": check_reactor, "population_balance": check_population, "pah": check_molecules, "aggregates": check_aggregates, "engine": check_engine, "flame1d": check_flame}
    kinds.get(record["deck"]["problem"], check_flow)(folder)


main(pathlib.Path(sys.argv[1]))
