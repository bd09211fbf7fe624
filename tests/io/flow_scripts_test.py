"""What scripts/mesh_to_gmsh writes of a run's box, and what scripts/compare_flows says of two runs, on results written here."""

import json
import pathlib
import sys
import tempfile

try:
    import h5py
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.path.insert(0, str(ROOT / "tests/app"))
import running  # noqa: E402

DECK = {"mesh": {"geometry": "axisymmetric"},
        "boundaries": {"axis": {"side": "r-min"}, "out": {"side": "r-max"}, "nozzle": {"side": "z-min", "to": 0.002},
                       "flange": {"side": "z-min", "from": 0.002}, "lid": {"side": "z-max"}}}


def write_run(folder, r, z, field, more=None):
    """A run on the box of these vertices, with a temperature by a function of the cells' centres."""
    folder.mkdir()
    columns = len(r)
    places = np.stack([*np.meshgrid(r, z), np.zeros((len(z), columns))], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(columns - 1), np.arange(len(z) - 1))
    first = (j * columns + i).ravel()
    cells = np.stack([first, first + 1, first + columns + 1, first + columns], axis=1)
    centres = places[cells].mean(axis=1)
    with h5py.File(folder / "results.h5", "w") as file:
        file["mesh/vertices"], file["mesh/cells"], file["mesh/cellCentre"] = places, cells, centres
        file["mesh"].attrs["dimension"] = 2
        file["steps/000003/temperature"] = field(centres[:, 0], centres[:, 1])
    (folder / "run.json").write_text(json.dumps({"deck": {**DECK, **(more or {})}}))
    return folder


def called(script, *words):
    result = running.script(SCRIPTS / script, *words)
    return result.code, result.out, result.err


def section(text, name):
    return text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()


def check_mesh(folder):
    run = write_run(folder / "box", np.array([0, 1, 2, 4]) * 1e-3, np.array([0, 1, 3]) * 1e-3, lambda r, z: 300 + r)
    for kind, count, corners in (("quadrilaterals", 6, 4), ("triangles", 12, 3)):
        out = folder / f"{kind}.msh"
        code, told, err = called("mesh_to_gmsh", run, out, "--cells", kind, "--move", 0.2)
        assert code == 0 and f"{count} {kind}" in told, err
        text = out.read_text()
        nodes = section(text, "Nodes")
        assert nodes[0].split()[1] == "12"
        places = np.array([[float(x) for x in line.split()] for line in nodes[-12:]])
        original = np.stack(np.meshgrid([0, 1e-3, 2e-3, 4e-3], [0, 1e-3, 3e-3]), axis=-1).reshape(-1, 2)
        moved = np.abs(places[:, :2] - original).max(axis=1)
        assert np.flatnonzero(moved).tolist() == [5, 6], "the inner vertices move, and no others"
        assert moved.max() <= 0.2e-3
        elements = [line.split() for line in section(text, "Elements")[1:]]
        names = [line.split('"')[1] for line in section(text, "PhysicalNames")[1:]]
        heads = [k for k, words in enumerate(elements) if len(words) == 4 and words[0] in "12" and words[2] in "123"]
        edges = {names[int(elements[k][1]) - 1]: int(elements[k][3]) for k in heads if elements[k][0] == "1"}
        assert edges == {"axis": 2, "out": 2, "nozzle": 2, "flange": 1, "lid": 3}, edges
        cells = np.array([words[1:] for words in elements[-count:]], int) - 1
        assert cells.shape == (count, corners)
        x, y = np.moveaxis(places[cells][:, :, :2], -1, 0)
        area = 0.5 * (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)
        assert (area > 0).all() and abs(area.sum() - 12e-6) < 1e-12, "they fill the box"
    code, _, err = called("mesh_to_gmsh", write_run(folder / "bent", np.arange(3.0), np.arange(3.0), lambda r, z: r,
                                                    {"mesh": {"floor": {"formula": "x"}}}), folder / "no.msh")
    assert code == 2 and "not a whole box" in err, err


def check_comparison(folder):
    def linear(r, z):
        return 300.0 + 1e5 * r - 2e4 * z

    coarse = write_run(folder / "coarse", np.linspace(0, 4e-3, 5), np.linspace(0, 3e-3, 4), linear)
    fine = write_run(folder / "fine", np.linspace(0, 4e-3, 10), np.linspace(0, 3e-3, 12), linear)
    code, told, err = called("compare_flows", coarse, fine, "--json")
    (row,) = json.loads(told)
    assert code == 0 and row["largest"] < 1e-12 and row["mean"] < 1e-12, (row, err)
    higher = write_run(folder / "higher", np.linspace(0, 4e-3, 5), np.array([0, 1, 3]) * 1e-3,
                       lambda r, z: linear(r, z) + np.where(z > 1e-3, 30.0, 0.0))
    (row,) = json.loads(called("compare_flows", higher, fine, "--json")[1])
    with h5py.File(fine / "results.h5") as file:
        size = np.ptp(file["steps/000003/temperature"][()])
    assert abs(row["largest"] - 30.0 / size) < 1e-9 and abs(row["mean"] - 20.0 / size) < 1e-9, (row, size)
    code, told, _ = called("compare_flows", coarse, fine, "--fields", "soot_volume_fraction")
    assert code == 2 and told == ""


with tempfile.TemporaryDirectory() as scratch:
    check_mesh(pathlib.Path(scratch))
    check_comparison(pathlib.Path(scratch))
