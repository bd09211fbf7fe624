"""Opens the XDMF of a run with meshio and looks whether all fields of all steps are there, finite and plausible."""

import pathlib
import sys

import meshio
import numpy as np


def main(folder):
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


main(pathlib.Path(sys.argv[1]))
