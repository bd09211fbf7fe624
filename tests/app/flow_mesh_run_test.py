"""Runs on meshes that are no plane boxes: on a file of triangles, on one of triangles and quadrilaterals, with a solid, in space
and between bent walls. On two ranks as on one; meshio reads what they leave, scripts/plot draws it, and a checkpoint knows its mesh.

Usage: flow_mesh_run_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

h5py, np = running.package("h5py"), running.package("numpy")
meshio = running.package("meshio")
running.needs("matplotlib")

GAS = 'temperature: 300 K, composition: "GAS: 1"'
HEAD = f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/perfect_gas_1.yaml
transport:
  model: unity_lewis
  sutherland: {{viscosity: 1.68e-5 Pa s, temperature: 273 K, constant: 110.5 K, prandtl_number: 0.71}}
initial: {{layer: none, {GAS}}}
time: {{end: 1 ms, first_step: 50 us}}
checkpoint: {{at_end: true}}
"""
NAMED = f"""boundaries:
  in: {{type: inlet, velocity: 50 cm/s, {GAS}}}
  out: {{type: outlet, {GAS}}}
  low: {{type: wall, temperature: 310 K}}
  high: {{type: wall, temperature: 300 K}}
"""
SIDES = f"""boundaries:
  in: {{type: inlet, side: x-min, velocity: 50 cm/s, {GAS}}}
  out: {{type: outlet, side: x-max, {GAS}}}
  low: {{type: wall, side: y-min, temperature: 310 K}}
  high: {{type: wall, side: y-max, temperature: 300 K}}
"""
AXES = "x: [{to: 10 mm, cells: 10}], y: [{to: 5 mm, cells: 6}]"
DECKS = {
    "triangles": "mesh: {geometry: planar, file: mesh.msh, unit: 1 mm}\n" + NAMED,
    "mixed": "mesh: {geometry: planar, file: mesh.msh, unit: 1 mm}\n" + NAMED,
    "solid": f"mesh: {{geometry: planar, {AXES}, solids: {{rod: {{x: [3 mm, 5 mm], y: [1.6 mm, 3.4 mm]}}}}}}\n"
             + SIDES + "  rod: {type: wall, solid: rod, temperature: 300 K}\n",
    "space": f"mesh: {{geometry: space, {AXES}, z: [{{to: 4 mm, cells: 4}}]}}\n"
             + SIDES + "  front: {type: periodic, side: z-min}\n  back: {type: periodic, side: z-max}\n",
    "bent": f"mesh: {{geometry: planar, {AXES}, floor: {{formula: \"0.001*sin(300*x)\"}}}}\n" + SIDES,
}


def gmsh_text(columns: int, rows: int, is_split, wall_row=None) -> str:
    """A channel of 10 x 5 mm with vertices out of line; `is_split(i, j)`: whether a cell is two triangles. `wall_row`: the row
    of vertices that is the group 5, without a name; the two halves of the left end are groups of their own then."""
    def vertex(i, j):
        return i + (columns + 1) * j + 1

    def bulge(i, j):
        inside = 0 < i < columns and 0 < j < rows and j != wall_row
        return 0.15 * ((i * 7 + j * 3) % 5 - 2) / 2 if inside else 0.0

    nodes = [(10 * (i + bulge(i, j)) / columns, 5 * (j + bulge(j + 3, i + 1) * (bulge(i, j) != 0)) / rows)
             for j in range(rows + 1) for i in range(columns + 1)]
    quads, triangles = [], []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            if is_split(i, j):
                triangles += [(a, b, c), (a, c, d)]
            else:
                quads.append((a, b, c, d))
    lines = {
        "low": [(vertex(i, 0), vertex(i + 1, 0)) for i in range(columns)],
        "out": [(vertex(columns, j), vertex(columns, j + 1)) for j in range(rows)],
        "high": [(vertex(i, rows), vertex(i + 1, rows)) for i in range(columns)],
        "in": [(vertex(0, j), vertex(0, j + 1)) for j in range(rows)],
    }
    named = len(lines)
    if wall_row is not None:
        lines["wall"] = [(vertex(i, wall_row), vertex(i + 1, wall_row)) for i in range(columns)]
        lines["in"], lines["above"] = lines["in"][:wall_row], lines["in"][wall_row:]
    text = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(named)]
    text += [f'1 {k} "{name}"' for k, name in enumerate(list(lines)[:named], 1)]
    text += ["$EndPhysicalNames", "$Entities", f"0 {len(lines)} 1 0"]
    text += [f"{k} 0 0 0 10 5 0 1 {k} 0" for k in range(1, len(lines) + 1)] + ["1 0 0 0 10 5 0 0 0", "$EndEntities"]
    text += ["$Nodes", f"1 {len(nodes)} 1 {len(nodes)}", f"2 1 0 {len(nodes)}"]
    text += [str(k + 1) for k in range(len(nodes))] + [f"{x:.12g} {y:.12g} 0" for x, y in nodes] + ["$EndNodes"]
    blocks = [(1, k, 1, some) for k, some in enumerate(lines.values(), 1)]
    blocks += [(2, 1, kind, some) for kind, some in ((3, quads), (2, triangles)) if some]
    count = sum(len(some) for *_, some in blocks)
    text += ["$Elements", f"{len(blocks)} {count} 1 {count}"]
    tag = 0
    for dimension, entity, kind, some in blocks:
        text.append(f"{dimension} {entity} {kind} {len(some)}")
        for corners in some:
            tag += 1
            text.append(" ".join(map(str, (tag, *corners))))
    return "\n".join(text + ["$EndElements", ""])


def fields_of(folder: pathlib.Path) -> dict:
    with h5py.File(folder / "results.h5", "r") as file:
        step = file["steps"][max(file["steps"])]
        return {"vertices": file["mesh/vertices"][()], "cells": file["mesh/cells"][()],
                **{name: step[name][()] for name in step}}


def run(program, deck: pathlib.Path, out: pathlib.Path, *more) -> None:
    result = program("run", deck, "--out", out, *more, timeout=300)
    assert result.code == 0, f"{out}: exit code {result.code}: {result.err}"


def check_pictures(folder: pathlib.Path, draws: bool) -> None:
    for script in (".ci/check_results.py", *(("scripts/plot",) if draws else ())):
        done = running.script(running.SOURCE / script, folder)
        assert done.code == 0, f"{script}: {done.out}{done.err}"
    for picture in ("temperature", "velocity") if draws else ():
        assert (folder / "pictures" / f"{picture}.png").stat().st_size > 0, f"{picture} is empty"


def check_mixed_xdmf(folder: pathlib.Path, cells, repeated) -> None:
    """Triangles are triangles for ParaView, which meshio reads as blocks of one kind one after the other."""
    with meshio.xdmf.TimeSeriesReader(folder / "results.xdmf") as reader:
        _, blocks = reader.read_points_cells()
    assert {block.type for block in blocks} == {"triangle", "quad"}
    found = [list(cell) for block in blocks for cell in block.data]
    expected = [list(cell[:3]) if is_triangle else list(cell) for cell, is_triangle in zip(cells, repeated)]
    assert found == expected, "other cells than those of /mesh/cells"


def check(one, two, name: str, folder: pathlib.Path) -> None:
    deck = folder / "deck.yaml"
    deck.write_text(HEAD + DECKS[name], encoding="utf-8")
    if "file:" in DECKS[name]:
        (folder / "mesh.msh").write_text(gmsh_text(10, 6, lambda i, j: name == "triangles" or (i + j) % 3 == 0), encoding="utf-8")
    run(one, deck, folder / "one")
    run(two, deck, folder / "two")
    a, b = fields_of(folder / "one"), fields_of(folder / "two")
    assert a.keys() == b.keys()
    assert np.array_equal(a["cells"], b["cells"]) and np.array_equal(a["vertices"], b["vertices"])
    # The pressure solver's tolerance apart, ranks change the order of sums alone.
    for field in ("temperature", "velocity", "density"):
        scale = np.abs(a[field]).max()
        away = np.abs(a[field] - b[field]).max() / scale
        assert away < 1e-6, f"{name}: {field} on two ranks is {away:.1e} away"
    velocity = np.linalg.norm(a["velocity"], axis=1)
    assert 0.5 < velocity.max() < 1.5, f"{name}: velocities up to {velocity.max()} m/s"
    # Diffusion across cells out of line undershoots a little beside the warm wall's cold end.
    assert 300.5 < a["temperature"].max() < 310.01 and a["temperature"].min() > 299, f"{name}: an odd temperature"
    corners = {"triangles": 3, "space": 8}.get(name, 4)
    assert a["cells"].shape[1] == corners
    if name == "mixed":
        repeated = a["cells"][:, 2] == a["cells"][:, 3]
        assert 0 < repeated.sum() < len(repeated), "no mixture of triangles and quadrilaterals"
        for ranks in ("one", "two"):
            check_mixed_xdmf(folder / ranks, a["cells"], repeated)
    check_pictures(folder / "one", draws=name not in ("triangles", "bent"))  # drawn as "mixed" is


def check_thin_wall(one, two, folder: pathlib.Path) -> None:
    """Gas of 300 K in a channel; gas of 400 K comes in above a wall of no thickness, from end to end. Where the walls are adiabatic
    and the gas slips along them nothing of it reaches the channel below. The wall goes by the number of its group."""
    deck = folder / "deck.yaml"
    warm = GAS.replace("300 K", "400 K")
    text = HEAD.replace("checkpoint: {at_end: true}\n", "output: {boundaries: [all]}\n").replace("end: 1 ms", "end: 2 ms") + DECKS["triangles"].replace(
        "low: {type: wall, temperature: 310 K}", "low: {type: wall, slip: true}").replace(
        "high: {type: wall, temperature: 300 K}", "high: {type: wall, slip: true}")
    text += f"  physical 6: {{type: inlet, velocity: 50 cm/s, {warm}}}\n  5: {{type: wall, slip: true}}\n"
    deck.write_text(text, encoding="utf-8")
    (folder / "mesh.msh").write_text(gmsh_text(10, 6, lambda i, j: (i + j) % 3 == 0, 3), encoding="utf-8")
    for program, name in ((one, "thin_one"), (two, "thin_two")):
        run(program, deck, folder / name)
        tables = sorted(path.name for path in (folder / name / "tables").iterdir())
        assert tables == [f"boundary_{b}.csv" for b in ("5", "high", "in", "low", "out", "physical_6")], tables
    with h5py.File(folder / "thin_one/results.h5", "r") as file:
        above = file["mesh/cellCentre"][()][:, 1] > 2.5e-3
    for name in ("thin_one", "thin_two"):
        temperature = fields_of(folder / name)["temperature"]
        away = np.abs(temperature[~above] - 300).max()
        assert away < 1e-9, f"through a wall of no thickness the gas below has become {away} K warmer"
        assert temperature[above].max() > 390, f"{temperature[above].max()} K above the wall"


def check_checkpoint(one, folder: pathlib.Path) -> None:
    """A run goes on from its checkpoint on the same mesh, and refuses another."""
    deck, mesh = folder / "deck.yaml", folder / "mesh.msh"
    run(one, deck, folder / "one", "--restart", "--set", "time.end=1.1 ms")
    mesh.write_text(mesh.read_text(encoding="utf-8").replace("$EndElements\n", "$EndElements\n\n"), encoding="utf-8")
    result = one("run", deck, "--out", folder / "one", "--restart", "--set", "time.end=1.2 ms")
    assert result.code == 2 and "mesh" in result.err, f"another file: exit code {result.code}: {result.err}"


def main(executable: str, *mpiexec: str) -> int:
    one, two = (running.Program(executable, list(mpiexec), ranks) for ranks in (1, 2))
    for name in DECKS:
        with tempfile.TemporaryDirectory() as folder:
            check(one, two, name, pathlib.Path(folder))
            if name == "mixed":
                check_checkpoint(one, pathlib.Path(folder))
            if name == "triangles":
                check_thin_wall(one, two, pathlib.Path(folder))
            print(f"{name}: passed")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
