"""Looks whether what a run left is there, finite and plausible: a flow through its XDMF with meshio, a reactor by its
tables."""

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


def check_flow(folder):
    with meshio.xdmf.TimeSeriesReader(folder / "results.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert np.all(np.isfinite(points)) and len(cells) == 1 and len(cells[0].data) > 0, "no mesh"
        assert cells[0].data.max() == len(points) - 1, "the cells do not use all vertices"
        assert reader.num_steps > 0, "no steps"
        times = []
        for k in range(reader.num_steps):
            time, _, data = reader.read_data(k)
            times.append(time)
            for name, values in data.items():
                assert np.all(np.isfinite(values[0])), f"{name} at {time} s is not finite"
            temperature = data["temperature"][0]
            assert temperature.min() > 200 and temperature.max() < 4000, "temperature out of any flame's range"
        assert times == sorted(times), "the steps are not in order of time"
    print(f"{folder}: meshio reads {len(times)} steps of {len(cells[0].data)} cells, {len(data)} fields")


def main(folder):
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    (check_reactor if record["deck"]["problem"] == "reactor" else check_flow)(folder)


main(pathlib.Path(sys.argv[1]))
