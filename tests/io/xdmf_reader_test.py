"""Reads the sample results with meshio, which shares no code with the writer, and compares every value.

Usage: xdmf_reader_test.py FOLDER (of write_sample_results). Exit code 77 (skipped) where meshio is not installed.
"""

import pathlib
import sys

try:
    import meshio
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-meshio (scripts/setup does)")
    sys.exit(77)


def main(folder: pathlib.Path) -> None:
    with meshio.xdmf.TimeSeriesReader(folder / "results.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert points.shape == (48, 3)
        assert [(block.type, block.data.shape) for block in cells] == [("quad", (35, 4))]
        corners = points[cells[0].data]
        # Counter-clockwise quadrilaterals whose areas fill the 5 mm x 8 mm plane.
        x, y = corners[:, :, 0], corners[:, :, 1]
        areas = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1), axis=1)
        assert np.all(areas > 0)
        assert np.isclose(areas.sum(), 5e-3 * 8e-3, rtol=1e-12)

        assert reader.num_steps == 2
        number = np.arange(35)
        for k, time in enumerate([0.0, 0.02]):
            read_time, _, data = reader.read_data(k)
            assert read_time == time
            np.testing.assert_array_equal(data["temperature"][0], 300.0 + number + time)
            assert data["velocity"][0].shape == (35, 3)
            np.testing.assert_array_equal(data["velocity"][0][:, 1], 0.01 * number * -2.0)
            np.testing.assert_array_equal(data["velocity"][0][:, 2], 0.0)
            np.testing.assert_array_equal(data["level"][0], number % 3)
    print("meshio reads the mesh, both steps and all fields")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
