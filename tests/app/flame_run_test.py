"""One-dimensional flames as users run them: results, restart, failure, the same bits on any number of ranks.

Usage: flame_run_test.py EXECUTABLE RANKS MPIEXEC...
"""

import csv
import json
import pathlib
import re
import sys
import tempfile

import running
import small_decks

h5py = running.package("h5py")
np = running.package("numpy")

DECK = f"""problem: flame1d
title: test
mechanism: {running.SOURCE}/cases/mechanisms/hydrogen_h2o2_10.yaml
flame: {{type: free, length: 20 mm}}
inlet: {{temperature: 298 K, fuel: "H2: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 1}}
grid: {{slope: 0.2, curve: 0.3}}
"""


COUNTERFLOW = f"""problem: flame1d
mechanism: {running.SOURCE}/cases/mechanisms/hydrogen_h2o2_10.yaml
flame: {{type: counterflow, length: 10 mm}}
left: {{temperature: 300 K, composition: "H2: 0.25, N2: 0.75", velocity: 1 m/s}}
right: {{temperature: 300 K, composition: "O2: 0.21, N2: 0.79", velocity: 1 m/s}}
grid: {{slope: 0.3, curve: 0.5}}
"""


def unknowns(folder, name="results.h5"):
    with h5py.File(folder / name, "r") as file:
        return file["flame/restart/unknowns"][()]


def check_results(folder):
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    results = record["results"]
    assert record["status"] == "done" and results["converged"]
    with h5py.File(folder / "results.h5", "r") as file:
        flame = file["flame"]
        z, u, rho = flame["z"][()], flame["velocity"][()], flame["density"][()]
        assert np.all(np.diff(z) > 0) and len(z) == results["points"]
        # Without spreading the mass flux is the same everywhere, and that of the speed.
        assert np.allclose(rho * u, rho[0] * results["flame_speed_m_per_s"], rtol=1e-6), "mass flux"
        X, Y = (sum(flame[kind][name][()] for name in flame[kind]) for kind in "XY")
        assert np.allclose(X, 1, atol=1e-9) and np.allclose(Y, 1, atol=1e-9), "fractions"
        assert flame.attrs["maximum_temperature"] == flame["temperature"][()].max()
        assert [name.decode() for name in file["budgets/name"]][0] == "mass"
        assert np.all(np.abs(file["budgets/relative_imbalance"][()]) < 1e-8), "budgets"
        assert len(file["stages/name"]) == len(file["stages/points"]) > 1
    head, first = (folder / "profile.csv").read_text(encoding="utf-8").splitlines()[:2]
    assert head.startswith("z [m],temperature [K],velocity [m/s]") and head.count(",") == first.count(",")
    return results


def check_followed(program, folder):
    """A branch that ends behind extinction, and a flame in an oscillating strain."""
    deck = folder / "counterflow.yaml"
    deck.write_text(COUNTERFLOW, encoding="utf-8")
    result = program("run", deck, "--out", folder / "branch", *running.settings("continuation.turning_points=1"))
    assert result.code == 0, result.err
    numbers = json.loads((folder / "branch/run.json").read_text(encoding="utf-8"))["results"]
    with h5py.File(folder / "branch/results.h5", "r") as file:
        branch = file["continuation"]
        load, temperature = branch["load"][()], branch["maximum_temperature"][()]
        assert load[0] == 1 and np.all(np.diff(temperature) < 0), "the flame gets colder along the branch"
        highest = int(np.argmax(load))
        assert 0 < highest < len(load) - 1 and load[-1] < load[highest], "the branch turns"
        # The extremum of a parabola through three points is at least as high as each of them.
        assert load[highest] <= numbers["extinction_load"] < 1.05 * load[highest]
        assert np.isclose(branch["strain_rate"][0], file["flame"].attrs["strain_global"])
    assert len((folder / "branch/branch.csv").read_text(encoding="utf-8").splitlines()) == len(load) + 1

    result = program("run", deck, "--out", folder / "time", *running.settings(
        "unsteady.end=8 ms", "unsteady.output_interval=2 ms", "unsteady.amplitude=0.2", "unsteady.frequency=125 1/s"))
    assert result.code == 0, result.err
    with h5py.File(folder / "time/results.h5", "r") as file:
        time, history = file["unsteady/time"][()], file["history"]
        assert np.allclose(time, [0, 2e-3, 4e-3, 6e-3, 8e-3])
        # Interpolated between steps whose error is kept to 0.1 %.
        assert np.allclose(history["load"][()], 1 + 0.2 * np.sin(2 * np.pi * 125 * time), atol=1e-3)
        # Peak temperature falls with strain: lower at its largest, higher at its smallest than at the start.
        hottest = history["maximum_temperature"][()]
        assert hottest[1] < hottest[0] < hottest[3], hottest
        assert file["unsteady/temperature"].shape == (5, len(file["unsteady/z"]))
        assert np.array_equal(file["unsteady/temperature"][-1], file["flame/temperature"][()])


def check_sensitivities(program, folder):
    """Of the speed of a free flame: the same in the table, the results and, the largest of them, in the report."""
    deck = folder / "free.yaml"
    deck.write_text(small_decks.free_flame("hydrogen_h2o2_10.yaml", "H2", 0.1, 0.2) + "sensitivity: {of: flame_speed}\n", encoding="utf-8")
    result = program("run", deck, "--out", folder / "all")
    assert result.code == 0, result
    with (folder / "all/sensitivities.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["reaction", "equation", "flame_speed [1]"], rows[0]
    with h5py.File(folder / "all/results.h5", "r") as file:
        values = file["sensitivity/flame_speed"][()]
        assert np.array_equal(file["sensitivity/reaction"][()], np.arange(1, len(values) + 1))
    assert len(rows) == len(values) + 1 and [float(row[2]) for row in rows[1:]] == list(values)
    assert abs(np.sum(values) - 0.5) < 0.01, np.sum(values)
    # With a domain and a grid of this size; hydrogen is made faster most by its branching.
    largest = int(np.argmax(values))
    equation = rows[1 + largest][1]
    assert f"{largest + 1}  {equation}" in result.out and "all together (0.5 but for the grid)" in result.out, result.out
    result = program("run", deck, "--out", folder / "some", *running.settings("sensitivity.reactions=[H + O2 <=> O + OH]"))
    assert result.code == 0, result
    with h5py.File(folder / "some/results.h5", "r") as file:
        number = int(file["sensitivity/reaction"][0])
        assert rows[number][1] == "H + O2 <=> O + OH" and np.isclose(file["sensitivity/flame_speed"][0], values[number - 1], rtol=1e-6)
    for pair, message in (("sensitivity.reactions=[H <=> H]", "no reaction 'H <=> H'"), ("flame.type=burner", "sensitivity")):
        result = program("check", deck, *running.settings(pair))
        assert result.code == 2 and message in result.err, result.err


def check_given_temperature_at_a_wall(program, folder):
    """A burner-stabilised stagnation flame: its temperature is the profile's, the wall's too."""
    deck = folder / "stagnation.yaml"
    deck.write_text(f"""problem: flame1d
mechanism: {running.SOURCE}/cases/mechanisms/hydrogen_h2o2_10.yaml
flame: {{type: wall, length: 8 mm, energy: given}}
inlet: {{temperature: 350 K, composition: "H2: 0.2, O2: 0.2, AR: 0.6", velocity: 40 cm/s}}
temperature_profile: {{position: [0 mm, 1 mm, 2 mm, 6 mm, 8 mm], temperature: [350 K, 1100 K, 1500 K, 1400 K, 500 K]}}
grid: {{slope: 0.15, curve: 0.25}}
""", encoding="utf-8")
    result = program("run", deck, "--out", folder / "stagnation")
    assert result.code == 0, result
    with h5py.File(folder / "stagnation/results.h5", "r") as file:
        z, temperature, velocity = (file[f"flame/{name}"][()] for name in ("z", "temperature", "velocity"))
        assert np.allclose(temperature, np.interp(z, [0, 1e-3, 2e-3, 6e-3, 8e-3], [350, 1100, 1500, 1400, 500]), rtol=1e-6)
        # What diffuses towards the nozzle makes the gas there a little heavier than the stream.
        assert abs(velocity[-1]) < 1e-9 and np.isclose(velocity[0], 0.4, rtol=0.03), velocity
        # It burns: no hydrogen is left at the wall.
        assert file["flame/X/H2"][-1] < 0.02 and file["flame"].attrs["flame_state"].decode() == "burning"
    result = program("check", deck, *running.settings("flame.wall_temperature=510 K"))
    assert result.code == 2 and "the wall is 510 K, the profile 500 K there" in result.err, result.err


def check_states(program, folder):
    """Whether a flame burns is in the record, the results, the report and the table of a study."""
    deck = folder / "counterflow.yaml"
    deck.write_text(COUNTERFLOW, encoding="utf-8")
    study = folder / "study.yaml"
    study.write_text("""study: states
deck: counterflow.yaml
variants:
  - {name: slow, set: [left.velocity=1 m/s]}
  - {name: fast, set: [left.velocity=100 m/s, right.velocity=100 m/s]}
collect: {results: [maximum_temperature_K]}
""", encoding="utf-8")
    result = program("sweep", study, "--out", folder / "states")
    assert result.code == 0, result.err
    with (folder / "states/study.csv").open(encoding="utf-8", newline="") as file:
        table = {row["run"]: row for row in csv.DictReader(file)}
    slow, fast = table["counterflow_slow"], table["counterflow_fast"]
    assert slow["flame_state"] == "burning" and float(slow["maximum_temperature_K"]) > 1400, slow
    assert fast["status"] == "done" and fast["flame_state"] == "out", fast
    numbers = json.loads((folder / "states/counterflow_fast/run.json").read_text(encoding="utf-8"))["results"]
    assert numbers["flame_state"] == "out" and 0.01 < numbers["last_burning_load"] < 1, numbers
    with h5py.File(folder / "states/counterflow_fast/results.h5", "r") as file:
        assert file["flame"].attrs["flame_state"].decode() == "out"
        assert file["flame"].attrs["last_burning_load"] == numbers["last_burning_load"]


def check_failures_on_the_way(program, folder):
    """A branch that needs more points than allowed, time steps that cannot be exact enough: told once, and what there was
    is kept."""
    deck = folder / "counterflow.yaml"
    deck.write_text(COUNTERFLOW, encoding="utf-8")

    def failed(name, message, *pairs):
        result = program("run", deck, "--out", folder / name, *running.settings(*pairs))
        assert result.code == 3, f"{name}: exit code {result.code}\n{result.err}"
        assert re.match(f"lampblack: numerics: {message}", result.err) and result.err.count("lampblack: ") == 1, result.err
        assert "MPI_ABORT" not in result.err, result.err
        return h5py.File(folder / name / "results.h5.part", "r")

    with failed("long branch", "the branch of flames ends early: grid: its criteria", "continuation.turning_points=1",
                "grid.maximum_points=50") as file:
        assert len(file["continuation/load"]) > 3 and not file["continuation"].attrs["complete"]
    with failed("exact time", "time steps became shorter than", "unsteady.end=1 ms", "unsteady.accuracy=1e-12") as file:
        assert file["unsteady/time"][()] == [0]


def main(executable, ranks, *mpiexec):
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "deck.yaml"
        deck.write_text(DECK, encoding="utf-8")

        def run(out, *settings, code=0):
            result = program("run", deck, "--out", folder / out, *running.settings(*settings))
            assert result.code == code, f"{out}: exit code {result.code}\n{result.out}{result.err}"
            return result

        run("whole")
        results = check_results(folder / "whole")
        # H2/air burns at 2 to 3 m/s, to 2300 to 2450 K; the numbers themselves are compared elsewhere.
        assert 2 < results["flame_speed_m_per_s"] < 3 and 2300 < results["maximum_temperature_K"] < 2450, results

        # From its own results nothing is left to do: a Newton step or two to see that, on the same grid.
        run("again", f"initial={folder}/whole/results.h5")
        again = check_results(folder / "again")
        assert again["points"] == results["points"] and again["newton_steps"] <= 4 and again["time_steps"] == 0, again
        assert abs(again["flame_speed_m_per_s"] / results["flame_speed_m_per_s"] - 1) < 1e-6

        # A failure leaves what it had, and that is enough to go on from.
        failed = run("failed", "grid.maximum_points=45", code=3)
        lines = failed.err.splitlines()
        assert re.match(r"lampblack: numerics: the flame did not converge in the stage 'flame.*' \(\d+ points\): .* the "
                        r"residual is largest in ", lines[0]), failed.err
        assert failed.err.count("lampblack: ") == 1 and "results.h5.part" in failed.err, failed.err
        assert "MPI_ABORT" not in failed.err
        assert json.loads((folder / "failed/run.json").read_text(encoding="utf-8"))["status"] == "failed"
        assert not (folder / "failed/results.h5").exists()
        # Who names something near the results is told where they are.
        assert f"{folder}/whole/results.h5" in run("folder", f"initial={folder}/whole", code=2).err
        assert "results.h5.part is there" in run("missing", f"initial={folder}/failed/results.h5", code=2).err
        run("resumed", f"initial={folder}/failed/results.h5.part")
        assert check_results(folder / "resumed")["time_steps"] == 0

        check_failures_on_the_way(program, folder)
        if int(ranks) == 1:
            check_followed(program, folder)
            check_states(program, folder)
            check_sensitivities(program, folder)
            check_given_temperature_at_a_wall(program, folder)

        # Any number of ranks: the same flame to the last bit.
        if int(ranks) > 1:
            single = running.Program(executable, list(mpiexec), 1)
            assert single("run", deck, "--out", folder / "single").code == 0
            assert np.array_equal(unknowns(folder / "single"), unknowns(folder / "whole")), "ranks differ"
    print("ok")
    return 0


sys.exit(main(*sys.argv[1:]))
