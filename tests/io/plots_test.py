"""Makes a results folder that looks like a small flame, and has scripts/plot and scripts/compare_centreline work on it.

Exit code 77 (skipped) where a Python package is missing.
"""

import json
import pathlib
import sys
import tempfile

try:
    import h5py
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; scripts/setup installs it")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/app"))
import running  # noqa: E402

NR, NZ = 20, 40
FLAME = 4.53e-3  # m, between the samples so that the peak has to be interpolated


def write(group, name, values, unit="1"):
    # Texts of fixed length, as the program writes them.
    group.create_dataset(name, data=values).attrs["unit"] = np.bytes_(unit)


def synthetic_results(folder, with_fields=True):
    r, z = np.linspace(0, 10e-3, NR + 1), np.linspace(0, 8e-3, NZ + 1)
    vertices = np.array([(x, y, 0.0) for y in z for x in r])
    corner = [(j * (NR + 1) + i) for j in range(NZ) for i in range(NR)]
    cells = np.array([(v, v + 1, v + NR + 2, v + NR + 1) for v in corner])
    centres = vertices[cells].mean(axis=1)
    x, y = centres[:, 0], centres[:, 1]
    bell = 1.0 - ((y - FLAME) / 4e-3) ** 2  # a parabola: the interpolated peak is exact
    folder.mkdir(parents=True)
    with h5py.File(folder / "results.h5", "w") as file:
        mesh = file.create_group("mesh")
        write(mesh, "vertices", vertices, "m")
        write(mesh, "cells", cells)
        write(mesh, "cellCentre", centres, "m")
        step = file.create_group("steps/000010")
        step.attrs["time"], step.attrs["step"] = 0.04, 10
        if not with_fields:
            return centres
        write(step, "temperature", 300 + 2000 * bell, "K")
        write(step, "velocity", np.stack([20 * x, 0.2 - 50 * y, 0 * x], axis=1), "m/s")
        write(step, "X_C2H2", 0.08 * bell)
        write(step, "X_A1", 4e-4 * bell)
        write(step, "X_C10H8", 1.6e-4 * bell)
        write(step, "soot_volume_fraction", 3e-7 * np.maximum(bell, 0) ** 4)
        path = file.create_group("trajectories/0")
        times = np.linspace(0, 0.02, 9)
        edges = np.geomspace(1e-9, 1e-7, 25)
        middle = np.sqrt(edges[1:] * edges[:-1])
        mean = 2e-9 + 1e-6 * times
        write(path, "time", times, "s")
        write(path, "temperature", 1500 + 0 * times, "K")
        write(path, "soot_mean_diameter", mean, "m")
        write(path, "bin_edges", edges, "m")
        write(path, "size_distribution", 1e15 * np.exp(-(np.log(middle / mean[:, None]) ** 2)), "1/m^3")
        history = file.create_group("history")
        write(history, "time", times, "s")
        write(history, "dt", 1e-5 + 0 * times, "s")
        write(history, "mass_error", 1e-12 * (1 + times))
    return centres


def run(*command):
    result = running.script(*command)
    print(result.out + result.err)
    return result


def test_pictures_are_made_and_missing_fields_named(work):
    synthetic_results(work / "run")
    result = run(ROOT / "scripts" / "plot", work / "run")
    assert result.code == 0
    names = {p.stem for p in (work / "run" / "pictures").glob("*.png")}
    assert names == {"flame", "temperature", "C2H2", "A2", "soot_volume_fraction", "velocity", "centreline",
                     "size_distributions", "history"}, names
    assert "not drawn - centreline profile of X_OH: the results hold no such field" in result.out


def test_fields_are_drawn_by_name(work):
    synthetic_results(work / "run")
    with h5py.File(work / "run/results.h5", "a") as file:
        step = file["steps/000010"]
        for name in [name for name in step if name.startswith("X_")]:
            del step[name]
        write(step, "X_H2", np.full(NR * NZ, 0.6))
        write(step, "X_CH2(S),S", np.full(NR * NZ, 0.4))
        write(step, "heat_release", np.linspace(-1e6, 1e9, NR * NZ), "W/m^3")
        write(file, "species/name", np.array([b"H2", b"CH2(S),S"]))
        write(file, "species/molar_mass", np.array([2e-3, 14e-3]), "kg/mol")
    result = run(ROOT / "scripts/plot", work / "run", "--fields", "heat_release", "X_CH2(S),S", "Y_H2,temperature")
    assert result.code == 0
    names = {p.stem for p in (work / "run/pictures").glob("*.png")}
    assert names == {"heat_release", "X_CH2_S__S", "Y_H2", "temperature"}, names
    result = run(ROOT / "scripts/plot", work / "run", "--fields", "heat")
    assert result.code == 2 and "there is no field 'heat'" in result.err and "heat_release" in result.err

    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.results import Results

    fraction = Results(work / "run").field("Y_H2")
    assert np.allclose(fraction, 0.6 * 2 / (0.6 * 2 + 0.4 * 14), rtol=1e-14) and fraction.unit == "1"
    with h5py.File(work / "run/results.h5", "a") as file:
        del file["steps/000010/X_H2"]
    assert Results(work / "run").field("Y_CH2(S),S") is None
    assert "output.species: [all]" in run(ROOT / "scripts/plot", work / "run", "--fields", "Y_H2").err


def test_units_are_read_as_text(work):
    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.results import Results, unit_of

    synthetic_results(work / "run")
    results = Results(work / "run")
    assert unit_of(results.fields("000010")["temperature"]) == "K"
    assert results.history()["dt"].unit == "s"


def test_empty_results_are_said_to_be_empty(work):
    synthetic_results(work / "bare", with_fields=False)
    result = run(ROOT / "scripts" / "plot", work / "bare")
    assert result.code == 2
    assert "nothing to draw" in result.err
    assert run(ROOT / "scripts" / "plot", work).code == 2


def test_reference_is_found_beside_the_deck_and_compared(work):
    synthetic_results(work / "flame")
    case = work / "case"
    (case / "reference").mkdir(parents=True)
    z = np.linspace(0, 8e-3, 33)
    bell = 1.0 - ((z - 4.5e-3) / 4e-3) ** 2
    rows = ["z_m,u_m_s,T_K,X_C2H2"] + [f"{a},{0.2 - 50 * a},{300 + 2000 * b},{0.1 * b}" for a, b in zip(z, bell)]
    reference = case / "reference" / "cantera.csv"
    reference.write_text("\n".join(rows) + "\n", encoding="utf-8")
    (work / "flame" / "run.json").write_text(json.dumps({"deck_path": str(case / "deck.yaml")}), encoding="utf-8")

    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.plots.profiles import plot_profiles
    from lampblack.reference import find_references
    from lampblack.results import Results
    from lampblack.plots.style import Pictures

    results, pictures = Results(work / "flame"), Pictures(work / "pictures")
    assert find_references(results) == [reference]
    plot_profiles(results, pictures, [reference])
    assert pictures.made == [work / "pictures" / "centreline.png"]

    result = run(ROOT / "scripts" / "compare_centreline", work / "flame", reference, "--json")
    rows = {row["quantity"]: row for row in json.loads(result.out)}
    assert abs(rows["T, K"]["peak"] - 2300.0) < 1e-6
    assert abs(rows["T, K"]["z_m"] - FLAME) < 1e-9
    assert abs(rows["T, K"]["shift_m"] - 3e-5) < 1e-9
    assert abs(rows["X C2H2"]["deviation"] + 0.2) < 1e-9
    assert "deviation" in run(ROOT / "scripts" / "compare_centreline", work / "flame", reference).out
    assert run(ROOT / "scripts" / "compare_centreline", work / "flame", work / "none.csv").code == 2


def test_series_are_runs_that_differ_in_one_thing(work):
    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.flame_series import series_of

    def a_run(oxygen, velocity):
        flat = {"right.composition": f"O2: {oxygen}, N2: {1 - oxygen}", "left.velocity": velocity, "right.velocity": velocity,
                "title": f"{oxygen} {velocity}"}
        return {"folder": work, "flat": flat, "results": {"strain_global_per_s": 500 * velocity}, "variant": ""}

    runs = [a_run(0.3, 0.2), a_run(0.2, 0.2), a_run(0.25, 0.2), a_run(0.25, 0.3), a_run(0.25, 0.25)]
    found = {series.name: series for series in series_of(runs)}
    assert set(found) == {"O2", "strain"}
    assert np.allclose(found["O2"].values, [0.2, 0.25, 0.3]) and found["O2"].runs == [runs[1], runs[2], runs[0]]
    assert np.allclose(found["strain"].values, [100, 125, 150]) and found["strain"].runs == [runs[2], runs[4], runs[3]]


def test_peaks_and_half_widths_of_known_profiles(work):
    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.plots.flame_peaks import half_widths, is_unimodal, lopsidedness, peak

    z = np.linspace(0, 10, 101)
    height, place = peak(z, np.maximum(0, 5 - (z - 4.03) ** 2))
    assert abs(height - 5) < 1e-9 and abs(place - 4.03) < 1e-9
    triangle = np.where(z < 2, z / 2, np.maximum(0, 1 - (z - 2) / 6))  # half as high at 1 and at 5; the peak is a cusp
    left, right = half_widths(z, triangle)
    assert abs(left - 1) < 0.05 and abs(right - 3) < 0.05  # half a spacing
    assert lopsidedness(z, triangle) == right / left
    assert is_unimodal(triangle) and not is_unimodal(triangle + 0.5 * np.exp(-((z - 7) ** 2)))


def test_reconstructed_aggregates_have_their_necks_and_little_other_overlap(work):
    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.plots.aggregates import TOUCHING, neck_distance, reconstructed, surface_over_sphere

    assert abs(neck_distance(3.0, 3.0, 0.0) - 6.0) < 1e-6 and neck_distance(3.0, 3.0, 0.999) < 1.0
    distance = neck_distance(3.0, 2.0, 0.5)
    assert abs(surface_over_sphere(3.0, 2.0, distance) - 1 / (0.5 * (1 - TOUCHING) + TOUCHING)) < 1e-6

    random, count = np.random.default_rng(3), 40
    diameters = random.uniform(8.0, 12.0, count)
    k = np.arange(count - 1)  # one primary after the other
    necks = {"left": np.array([random.integers(0, i + 1) for i in k]), "right": k + 1, "first": 0 * k, "last": k + 1,
             "level": random.uniform(0.0, 0.3, count - 1)}
    places = reconstructed(diameters, necks, random)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    wanted = neck_distance(diameters[necks["left"]] / 2, diameters[necks["right"]] / 2, necks["level"])
    assert np.allclose(apart[necks["left"], necks["right"]], wanted)
    overlap = 0.5 * (diameters[:, None] + diameters) - apart
    overlap[necks["left"], necks["right"]] = overlap[necks["right"], necks["left"]] = 0.0
    assert np.triu(overlap, 1).max() < 0.5 * diameters.min()
    again = reconstructed(diameters, necks, np.random.default_rng(5))
    assert np.array_equal(again, reconstructed(diameters, necks, np.random.default_rng(5)))


def test_class_means_of_particles_are_those_of_each_class(work):
    sys.path.insert(0, str(ROOT / "python"))
    from lampblack.plots.tree_tables import class_means

    diameter = np.array([1.0] * 6 + [10.0] * 6 + [100.0] * 2) * 1e-9
    particles = {"collision_diameter": diameter, "primaries": np.array([1] * 6 + [2, 4] * 3 + [9, 9]), "primary_diameter": diameter / 2,
                 "sintering_level": np.full(14, 0.5)}
    middles, counts, means = class_means(particles, classes=3)
    assert list(counts) == [6, 6] and np.all(np.diff(middles) > 0)  # two particles are too few
    assert np.allclose(means["primaries"][0], [1, 3]) and np.allclose(means["primaries"][1], [0, 1 / np.sqrt(6)])
    assert np.allclose(means["primary_diameter"][0], [0.5e-9, 5e-9])


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            with tempfile.TemporaryDirectory() as folder:
                test(pathlib.Path(folder))
            print(f"ok  {name}")
