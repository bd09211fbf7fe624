"""The Python package: results of every problem as arrays with units, tables of studies, and the program's errors as exceptions.

Usage: python_package_test.py EXECUTABLE
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile

import running

np = running.package("numpy")
h5py = running.package("h5py")
sys.path.insert(0, str(running.SOURCE / "python"))

import lampblack  # noqa: E402
from lampblack.arrays import table_of_csv  # noqa: E402
from lampblack.errors import error_of  # noqa: E402
from lampblack.program import setting  # noqa: E402

CASES = running.SOURCE / "cases"
COARSE = {"grid.slope": 0.5, "grid.curve": 0.8}


def check_arrays():
    """Parts keep the unit; what is computed has none."""
    T = lampblack.Array([300.0, 2000.0, 1000.0], "temperature", "K", "of the gas")
    assert T.label == "temperature, K" and T[1:].unit == "K" and T[T > 500].name == "temperature" and T.copy().unit == "K"
    for computed in (T * 2, 2 - T, T**2, np.sqrt(T), np.concatenate([T, T]), np.where(T > 500, T, 0), np.diff(T), T / T):
        assert type(computed) is np.ndarray, computed
    assert (T.max(), float(np.mean(T)), T[0]) == (2000.0, 1100.0, 300.0) and isinstance(T.argmax(), np.integer)
    other = np.zeros(3)
    other += T
    np.multiply(T, 2.0, out=other)
    assert other[1] == 4000.0


def check_flame(folder):
    """The profile is that of profile.csv, with the mass fractions; text, list and number as settings."""
    flame = lampblack.run(CASES / "flame1d/free_hydrogen/deck.yaml", set={**COARSE, "title": "a flame"}, out=folder / "flame")
    profile, written = flame.profile(), table_of_csv(folder / "flame/profile.csv")
    assert next(iter(profile)) == "z" and profile.rows == len(written["z"]) > 10
    for name, column in written.items():
        assert np.array_equal(profile[name], column) and profile[name].unit == column.unit, name
    with h5py.File(folder / "flame/results.h5") as file:
        assert np.array_equal(profile["Y_OH"], file["flame/Y/OH"][()])
        assert profile["conductivity"].description == file["flame/conductivity"].attrs["description"].decode()
    assert flame.numbers()["flame_speed_m_per_s"] == profile["velocity"][0] and flame.record()["deck"]["title"] == "a flame"
    assert lampblack.open(folder / "flame/results.h5").profile().units == profile.units
    assert not flame.distributions() and not flame.history()
    try:
        lampblack.run(CASES / "flame1d/free_hydrogen/deck.yaml", set=COARSE, out=folder / "flame")
        raise AssertionError("a finished run was replaced without force")
    except lampblack.InputError as error:
        assert "holds a finished run" in error.message and error.key is None and error.line is None, vars(error)
    again = lampblack.run(CASES / "flame1d/free_hydrogen/deck.yaml", set=COARSE, out=folder / "flame", force=True, ranks=2)
    assert again.record()["ranks"] == 2


def check_reactor(folder):
    """History, units, distributions of ensembles with their rows and errors; a table by the name of its group or file."""
    run = lampblack.run(CASES / "reactor/ignition_hydrogen/deck.yaml", set={"time.end": "0.1 ms", "sensitivity.reactions": ["1", "2"]},
                        out=folder / "reactor")
    history = run.history()
    assert next(iter(history)) == "time" and history["temperature"].unit == "K" and history["temperature"][0] == 1200.0
    assert list(run.table("sensitivity")["reaction"]) == [1, 2] and run.table("sensitivities.csv")["equation"][0]
    along = lampblack.run(CASES / "particles_along/premixed_ethylene_abf/deck.yaml",
                          set={"particles.repeats": 2, "particles.number": 64}, out=folder / "along")
    distribution = along.distributions()["soot"]
    rows = len(along.history()["time"])
    assert distribution.density.shape == distribution.error.shape == (rows, len(distribution.sizes))
    assert distribution.edges.shape == (len(distribution.sizes) + 1,) and distribution.sizes.unit == "m"
    assert np.allclose(distribution.sizes**2, distribution.edges[1:] * distribution.edges[:-1], rtol=1e-12)
    assert distribution.along.name == "time" and np.array_equal(distribution.along, along.history()["time"])
    assert np.array_equal(distribution.at(distribution.along[3]), distribution.density[3])
    decades = np.diff(np.log10(distribution.edges))
    number = (distribution.density * decades).sum(axis=1)
    some = number > 0
    assert some.any() and np.all(number[some] <= 1.0001 * along.history()["soot_number_density"][some])


def check_population(folder):
    run = lampblack.run(CASES / "population_balance/chapter5_02_coagulation_monodisperse.yaml",
                        set={"repeats": 2, "time.end": "5 s", "distribution.times": ["5 s"]}, out=folder / "population")
    distributions = run.distributions()
    assert set(distributions) == set(run.file["methods"])
    mmc = distributions["mmc"]
    assert mmc.along.unit == "s" and mmc.sizes.unit == "m^3" and mmc.density.unit == "1/m^3"
    assert np.allclose(mmc.sizes**2, mmc.edges[1:] * mmc.edges[:-1], rtol=1e-12)
    # Bins of width one: their numbers add up to M0.
    assert abs(mmc.at(5.0).sum() / run.table("methods/mmc/history")["M0"][-1] - 1) < 1e-6


def check_flow(folder):
    run = lampblack.run(CASES / "flow/lid_driven_cavity/deck.yaml", set={"time.end": "0.1 ms"}, out=folder / "flow")
    cells = run.cell_table()
    assert list(cells)[:2] == ["x", "y"] and cells["velocity"].shape == (run.file["mesh"].attrs["cells"], 3)
    assert cells["velocity"].unit == "m/s" and np.array_equal(cells["y"], run.centres[:, 1]) and run.field("temperature").unit == "K"
    try:
        run.profile()
        raise AssertionError("a flow has no profile")
    except lampblack.ResultsError as error:
        assert "not the results of a one-dimensional flame" in str(error)


def linear(x, y):
    return 300 + 2e5 * x - 3e5 * y


def check_line(folder):
    """Fields along a line of a flow on triangles and quadrilaterals: a linear field is met but beside the surface, a step is continuous
    and nowhere beyond what the cells have, vectors stay vectors; what is no line or no field is said."""
    from flow_mesh_run_test import DECKS, HEAD, gmsh_text

    (folder / "mesh.msh").write_text(gmsh_text(10, 6, lambda i, j: (i + j) % 3 == 0), encoding="utf-8")
    (folder / "deck.yaml").write_text(HEAD + DECKS["mixed"], encoding="utf-8")
    run = lampblack.run(folder / "deck.yaml", set={"time.end": "50 us"}, out=folder / "mixed")
    x, y, last = run.centres[:, 0], run.centres[:, 1], run.steps[-1]
    run.file.close()
    with h5py.File(folder / "mixed/results.h5", "a") as file:
        step = file["steps"][last]
        step["density"][...] = linear(x, y)
        step["viscosity"][...] = np.where(x < 5e-3, 1.0, 4.0)
        step["velocity"][:, 0], step["velocity"][:, 1] = linear(x, y), -linear(x, y)
    run = lampblack.open(folder / "mixed")
    line = run.line((1.7e-3, 1.2e-3), (8.1e-3, 3.9e-3), points=800, fields=["density", "viscosity", "velocity"])
    assert list(line) == ["distance", "x", "y", "density", "viscosity", "velocity"] and line.rows == 800
    assert line["density"].unit == "kg/m^3" and abs(line["distance"][-1] - np.hypot(6.4e-3, 2.7e-3)) < 1e-15
    assert np.allclose(line["density"], linear(line["x"], line["y"]), rtol=1e-10)
    assert np.allclose(line["velocity"][:, 1], -linear(line["x"], line["y"]), rtol=1e-10)
    step = line["viscosity"]
    assert step.min() == 1 and step.max() == 4 and np.abs(np.diff(step)).max() < 0.2, np.abs(np.diff(step)).max()
    whole = run.line((0, 0), (10e-3, 5e-3))
    assert set(whole) >= {"temperature", "X_GAS"} and whole.rows == 101
    assert run.centres.shape[1] == 3 and whole["density"].max() <= run.field("density").max()
    for mistake, told in (((0, 0), (11e-3, 0)), "outside the mesh"), (((0, 0), (0, 0)), "two ends"), (((0, 0, 0), (1, 1, 1)), "2 coordinates"):
        try:
            run.line(*mistake)
            raise AssertionError(f"{mistake} was accepted")
        except lampblack.ResultsError as error:
            assert told in str(error), error
    try:
        run.line((0, 0), (1e-3, 1e-3), fields=["heat"])
        raise AssertionError("a field that is not there was accepted")
    except lampblack.ResultsError as error:
        assert "no field 'heat'" in str(error)
    assert np.array_equal(run.field("Y_gas"), np.ones(len(x)))


def check_line_in_space():
    """The same among a hexahedron, a prism at its side, a pyramid and a tetrahedron: what is constant stays so, from end to end."""
    import types

    from lampblack.places import LineOfPlaces

    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (2, 0, 0), (2, 0, 1),
                         (0.5, 0.5, 2), (2, 0.5, 2)], dtype=float)
    cells = np.array([(0, 1, 2, 3, 4, 5, 6, 7), (1, 8, 2, 2, 5, 9, 6, 6), (4, 5, 6, 7, 10, 10, 10, 10), (5, 11, 6, 6, 10, 10, 10, 10)])
    centres = np.array([vertices[np.unique(cell)].mean(axis=0) for cell in cells])
    mesh = types.SimpleNamespace(is_plane=False, vertices=vertices, cells=cells, centres=centres)
    for start, end, found in (((0.1, 0.2, 0.1), (0.9, 0.3, 0.9), {0}), ((0.1, 0.2, 0.3), (1.7, 0.1, 0.3), {0, 1}),
                              ((0.5, 0.5, 0.1), (0.5, 0.5, 1.9), {0, 2}), ((0.5, 0.5, 1.5), (1.4, 0.5, 1.75), {2, 3})):
        line = LineOfPlaces(mesh, start, end, 60)
        assert set(line._cell) == found, (start, set(line._cell))
        assert np.allclose(line.values(np.full(4, 7.0)), 7.0, rtol=1e-12)
        values = line.values(np.arange(4.0))
        assert values.min() >= min(found) - 1e-12 and np.abs(np.diff(values)).max() < 0.25, values
    try:
        LineOfPlaces(mesh, (0.1, 0.1, 0.1), (0.1, 0.1, 1.9), 10)
        raise AssertionError("a place outside was accepted")
    except lampblack.ResultsError as error:
        assert "outside the mesh" in str(error)


def check_sweep(folder):
    deck = CASES / "flame1d/free_hydrogen/deck.yaml"
    study = lampblack.sweep(deck, vary={"inlet.equivalence_ratio": [1.0, 1.5]}, set=COARSE, chain=2, out=folder / "sweep")
    table = study.table
    assert list(table["inlet.equivalence_ratio"]) == [1.0, 1.5] and list(table["status"]) == ["done", "done"] and not study.failed
    for name, speed in zip(study, table["flame_speed_m_per_s"]):
        assert study[name].profile()["velocity"][0] == speed and study[name].record()["deck"]["grid"]["slope"] == 0.5
    assert ["initial" in study[name].record()["deck"] for name in study] == [False, True], "no chain of flames"
    assert list(lampblack.open(folder / "sweep")) == list(study)
    # A flame that is wrong among others: an error, unless it is allowed.
    vary = {"inlet.equivalence_ratio": [1.0], "grid.maximum_points": [12, 400]}
    try:
        lampblack.sweep(deck, vary=vary, set=COARSE, out=folder / "failing")
        raise AssertionError("a study that fails was no error")
    except lampblack.LampblackError as error:
        assert error.exit_code in (2, 3), vars(error)
    allowed = lampblack.sweep(deck, vary=vary, set=COARSE, out=folder / "failing", force=True, allow_failures=True)
    assert len(allowed) == 2 and len(allowed.failed) == 1 and all(allowed.failed.values())


def check_errors(folder):
    """The place of each message."""
    deck = folder / "wrong.yaml"
    text = (CASES / "reactor/ignition_hydrogen/deck.yaml").read_text()
    deck.write_text(text.replace("1200 K\n  comp", "1200 Pa\n  comp"))
    for call, file, line, key, given in (
        (lambda: lampblack.check(deck), str(deck), 11, "initial.temperature", None),
        (lambda: lampblack.check(CASES / "reactor/ignition_hydrogen/deck.yaml", set={"initial.temperature": "-5 K"}), None, None,
         "initial.temperature", "initial.temperature=-5 K"),
        (lambda: lampblack.check(folder / "nowhere.yaml"), str(folder / "nowhere.yaml"), None, None, None),
    ):
        try:
            call()
            raise AssertionError("a mistake was no error")
        except lampblack.InputError as error:
            assert (error.file, error.line, error.key, error.setting) == (file, line, key, given), (vars(error), error)
            assert not error.message.startswith("lampblack: ")
    # What other ends of runs become.
    kinds = [(3, "lampblack: numerics: no solution", lampblack.NumericsError, "no solution"),
             (3, "lampblack: disk full: 3 B", lampblack.MachineError, "disk full: 3 B"),
             (143, "lampblack: warning: w\nlampblack: stopped by SIGTERM at t = 1 s", lampblack.Stopped, "stopped by SIGTERM at t = 1 s"),
             (1, "", lampblack.ProgramBug, "the program ended with exit code 1 and said nothing")]
    for code, told, kind, message in kinds:
        error = error_of(code, told)
        assert type(error) is kind and str(error) == message and error.exit_code == code, error
    assert error_of(-15, "").signal == signal.SIGTERM
    assert [setting(v) for v in ("1 ms", 0.1, True, ["a", 2], np.float64(0.3), np.arange(2))] == [
        "1 ms", "0.1", "true", '["a", 2]', "0.3", "[0, 1]"]
    try:
        lampblack.open(folder)
        raise AssertionError("a folder without results was opened")
    except lampblack.ResultsError as error:
        assert str(folder) in str(error)


def check_tables(folder):
    """pandas and xarray, where they are; without h5py the package and its errors can still be had."""
    (folder / "some.csv").write_text('name,"X_C5H5O(1,3) [1]",time [s]\na,0.5,\nb,,2\nc,0.2\n')
    some = table_of_csv(folder / "some.csv")  # an empty field is not known, a row that is not whole is left out
    assert list(some["name"]) == ["a", "b"] and some["X_C5H5O(1,3)"][0] == 0.5 and np.isnan(some["X_C5H5O(1,3)"][1])
    assert np.isnan(some["time"][0]) and some.units == {"name": "", "X_C5H5O(1,3)": "1", "time": "s"}
    table = lampblack.open(folder / "flame").profile()
    try:
        frame = table.to_pandas()
        assert list(frame.columns) == list(table) and frame.attrs["units"]["z"] == "m"
    except ImportError:
        print("no pandas here: not looked at")
    try:
        data = table.to_xarray()
        assert data["temperature"].attrs["units"] == "K" and data["temperature"].dims == ("z",)
        assert float(data["temperature"].sel(z=0.0)) == table["temperature"][0]
        assert lampblack.open(folder / "flow").cell_table().to_xarray()["velocity"].shape[1] == 3
    except ImportError:
        print("no xarray here: not looked at")
    script = "import sys; sys.modules['h5py'] = None\nimport lampblack; lampblack.InputError; print(len(lampblack.__all__))\n" \
             "try: lampblack.open\nexcept ImportError: print('needs h5py')"
    done = subprocess.run([sys.executable, "-c", script], env=dict(os.environ, PYTHONPATH=str(running.SOURCE / "python")),
                          capture_output=True, text=True, check=True)
    assert "needs h5py" in done.stdout, done


def main(executable):
    os.environ.update(running.environment(), LAMPBLACK_PROGRAM=os.path.abspath(executable))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_arrays()
        check_line_in_space()
        for check in (check_flame, check_reactor, check_population, check_flow, check_line, check_sweep, check_errors, check_tables):
            check(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
