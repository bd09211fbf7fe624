"""Repeats of a reactor with stochastic particles: the same files to the last bit on any number of ranks; intervals, distributions
and classes that fit each other; classes that are refused.

Usage: reactor_repeats_test.py EXECUTABLE MPIEXEC...
"""

import csv
import json
import pathlib
import sys
import tempfile

import running

h5py, np = running.package("h5py"), running.package("numpy")

DECK = running.SOURCE / "cases/reactor/silica_batch/deck.yaml"
SHORT = ("time.end=40 ms", "output.interval=10 ms", "particles.number=64", "particles.repeats=5", "particles.bins=24",
         "particles.tables_at=[20 ms]", "particles.classes={collision_diameter: [0.8 nm, 1.2 nm, 900 nm], primaries: [2]}")
WRONG = (("particles.classes.collision_diameter=[2 nm, 1 nm]", "particles.classes.collision_diameter", "numbers that rise"),
         ("particles.classes.primaries=[2, 2]", "particles.classes.primaries", "numbers that rise"),
         ("particles.classes.primaries=[0]", "particles.classes.primaries", "above"))
STUDENT = {0.95: 2.776, 0.999: 8.610}  # four degrees of freedom


def compute(executable, mpiexec, ranks, out):
    result = running.Program(executable, mpiexec, ranks)("run", DECK, "--out", out, *running.settings(*SHORT), timeout=200)
    assert result.code == 0, f"{ranks} ranks: {result.err}"
    assert " coupling steps of gas and particles, " in result.out and "0 of " in result.out, result.out
    return out


def contents(out):
    found = {}
    with h5py.File(out / "results.h5", "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
    for path in sorted(out.glob("*.csv")):
        found[path.name] = path.read_bytes()
    results = json.loads((out / "run.json").read_text(encoding="utf-8"))["results"]
    found["results"] = json.dumps(results)
    return found


def table(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name.split(" [")[0]: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def check_intervals(history):
    number, error = history["silica_number_density"], history["silica_number_density_error"]
    assert np.all(error[1:] > 0) and np.all(number[1:] > 0)
    for name, within in (("ci95", 0.95), ("ci999", 0.999)):
        half = history[f"silica_number_density_{name}"]
        assert np.allclose(half, STUDENT[within] * error, rtol=2e-3), (name, half / error)


def check_distributions(out, history):
    sizes, shares = table(out / "size_distributions.csv"), table(out / "share_distributions.csv")
    width = np.log10(sizes["to"] / sizes["from"])
    number = history["silica_number_density"][-1]
    for name in ("size_distribution", "sphere_size_distribution", "mobility_size_distribution"):
        assert abs((sizes[name] * width).sum() / number - 1) < 1e-12, name
    assert abs((sizes["primary_size_distribution"] * width).sum() / number - history["silica_primaries"][-1]) < 0.05
    for name, mean in (("sintering_level_distribution", "silica_sintering_level"), ("Si_to_O_distribution", "silica_Si_to_O")):
        weight = shares[name] * (shares["to"] - shares["from"])
        assert abs(weight.sum() / number - 1) < 1e-12, name
        middle = 0.5 * (shares["from"] + shares["to"])
        assert abs((weight * middle).sum() / number - history[mean][-1]) < 0.02, name


def check_classes(out, history):
    for name, classes in (("collision_diameter", 4), ("primaries", 2)):
        rows = table(out / f"classes_{name}.csv")
        assert len(rows["time"]) == classes * len(history["time"]), name
        last = slice(-classes, None)
        assert rows["from"][last][0] == 0 and np.isinf(rows["to"][last][-1]), name
        fraction = rows["fraction"][last]
        assert abs(fraction.sum() - 1) < 1e-12, (name, fraction)
        assert np.all(np.isnan(rows["sintering_level"][last][fraction == 0])), name
        mean = np.nansum(fraction * np.where(fraction > 0, rows["collision_diameter"][last], 0))
        # Pooled over all particles, the history's is a mean of means: they differ by the scatter of the repeats.
        scatter = 3 * history["silica_collision_diameter_error"][-1]
        assert abs(mean - history["silica_collision_diameter"][-1]) < scatter < 0.4 * mean, (name, mean, scatter)
    # No particle is larger than 900 nm; the others are between the ends of their class.
    rows = table(out / "classes_collision_diameter.csv")
    there = rows["fraction"] > 0
    assert not np.any(there & (rows["from"] > 1e-9 * 800)) and np.sum(there) > 4
    assert np.all(rows["collision_diameter"][there] >= rows["from"][there]) and np.all(rows["collision_diameter"][there] < rows["to"][there])


def check_events(history):
    """Jumps of a sample and by volume, and the rates that they follow."""
    for name in ("inception", "coagulation", "surface_reaction", "condensation"):
        events = history[f"silica_{name}_events"]
        assert np.all(np.diff(events) >= 0) and events[0] == 0 and events[-1] > 0, name
    # From 20 to 40 ms they change slowly.
    time, rate = history["time"], history["silica_coagulation_rate"]
    step = np.diff(history["silica_coagulations"])[2:] / np.diff(time)[2:]
    middle = np.sqrt(rate[2:-1] * rate[3:])
    assert np.all(np.abs(step / middle - 1) < 0.5), step / middle


def check_starved(executable, mpiexec, folder):
    """A sample that begins far too small for what is born is told of, and one that has room is not."""
    program = running.Program(executable, mpiexec, 1)
    for expected_number, told in (("1e20 1/m^3", True), ("1e18 1/m^3", False)):
        out = folder / f"full_{told}"
        result = program("run", DECK, "--out", out, *running.settings(
            "time.end=40 ms", "output.interval=10 ms", "particles.number=64", "particles.repeats=2", f"particles.expected_number={expected_number}"), timeout=100)
        assert result.code == 0, result.err
        assert ("2 samples were never three quarters full" in result.out) == told, result.out
        assert ("choose 'particles.expected_number' near the largest number density" in result.out) == told, result.out
        counts = json.loads((out / "run.json").read_text(encoding="utf-8"))["results"]["counts"]
        assert counts["samples_never_full"] == (2 if told else 0) and counts["collision_pairs_above_majorant"] == 0, counts


def main(executable, *mpiexec):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = compute(executable, list(mpiexec), 1, folder / "1")
        expected = contents(out)
        found = contents(compute(executable, list(mpiexec), 3, folder / "3"))
        different = [key for key in expected.keys() | found.keys() if expected.get(key) != found.get(key)]
        assert not different, f"3 ranks: other bits in {different}"
        history = table(out / "history.csv")
        check_intervals(history)
        check_distributions(out, history)
        check_classes(out, history)
        check_events(history)
        check_starved(executable, list(mpiexec), folder)
        for setting, *words in WRONG:
            result = running.Program(executable, list(mpiexec), 1)("check", DECK, "--set", setting)
            assert result.code == 2 and all(word in result.err for word in words), f"{setting}: {result.code} {result.err}"


main(sys.argv[1], *sys.argv[2:])
