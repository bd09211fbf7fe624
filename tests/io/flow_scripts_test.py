"""What scripts/mesh_to_gmsh writes of a run's box, and what scripts/compare_flows says of two runs, scripts/compare_santoro,
compare_turbulent_step, compare_wall_friction, compare_round_jet, compare_pipe_deposition and compare_sandia_d of some, on results written here."""

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


def check_santoro(folder):
    """A flame that is a formula: soot that grows over the radius of 8 mm and lies between 20 and 60 mm of height."""
    r, z = np.linspace(0, 8e-3, 9), np.linspace(0, 0.12, 61)
    hot = write_run(folder / "hot", r, z, lambda r, z: 1500 - 1e5 * np.abs(z - 0.051) + 0 * r)
    row = called("compare_santoro", hot)[1].splitlines()
    assert len(row) == 5 and "on the axis 1500 K at 51.0 mm" in row[0], row
    with h5py.File(hot / "results.h5", "a") as file:
        r, z = file["mesh/cellCentre"][()][:, :2].T
        file["steps/000003/soot_volume_fraction"] = 1e-3 * r * ((z > 0.02) & (z < 0.06))
    code, told, err = called("compare_santoro", hot, "--out", folder / "out")
    assert code == 0 and (folder / "out/santoro.png").is_file(), err
    lines = told.splitlines()
    assert "largest f_v 7.5 ppm" in lines[1] and "from 21.0 to 59.0 mm" in lines[1], lines[1]
    rows = {}
    for line in lines[2:-1]:
        name, numbers = line[2:28].strip(), line[28:].split()
        rows[name] = dict(zip(heights, map(float, numbers))) if name != "height, mm" else rows.get(name)
        heights = numbers if name == "height, mm" else heights
    assert abs(rows["T on the axis, K"]["40.35"] - (1500 - 1e2 * (51 - 40.35))) < 1, rows
    assert rows["f_v where largest, ppm"]["30"] == 7.5 and rows["f_v where largest, ppm"]["80"] == 0, rows
    assert rows["f_v on the axis, ppm"]["30.33"] == 0.5, rows
    # The integral of r over the cross-section, cell by cell: 2 pi sum of centre times ring.
    inner = np.arange(8) * 1e-3
    exact = 1e-3 * np.sum(np.pi * ((inner + 1e-3) ** 2 - inner**2) * (inner + 0.5e-3))
    assert abs(rows["integral of f_v, 1e-10 m2"]["39.73"] / (1e10 * exact) - 1) < 1e-3, (rows, exact)
    # Averages over time: on the axis 1 ppm and one bin, at 6.5 mm 3 ppm and the other; the last moment is not taken.
    with h5py.File(hot / "results.h5", "a") as file:
        fields, wing = file["steps/000003"], np.abs(r - 6.5e-3) < 1e-6
        fields["soot_volume_fraction_mean"] = np.where(wing, 3e-6, 1e-6)
        for name, value in (("number_density", 4e16), ("mobility_diameter", 2e-8)):
            fields[f"soot_{name}_mean"] = np.where(wing, value, 0.5 * value)
        for name, value in (("volume_fraction", 1e-7), ("number_density", 1e15), ("mobility_diameter", 1e-9)):
            fields[f"soot_{name}_interval"] = np.full(len(r), value)
        fields["soot_size_distribution_mean"] = np.stack([np.where(wing, 0, 1e17), np.where(wing, 1e17, 0)], axis=-1)
        file["soot_sizes/bin_edges"] = [1e-9, 1e-8, 1e-7]
    code, told, err = called("compare_santoro", hot, "--out", folder / "sizes")
    assert code == 0 and all((folder / "sizes" / name).is_file() for name in ("sizes.png", "places.png")), err
    lines = [line.split() for line in told.splitlines() if line.startswith(("  axis", "  wing"))]
    assert len(lines) == 10 and "largest f_v 3 ppm" in told, told
    assert lines[0] == "axis 19.0 0.50 1 +- 0.1 2e+10 +- 1e+09 10 +- 1".split(), lines[0]
    assert lines[5] == "wing 19.0 6.50 3 +- 0.1 4e+10 +- 1e+09 20 +- 1".split(), lines[5]
    code, _, err = called("compare_santoro", write_run(folder / "bowed", np.arange(3.0), np.arange(3.0), lambda r, z: r,
                                                       {"mesh": {"file": "bowed.msh"}}))
    assert code == 2 and "a box of cells" in err, err


def check_turbulent_step(folder):
    """A stream that grows in proportion to the height, friction that does so along the floor, and a pressure of its own."""
    height, end, speed, zero = 0.0127, 1.397, 40.0, 6.2
    solid = {"x": [0, end], "y": [0, height]}
    x = np.concatenate([np.linspace(0, end, 201), end + height * np.linspace(0, 50, 151)[1:]])
    run = write_run(folder / "step", x, height * np.linspace(0, 9, 46), lambda x, y: 300 + 0 * x, {"mesh": {"solids": {"step": solid}}})
    with h5py.File(run / "results.h5", "r+") as file:
        centres, step = file["mesh/cellCentre"][()], file["steps/000003"]
        along = (centres[:, 0] - end) / height
        step["velocity"] = np.stack([speed * (centres[:, 1] / height - 1) / 8, 0 * along, 0 * along], axis=1)
        step["density"], step["pressure"] = np.full(len(along), 1.2), 7.0 + 3.0 * np.minimum(along, 20)
        for wall, places in (("floor", np.linspace(-10, 49.9, 600)), ("step", np.linspace(-20, -0.1, 200))):
            at, first = file.create_group(f"walls/{wall}"), np.zeros(len(places))
            shear = 0.5 * (places - zero) if wall == "floor" else first + 2.5
            # An output before the last, which does not count.
            for name, values in (("step", first + 3), ("x", end + height * places), ("y", first + (height if wall == "step" else 0)),
                                 ("friction_x", shear)):
                at[name] = np.concatenate([first if name == "step" else values + 1, values])
    code, told, err = called("compare_turbulent_step", run, "--json", "--picture", folder / "step.png")
    assert code == 0 and (folder / "step.png").stat().st_size > 1000, err
    found = json.loads(told)
    top = speed * (1 - 0.1 / 8)  # of the highest cell
    assert abs(found["speed"] / top - 1) < 1e-9 and abs(found["thickness"] / (0.99 * 7.9) - 1) < 1e-9, found
    half = 0.5 * 1.2 * top**2
    assert abs(found["cf_before"] * half / 2.5 - 1) < 1e-9, found
    assert len(found["turns"]) == 1 and abs(found["turns"][0] - zero) < 1e-6, found
    assert abs(found["cp_least"] * half - 3 * (1 / 6 - 20)) < 1e-6, found
    (row,) = [row for row in found["cf"] if abs(row["at"] - 9.2) < 0.05]
    assert abs(row["cf"] * half - 0.5 * (row["at"] - zero)) < 1e-6 and abs(row["cfl3d"] - 0.00079) < 2e-5, row
    assert abs(row["measured"] - 0.00118) < 1e-5, row
    code, _, err = called("compare_turbulent_step", folder / "nowhere")
    assert code == 2 and "nowhere" in err, err


def check_wall_friction(folder):
    """Friction over a bump that falls along the wall, on three meshes whose errors fall by four; a pressure that is CFL3D's and 0.01."""
    speed, start = 47.0, 10.0
    with open(ROOT / "cases/flow/turbulent_bump/reference/bump_cp_x.csv", encoding="utf-8") as file:
        rows = [line.split(",") for line in file if line.startswith("SA,CFL3D")]
    known = np.array(sorted((float(row[2]), float(row[3])) for row in rows)).T
    runs = []
    for level in range(3):
        x = np.concatenate([[0.0], start + np.linspace(0, 1.5, 301), [14.0]])
        run = write_run(folder / f"bump{level}", x, np.linspace(0, 5, 6), lambda x, y: 300 + 0 * x,
                        {"boundaries": {"entrance": {"velocity": speed}, "wall": {"from": start}}})
        with h5py.File(run / "results.h5", "r+") as file:
            centres, step, at = file["mesh/cellCentre"][()], file["steps/000003"], file.create_group("walls/wall")
            half, places = 0.5 * 1.2 * speed**2, 0.5 * (x[1:-2] + x[2:-1])
            shear = half * 0.005 * (1 + 0.1 / 4**level) * (1.6 - (places - start))
            step["density"], step["eddy_viscosity"] = np.full(len(centres), 1.2), 1e-4 * (centres[:, 1] < 2)
            step["viscosity"] = np.full(len(centres), 2e-5)
            step["pressure"] = half * (np.interp(centres[:, 0] - start, *known) + 0.01) + 7 * (centres[:, 1] > 1)
            # An output before the last, which does not count; friction along a slope of three in four.
            for name, values in (("step", 0 * shear + 3), ("x", places), ("friction_x", 0.8 * shear), ("friction_y", 0.6 * shear),
                                 ("y_plus", 0 * shear + 0.4)):
                at[name] = np.concatenate([0 * shear if name == "step" else values + 1, values])
        runs.append(run)
    code, told, err = called("compare_wall_friction", *runs, "--case", "turbulent_bump", "--model", "sa", "--json", "--picture", folder / "bump.png")
    assert code == 0 and (folder / "bump.png").stat().st_size > 1000, err
    found = json.loads(told)
    exact = [0.005 * (1.6 - x) for x in found["at"]]
    for (order, value), of, finest in zip(found["extrapolated"], exact, found["runs"][2]["cf"]):
        assert abs(order - 2) < 1e-3 and abs(value / of - 1) < 1e-5 and abs(finest / of - 1.00625) < 1e-5, (found, exact)
    assert abs(found["runs"][0]["ratio"] - 5) < 1e-9 and abs(found["runs"][0]["y_plus"] - 0.4) < 1e-9, found
    assert abs(found["known"]["CFL3D"][0] - 0.00615) < 1e-5 and abs(found["cp"]["CFL3D"]["shift"] - 0.01) < 1e-6, found
    assert found["cp"]["CFL3D"]["apart"] < 1e-6, found
    # With the factor for a Mach number of 0.2 a pressure that is CFL3D's is too large by what the factor is above one.
    more = (1 / 0.96**0.5 - 1) * np.interp(np.linspace(0.0525, 1.4475, 280), *known)
    assert abs(found["cp"]["CFL3D"]["apart_compressed"] / (np.abs(more - np.median(more)).max() / np.ptp(known[1])) - 1) < 1e-3, found
    # Of the hump the friction's changes of sign, in chords, the velocity before it, of which CFL3D's reference velocity is 1/1.0003 with
    # SA and 1/0.9965 with SST, and the largest shear stress on rows that rise by a tenth of their length.
    x = 2.684 + 0.42 * np.linspace(-3, 2, 501)
    run = write_run(folder / "hump", x, np.linspace(0, 0.4, 5), lambda x, y: 300 + 0 * x, {"boundaries": {"entrance": {"velocity": 30.0}, "wall": {}}})
    with h5py.File(run / "results.h5", "r+") as file:
        centres, step, at = file["mesh/cellCentre"][()], file["steps/000003"], file.create_group("walls/wall")
        places = 0.5 * (x[1:] + x[:-1])
        chords = (places - 2.684) / 0.42
        along, height = centres.T[:2]
        step["density"], step["eddy_viscosity"] = np.full(len(centres), 1.2), 1e-3 * np.where(np.abs(height - 0.15) < 0.01, 1.2, 0.6)
        step["viscosity"], step["pressure"] = np.full(len(centres), 2e-5), np.zeros(len(centres))
        height = height + 0.1 * (along - 2.684) * (along > 2)
        file["mesh/cellCentre"][:, 1] = height
        step["velocity"] = np.stack([35.0 + (10 + 100 * height) * (along > 2), 7 * along + 50 * height], axis=1)
        for name, values in (("step", 0 * places + 3), ("x", places), ("friction_x", 0.6 * 35**2 * (chords - 0.66) * (chords - 1.26)),
                             ("friction_y", 0 * places), ("y_plus", 0 * places + 0.4)):
            at[name] = values
    code, told, err = called("compare_wall_friction", run, "--case", "turbulent_hump", "--model", "sa", "--json", "--picture", folder / "hump.png")
    assert code == 0, err
    found = json.loads(told)
    assert np.allclose(found["runs"][0]["turns"], [0.66, 1.26], atol=1e-4), found
    exact = np.array([(x - 0.66) * (x - 1.26) for x in found["at"]])
    assert np.allclose(found["runs"][0]["cf"], 1.0003**2 * exact, rtol=1e-3, atol=5e-5), found
    assert abs(found["known"]["CFL3D"][1] - 0.00664) < 1e-5, found
    shear, height = found["runs"][0]["shear"]["1.0"]
    assert abs(shear / (1e-3 * (100 + 7) * (1.0003 / 35) ** 2) - 1) < 1e-6 and abs(height - 0.15 / 0.42 - 0.1) < 1e-3, found
    code, told, err = called("compare_wall_friction", run, "--case", "turbulent_hump", "--model", "sst")
    assert code == 0 and abs(float(told.split("cells:")[1].split()[0]) / (0.9965**2 * exact[0]) - 1) < 1e-3 and "stress at 1.3" in told, told + err
    code, told, err = called("compare_wall_friction", run, "--case", "turbulent_hump", "--json")
    assert code == 0 and np.allclose(json.loads(told)["runs"][0]["cf"], exact, rtol=1e-3, atol=5e-5), told + err
    code, _, err = called("compare_wall_friction", folder / "nowhere", "--case", "flat_plate")
    assert code == 2 and "nowhere" in err, err


def check_pipe_deposition(folder):
    """Soot of which a wall takes as much a length everywhere, in a stream whose temperature falls with the place; then as means of two halves of a time."""
    speed, density, start, taken, comes = 20.0, 0.5, 0.2, 1e-6, 4e-6
    deck = {"mesh": {"geometry": "axisymmetric", "r": [{"to": 0.05}]}, "particles": {"density": 1800},
            "boundaries": {"cold": {"side": "r-max", "from": start, "temperature": 300}},
            "transport": {"sutherland": {"viscosity": 1.68e-5, "temperature": 273, "constant": 110.5, "prandtl_number": 0.71}}}
    for name, mean in (("steady", ""), ("means", "_mean")):
        z = np.linspace(0, 1.2, 61)
        run = write_run(folder / name, np.linspace(0, 0.05, 6), z, lambda r, z: 900 - 400 * z, deck)
        with h5py.File(run / "results.h5", "r+") as file:
            centres, step = file["mesh/cellCentre"][()], file["steps/000003"]
            flows = comes - taken * np.maximum(centres[:, 1] - start, 0)
            step["velocity"] = np.stack([0 * flows, 0 * flows + speed, 0 * flows], axis=1)
            step["density"] = np.full(len(flows), density)
            step["soot_volume_fraction" + mean] = flows / (1800 * speed * 0.05**2 / 2)
            table, places = file.create_group("deposits/cold"), (z[10:-1] + z[11:]) / 2
            area, times = 0.05 * np.diff(z[10:]), np.array([0.0, 1.0, 2.0, 3.0])
            # What was there before the first mean counts no more than a rate of any step does there.
            mass = np.array([0, 7, 8 - 0.1, 9]) if mean else 0 * times
            for column, values in (("step", np.repeat(np.arange(4), 50)), ("time", np.repeat(times, 50)), ("z", np.tile(places, 4)),
                                   ("area", np.tile(area, 4)), ("deposition", np.full(200, 0.0 if mean else taken / 0.05)),
                                   ("deposited", np.repeat(mass * taken / 0.05, 50))):
                table[column] = values
        code, told, err = called("compare_pipe_deposition", run, "--at", 2, 8, "--json", "--picture", folder / "pipe.png")
        assert code == 0 and (folder / "pipe.png").stat().st_size > 1000, err
        found = json.loads(told)[name]
        assert abs(found["soot"] / comes - 1) < 1e-9 and found["unlike"] < 1e-9 and abs(found["exponent"] - 0.71 * 0.75 / (1 + np.pi / 8)) < 1e-12, found
        for row in found["at"]:
            behind = row["diameters"] * 0.1
            assert abs(row["share"] - taken * behind / comes) < 1e-9 and abs(row["temperature"] - (820 - 400 * behind)) < 1e-6, row
            assert abs(row["run"] - (1 - ((820 - 400 * behind) / 820) ** found["exponent"])) < 1e-5 and 0 < row["law"] < row["run"], row
            assert abs(row["half"] - (0.1 * row["share"] if mean else 0)) < 1e-9, row
    # Dittus and Boelter's heat transfer is within a tenth of Gnielinski's: St 0.023 Re^-0.2 Pr^-0.6.
    viscosity = 1.68e-5 * (780 / 273) ** 1.5 * 383.5 / 890.5
    left = np.exp(-4 * 2 * 0.023 * (density * speed * 0.1 / viscosity) ** -0.2 * 0.71**-0.6)
    row = found["at"][0]
    assert abs((1 - row["law"]) ** (1 / found["exponent"]) * 820 - 300 - 520 * left) < 0.1 * 520 * (1 - left), row
    code, _, err = called("compare_pipe_deposition", folder / "nowhere")
    assert code == 2 and "nowhere" in err, err


def check_round_jet(folder):
    """A jet that spreads by 0.1 from 4 diameters behind the orifice, whose axis decays by 5."""
    diameter, speed = 0.02, 30.0
    more = {"mesh": {"geometry": "axisymmetric"}, "turbulence": {"model": "sst"},
            "boundaries": {"jet": {"velocity": speed, "to": diameter / 2}}}
    run = write_run(folder / "jet", np.linspace(0, 0.3, 301), np.linspace(0, 1.2, 121), lambda r, z: 300 + 0 * r, more)
    with h5py.File(run / "results.h5", "r+") as file:
        r, z = file["mesh/cellCentre"][:, 0], file["mesh/cellCentre"][:, 1]
        far = np.maximum(z - 4 * diameter, diameter)
        file["steps/000003/velocity"] = np.stack([0 * r, 5 * speed * diameter / far * np.exp2(-((r / (0.1 * far)) ** 2)), 0 * r], axis=1)
    code, told, err = called("compare_round_jet", run, "--json", "--picture", folder / "jet.png")
    assert code == 0 and (folder / "jet.png").stat().st_size > 1000, err
    (found,) = json.loads(told)
    assert abs(found["decay"] - 5) < 0.01 and abs(found["origin"] - 4) < 0.05 and abs(found["spread"] - 0.1) < 5e-4, found
    assert found["model"] == "sst" and found["cells"] == 36000, found
    code, _, err = called("compare_round_jet", run, "--from", 70, "--to", 90)
    assert code == 2 and "no jet of three cells" in err, err


def check_sandia_d(folder):
    """Fuel and air in proportion, the fuel's share falling along the axis."""
    more = {"mesh": {"geometry": "axisymmetric"}, "combustion": {"model": "edc"}}
    share = lambda z: np.exp(-z / 0.3)
    run = write_run(folder / "flame", np.linspace(0, 0.02, 21), np.linspace(0, 0.6, 121), lambda r, z: 300 + 1000 * z, more)
    with h5py.File(run / "results.h5", "r+") as file:
        z = file["mesh/cellCentre"][:, 1]
        fuel = {"CH4": 0.25, "O2": 0.1575, "N2": 0.5925, "CO": 0.0}
        air = {"CH4": 0.0, "O2": 0.21, "N2": 0.79, "CO": 0.0}
        weigh = lambda of: sum(x * {"CH4": 16.043, "O2": 31.998, "N2": 28.014, "CO": 28.010}[s] for s, x in of.items())
        moles = {s: share(z) * fuel[s] / weigh(fuel) + (1 - share(z)) * air[s] / weigh(air) for s in fuel}
        for s, n in moles.items():
            file[f"steps/000003/X_{s}"] = n / sum(moles.values())
        file["steps/000003/velocity"] = np.stack([0 * z, 63 - 50 * z, 0 * z], axis=1)
    code, told, err = called("compare_sandia_d", run, "--json", "--picture", folder / "flame.png")
    assert code == 0 and (folder / "flame.png").stat().st_size > 1000, err
    for row in json.loads(told):
        at = row["x/D"] * 7.2e-3
        assert row["model"] == "edc" and abs(row["Z"] - share(at)) < 2e-4 and row["CO"] == 0, row
        assert abs(row["T"] - 300 - 1000 * at) < 1e-6 and abs(row["u"] - 63 + 50 * at) < 1e-6, row
    assert row["x/D"] == 60 and row["measured"]["T"] == 1543, row
    # A fifth of carbon monoxide, a tenth of hydrogen, air's nitrogen: 2 n_C + n_H/2 by hand, of the fuel 1 a mole.
    with h5py.File(run / "results.h5", "r+") as file:
        for s, x in {"CH4": 0.0, "O2": 0.0, "CO": 0.2, "H2": 0.1, "N2": 0.7}.items():
            if s != "H2":
                del file[f"steps/000003/X_{s}"]
            file[f"steps/000003/X_{s}"] = 0 * z + x
    code, told, err = called("compare_sandia_d", run, "--json")
    weight = 0.2 * 28.010 + 0.1 * 2.016 + 0.7 * 28.014
    for row in json.loads(told):
        assert abs(row["Z"] - (2 * 0.2 + 0.5 * 0.2) / weight * weigh(fuel)) < 2e-4 and abs(row["CO"] - 0.2 * 28.010 / weight) < 1e-5, row
    code, _, err = called("compare_sandia_d", folder / "nowhere")
    assert code == 2 and "nowhere" in err, err


with tempfile.TemporaryDirectory() as scratch:
    check_sandia_d(pathlib.Path(scratch))
    check_turbulent_step(pathlib.Path(scratch))
    check_wall_friction(pathlib.Path(scratch))
    check_round_jet(pathlib.Path(scratch))
    check_pipe_deposition(pathlib.Path(scratch))
    check_santoro(pathlib.Path(scratch))
    check_mesh(pathlib.Path(scratch))
    check_comparison(pathlib.Path(scratch))
