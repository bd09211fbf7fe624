"""Tables of a flow: probes, lines and boundaries of a channel whose lower wall is warm, on a box, on triangles and in space, on one
rank and two; what balances has to balance. And what is refused.

Usage: flow_tables_test.py EXECUTABLE MPIEXEC...
"""

import csv
import pathlib
import sys
import tempfile

import running

h5py, np = running.package("h5py"), running.package("numpy")

GAS = 'temperature: 300 K, composition: "GAS: 1"'
VISCOSITY = 1.68e-5 * (300 / 273) ** 1.5 * (273 + 110.5) / (300 + 110.5)
SPEED, HEIGHT, LENGTH = 0.5, 5e-3, 10e-3
PROFILE = f"6*{SPEED}*y*({HEIGHT} - y)/{HEIGHT}^2"
HEAD = f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/perfect_gas_1.yaml
transport:
  model: unity_lewis
  sutherland: {{viscosity: 1.68e-5 Pa s, temperature: 273 K, constant: 110.5 K, prandtl_number: 0.71}}
initial: {{layer: none, {GAS}, formula: {{velocity_x: "{PROFILE}"}}}}
time: {{end: 20 ms, first_step: 0.1 ms, maximum_step: 0.4 ms}}
"""
TABLES = """output:
  interval: 10 ms
  boundaries: [all]
  quantities: [velocity, temperature, pressure]
  probes: {middle: {at: [5 mm, 2.5 mm%s]}, corner: {at: [10 mm, 5 mm%s]}, end: {at: [10 mm, 2.5 mm%s]}}
  lines: {across: {from: [5 mm, 0 mm%s], to: [5 mm, 5 mm%s], points: 6}}
"""


def boundaries(low: str, sides: bool) -> str:
    def at(side):
        return f"side: {side}, " if sides else ""

    return f"""boundaries:
  in: {{type: inlet, {at("x-min")}{GAS}, formula: {{velocity: "{PROFILE}"}}}}
  out: {{type: outlet, {at("x-max")}{GAS}}}
  low: {{type: wall, {at("y-min")}temperature: {low}}}
  high: {{type: wall, {at("y-max")}temperature: 300 K}}
"""


AXES = "x: [{to: 10 mm, cells: 10}], y: [{to: 5 mm, cells: 12}]"
BOX = f"mesh: {{geometry: planar, {AXES}}}\n"
SPACE = f"mesh: {{geometry: space, {AXES}, z: [{{to: 4 mm, cells: 3}}]}}\n"
BACK = "  front: {type: periodic, side: z-min}\n  back: {type: periodic, side: z-max}\n"


def columns(path: pathlib.Path) -> dict:
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert rows, f"{path} is empty"
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def tables(folder: pathlib.Path) -> dict:
    return {path.stem: columns(path) for path in sorted((folder / "tables").glob("*.csv"))}


def run(program, deck: pathlib.Path, out: pathlib.Path, *more) -> dict:
    result = program("run", deck, "--out", out, *more, timeout=300)
    assert result.code == 0, f"{out}: exit code {result.code}: {result.err}"
    found = tables(out)
    # The results have the same numbers.
    with h5py.File(out / "results.h5", "r") as file:
        for name, table in found.items():
            kind, what = name.split("_", 1)
            group = file[{"probe": "probes", "line": "lines", "boundary": "boundaries", "wall": "walls"}[kind]][what]
            for column, values in table.items():
                dataset = group[column.rsplit(" [", 1)[0]]
                unit = dataset.attrs["unit"]
                assert (unit.decode("utf-8") if isinstance(unit, bytes) else unit) == column.rsplit(" [", 1)[1].rstrip("]")
                assert np.array_equal(dataset[()], values), f"{name}: {column}"
    return found


def near(found, expected, tolerance, what):
    away = np.abs(np.asarray(found) - expected).max()
    assert away <= tolerance, f"{what}: {found} is not {expected} by {away}, more than {tolerance}"


def check_shapes(out: pathlib.Path, found: dict, unit: str, depth: str) -> None:
    assert set(found) == {"probe_middle", "probe_corner", "probe_end", "line_across", "wall_low", "wall_high",
                          *(f"boundary_{b}" for b in ("in", "out", "low", "high"))}
    history = columns(out / "history.csv")
    for name in found:
        if name != "line_across" and not name.startswith("wall_"):
            assert np.array_equal(found[name]["step [1]"], history["step [1]"]), f"{name}: not a row a row of the history"
            assert np.array_equal(found[name]["time [s]"], history["time [s]"])
    line = found["line_across"]
    near(line["time [s]"].reshape(3, 6), np.array([[0], [10e-3], [20e-3]]), 1e-15, "times of outputs")
    near(line["distance [m]"].reshape(3, 6), np.linspace(0, HEIGHT, 6), 1e-15, "distance along the line")
    near(line["y [m]"], line["distance [m]"], 1e-15, "y along the line")
    assert (depth in line) == (unit == "")
    assert f"viscous_force_x [N{unit}]" in found["boundary_low"] and f"mass_flow [kg/s{unit}]" in found["boundary_in"]


def force(table: dict, part: str, axis: str) -> np.ndarray:
    return next(values for name, values in table.items() if name.startswith(f"{part}_force_{axis} "))


def of(table: dict, start: str) -> np.ndarray:
    return next(values for name, values in table.items() if name.startswith(start + " ["))


def check_balances(out: pathlib.Path, found: dict, depth: float) -> None:
    """Mass to round-off in every step."""
    walls = [found[f"boundary_{b}"] for b in ("in", "out", "low", "high")]
    history = columns(out / "history.csv")
    gained = sum(of(table, "mass_flow") for table in walls)[1:] * history["dt [s]"][1:]
    content = of(history, "mass_content")
    near(gained, np.diff(content), 1e-12 * content[0], "mass that came in")
    near(of(walls[0], "area"), HEIGHT * depth, 1e-12, "area of the entrance")
    near(of(walls[2], "area"), LENGTH * depth, 1e-12, "area of a wall")
    for wall in ("low", "high"):
        faces = found[f"wall_{wall}"]
        last = of(faces, "step") == of(faces, "step")[-1]
        near(of(faces, "area")[last].sum(), LENGTH * depth, 1e-12, "area of all faces of a wall")
        force_of_faces = (of(faces, "friction_x") * of(faces, "area"))[last].sum()
        near(force_of_faces / force(found[f"boundary_{wall}"], "viscous", "x")[-1], 1, 1e-6, f"friction of the faces of {wall}")
    flow = 101325 * 0.028014 / (8.314462618 * 300) * SPEED * HEIGHT * depth
    near(of(walls[0], "mass_flow") / flow, 1, 0.01, "mass flow through the entrance")
    assert np.all(of(walls[1], "mass_flow") < 0) and np.all(of(walls[2], "mass_flow") == 0)


def check_isothermal(found: dict, depth: float, rough: float) -> None:
    """Of walls as cold as the gas: a plane Poiseuille flow, whose walls have the shear stress 6 mu U / H."""
    walls = {b: found[f"boundary_{b}"] for b in ("in", "out", "low", "high")}
    friction = 6 * VISCOSITY * SPEED / HEIGHT * LENGTH * depth
    # On n cells of one size, with the slope at the wall from half a cell, the parabola of the same flow is lower by 1 + 2/n^2.
    for wall in ("low", "high"):
        near(force(walls[wall], "viscous", "x")[-1] / friction, 1 / (1 + 2 / 12**2), rough, f"friction of {wall}")
    # What the pressure pushes with is what the walls hold back; the momentum that comes in leaves.
    push = -sum(force(walls[b], "pressure", "x")[-1] for b in ("in", "out"))
    held = sum(force(walls[b], "viscous", "x")[-1] for b in ("low", "high"))
    near(push / held, 1, 3 * rough, "balance of forces along the channel")
    # Pressures on triangles have noise of first order, and in a corner's triangle no slope: a tenth of a force of 2 times friction.
    pressed = force(walls["high"], "pressure", "y")[-1], force(walls["low"], "pressure", "y")[-1]
    near(sum(pressed), 0, 4 * rough * friction, "pressure on both walls")
    assert pressed[0] > friction > -friction > pressed[1]
    # The pressure is known where the gas leaves; the last cells have a twentieth of the channel's drop.
    near(found["probe_end"]["pressure [Pa]"][-1], 0, 0.005 * 12 * VISCOSITY * SPEED * LENGTH / HEIGHT**2, "pressure at the end")
    near(found["probe_middle"]["velocity_x [m/s]"][-1], 1.5 * SPEED, 0.02 * SPEED, "velocity in the middle")
    line = found["line_across"]
    y = line["y [m]"][-6:]
    near(line["velocity_x [m/s]"][-6:], 6 * SPEED * y * (HEIGHT - y) / HEIGHT**2, 0.05 * SPEED, "parabola")
    if rough < 0.05:
        # From the centre of the cell at a wall along the parabola through the wall: off by its curvature over half a cell.
        near(line["velocity_x [m/s]"][[-6, -1]], 0, 1.5 * 6 * SPEED / 24**2, "no slip at the walls")
    for name in ("probe_middle", "line_across"):
        near(found[name]["temperature [K]"], 300, 1e-6, "temperature")


def check_warm(history: dict, found: dict, depth: float) -> None:
    """Of a warm wall below: heat comes in there, part of it leaves above, the rest with the gas."""
    walls = {b: found[f"boundary_{b}"] for b in ("in", "out", "low", "high")}
    heat = {b: of(table, "heat_flow")[-1] for b, table in walls.items()}
    enthalpy = {b: of(table, "enthalpy_flow")[-1] for b, table in walls.items()}
    # Between 310 K and 300 K, 5 mm apart: 0.0257 W/m/K give 51 W/m^2, and more where the gas comes in cold.
    conducted = 0.0257 * 10 / HEIGHT * LENGTH * depth
    assert conducted < heat["low"] < 8 * conducted, f"{heat['low']} W through the warm wall, {conducted} by conduction alone"
    assert -conducted * 1.05 < heat["high"] < 0, f"{heat['high']} W through the cold wall"
    for wall in ("low", "high"):
        near(enthalpy[wall], heat[wall], 1e-9 * conducted, "all that comes through a wall is heat")
    # The gas has rho h = cp (rho T - 298.15 K rho), and rho T is the same everywhere and always, but for the pressure's drift.
    content = of(history, "mass_content")
    gained = sum(of(table, "enthalpy_flow") for table in walls.values())[1:] * history["dt [s]"][1:]
    given = heat["low"] * history["dt [s]"][1:]
    near((gained + 29.10061917 / 0.028014 * 298.15 * np.diff(content)) / given, 0, 0.02, "energy that came in")
    near(found["line_across"]["temperature [K]"][-6], 310, 0.05, "temperature at the warm wall")


def check(programs: dict, name: str, folder: pathlib.Path, gmsh_text) -> None:
    deck = folder / "deck.yaml"
    depth = 4e-3 if name == "space" else 1.0
    unit = "" if name == "space" else "/m"
    mesh = {"box": BOX, "space": SPACE}.get(name, "mesh: {geometry: planar, file: mesh.msh, unit: 1 mm}\n")
    if name == "triangles":
        (folder / "mesh.msh").write_text(gmsh_text(10, 12, lambda i, j: True), encoding="utf-8")
    places = TABLES % ((", 1 mm",) * 5 if name == "space" else ("",) * 5)
    for low in ("300 K", "310 K"):
        text = HEAD + mesh + boundaries(low, name != "triangles") + (BACK if name == "space" else "") + places
        deck.write_text(text, encoding="utf-8")
        of_ranks = {}
        for ranks, program in programs.items():
            if ranks > 1 and low != ("310 K" if name == "box" else "300 K"):
                continue
            out = folder / f"{low[:3]}_{ranks}"
            of_ranks[ranks] = run(program, deck, out)
            check_shapes(out, of_ranks[ranks], unit, "z [m]")
            check_balances(out, of_ranks[ranks], depth)
            if low == "300 K":
                # Triangles out of line have a slope of first order at the wall.
                check_isothermal(of_ranks[ranks], depth, 0.1 if name == "triangles" else 0.01)
            else:
                check_warm(columns(out / "history.csv"), of_ranks[ranks], depth)
        first, *others = of_ranks.values()
        for other in others:
            for table, found in other.items():
                for column, values in found.items():
                    scale = max(np.abs(first[table][column]).max(), 1e-3 if "heat_flux" in column else 1e-6)
                    near(values / scale, first[table][column] / scale, 1e-4 if "velocity_y" in column or "force_y" in column or
                         "viscous" in column or "friction" in column else 1e-5, f"{name}: {table}, {column} on other ranks")


def check_initial(program, folder: pathlib.Path) -> None:
    """A field that is linear at the start is met exactly, two cells away from boundaries that have other values."""
    deck = folder / "deck.yaml"
    text = HEAD.replace(f'velocity_x: "{PROFILE}"', "temperature: '300 + 1000*x + 2000*y'") + BOX + boundaries("300 K", True)
    deck.write_text(text + "output:\n  lines: {along: {from: [2.5 mm, 1.3 mm], to: [7.5 mm, 3.7 mm], points: 8}}\n", encoding="utf-8")
    line = run(program, deck, folder / "out", *running.settings("time.end=0.1 ms"))["line_along"]
    start = line["time [s]"] == 0
    near(line["temperature [K]"][start], 300 + 1000 * line["x [m]"][start] + 2000 * line["y [m]"][start], 1e-9, "linear start")
    for column in ("velocity_x [m/s]", "velocity_y [m/s]", "pressure [Pa]", "density [kg/m^3]", "X_GAS [1]"):
        assert column in line, f"{column} is no usual quantity"
    assert "viscosity [Pa s]" not in line


def check_refused(programs: dict, folder: pathlib.Path) -> None:
    deck = folder / "deck.yaml"
    deck.write_text(HEAD + BOX + boundaries("300 K", True), encoding="utf-8")
    mistakes = [
        ("output.probes={away: {at: [12 mm, 1 mm]}}", ["probes.away.at", "(0.012, 0.001) m", "from (0, 0) m to (0.01, 0.005) m"]),
        ("output.lines={cut: {from: [0 mm, 1 mm], to: [0 mm, 6 mm]}}", ["lines.cut", "outside the mesh"]),
        ("output.lines={cut: {from: [1 mm, 1 mm], to: [1 mm, 1 mm]}}", ["lines.cut", "differ"]),
        ("output.probes={away: {at: [1 mm]}}", ["probes.away.at", "2 coordinates"]),
        ("output.probes={'a b': {at: [1 mm, 1 mm]}}", ["'a b'", "letters"]),
        ("output.boundaries=[lid]", ["'lid'", "in, out, low, high"]),
        ("output.boundaries=[in, in]", ["'in'", "twice"]),
    ]
    for setting, words in mistakes:
        for program in programs.values():
            result = program("run", deck, "--out", folder / "refused", "--set", setting)
            assert result.code == 2, f"{setting}: exit code {result.code}: {result.err}"
            for word in words:
                assert word in result.err, f"{setting}: {word} is not in {result.err}"
            assert not (folder / "refused").exists()
    result = programs[1]("check", deck, "--set", "output.quantities=[heat]", "--set", "output.probes={p: {at: [1 mm, 1 mm]}}")
    assert result.code == 2 and "'heat'" in result.err and "temperature" in result.err, result.err


def check_replaced(program, folder: pathlib.Path) -> None:
    """A run that replaces another leaves none of its tables, and nothing else is taken."""
    deck, out = folder / "deck.yaml", folder / "again"
    deck.write_text(HEAD + BOX + boundaries("300 K", True), encoding="utf-8")
    short = running.settings("time.end=0.1 ms")
    run(program, deck, out, *short, "--set", "output.boundaries=[in]")
    (out / "tables/mine.csv").write_text("kept", encoding="utf-8")
    result = program("run", deck, "--out", out, "--force", *short, "--set", "output.boundaries=[out]")
    assert result.code == 0, result.err
    assert sorted(path.name for path in (out / "tables").iterdir()) == ["boundary_out.csv", "mine.csv"]


def main(executable: str, *mpiexec: str) -> int:
    from flow_mesh_run_test import gmsh_text

    programs = {ranks: running.Program(executable, list(mpiexec), ranks) for ranks in (1, 2)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for part in ("box", "triangles", "space", "initial", "refused", "replaced"):
            (folder / part).mkdir()
        check(programs, "box", folder / "box", gmsh_text)
        check(programs, "triangles", folder / "triangles", gmsh_text)
        check(programs, "space", folder / "space", gmsh_text)
        check_initial(programs[1], folder / "initial")
        check_refused(programs, folder / "refused")
        check_replaced(programs[1], folder / "replaced")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
