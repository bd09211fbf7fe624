"""Population balance decks run from start to end: the same numbers on any number of ranks, readable files, gelation.

Usage: population_run_test.py EXECUTABLE MPIEXEC... Exit code 77 (skipped) where h5py is not installed.
"""

import csv
import json
import pathlib
import sys
import tempfile
import time

import running

h5py = running.package("h5py")
np = running.package("numpy")

# Constant kernel from particles of one size (Smoluchowski 1916): N0 = 1e12 1/m3, A = 1e-12 m3/s, so that tau = t.
DECK = """problem: population_balance
name: smoluchowski
initial: {distribution: monodisperse, number: 1e6 1/cm^3, volume: 1 m^3}
processes:
  coagulation: {kernel: constant, rate: 1e-6 cm^3/s}
methods:
  dsmc: {type: dsmc, particles: 300}
  by_mass: {type: constant_number_mass, particles: 300}
  by_number: {type: constant_number_number, particles: 300}
  sections: {type: sectional, sections: 40, smallest: 1 m^3, spacing: 1.6}
time: {end: 10 s, outputs: 20}
repeats: 25
seed: 7
distribution: {minimum: 0.5 m^3, maximum: 50.5 m^3, bins: 50, spacing: linear, times: [4, 10]}
"""
GELATION = """problem: population_balance
initial: {distribution: monodisperse, number: 1 1/m^3, volume: 1 m^3}
processes:
  coagulation: {kernel: multiplicative, rate: 1 1/m^3/s}
methods:
  dsmc: {type: dsmc, particles: 500}
time: {end: 2 s, outputs: 20}
repeats: 5
"""
# More pieces than the exact solution can count: 2 B(v0) t = 2e8 at the end.
SHATTERED = """problem: population_balance
initial: {distribution: monodisperse, number: 1 1/m^3, volume: 1 m^3}
processes: {breakage: {rate: 1e8 1/s, exponent: 1, reference_volume: 1 m^3}}
methods: {dsmc: {type: dsmc, particles: 16}}
time: {end: 1 s, outputs: 1}
repeats: 1
"""
# Two modes, the second far too wide for equal weights: a tenth of its M2 is in one particle of a million.
MODES = """problem: population_balance
initial:
  - {distribution: lognormal, number: 3200 1/cm^3, diameter: 20 nm, geometric_deviation: 1.45}
  - {distribution: lognormal, number: 2900 1/cm^3, diameter: 116 nm, geometric_deviation: 2.2}
processes: {coagulation: {kernel: constant, rate: 1e-15 m^3/s}}
methods: {dsmc: {type: dsmc, particles: 2000}, sammc: {type: sammc, particles: 1000}}
time: {end: 1 s, outputs: 1}
repeats: 5
"""
REPEATS, ROWS, OWN = 25, 21, "/seconds"


def datasets(path: pathlib.Path) -> dict:
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None)
    return found


def run(program: running.Program, deck: str, folder: pathlib.Path, code: int = 0) -> running.Result:
    folder.mkdir()
    (folder / "deck.yaml").write_text(deck, encoding="utf-8")
    result = program("run", folder / "deck.yaml", "--out", folder / "out")
    assert result.code == code, f"{program.ranks} ranks: exit code {result.code}\n{result.err}"
    return result


def check_numbers(data: dict) -> None:
    """What the tables say of themselves, and Smoluchowski's solution."""
    t = data["exact/history/time"]
    assert np.array_equal(t, np.linspace(0, 10, ROWS))
    exact = {k: data[f"exact/history/M{k}"] for k in range(4)}
    for k, formula in enumerate((2 / (2 + t), 1 + 0 * t, 1 + t, 1 + 3 * t + 1.5 * t**2)):
        assert np.allclose(exact[k], 1e12 * formula, rtol=1e-13), f"exact M{k}"
    sizes = np.arange(1, 51)
    for row, time in enumerate((4, 10)):
        formula = 1e12 * (time / 2) ** (sizes - 1) / (1 + time / 2) ** (sizes + 1)
        assert np.allclose(data["exact/distribution/number"][row], formula, rtol=1e-12), "exact distribution"
    for name in ("dsmc", "by_mass", "by_number"):
        repeats = {column: data[f"methods/{name}/repeats/{column}"] for column in
                   [f"M{k}" for k in range(4)] + [f"sigma_M{k}" for k in range(4)] + ["coagulations", "mass_error"]}
        history = {column: data[f"methods/{name}/history/{column}"] for column in
                   [f"M{k}" for k in range(4)] + [f"M{k}_error" for k in range(4)]}
        for k in range(4):
            values = repeats[f"M{k}"]
            assert len(values) == REPEATS and len(history[f"M{k}"]) == ROWS
            assert np.isclose(history[f"M{k}"][-1], values.mean(), rtol=1e-13)
            error = values.std(ddof=1) / np.sqrt(REPEATS)
            assert np.isclose(history[f"M{k}_error"][-1], error, rtol=1e-9, atol=1e-3), f"{name}: M{k}"
            assert np.isclose(data[f"methods/{name}/sigma/sigma_M{k}"][-1], repeats[f"sigma_M{k}"].mean(), rtol=1e-12)
            # The mean is where it should be; 25 repeats: Student's distribution has 0.1 % beyond 3.75.
            assert abs(values.mean() - exact[k][-1]) <= 3.75 * error + 1e-11 * exact[k][-1], f"{name}: M{k}"
        assert len(set(repeats["M0"])) > 5 and np.all(repeats["coagulations"] > 100), "repeats are all alike"
        if name != "by_number":
            assert repeats["mass_error"].max() < 1e-11, f"{name}: M1 is not conserved"
    numbers = data["methods/dsmc/distribution/number"]
    assert numbers.shape == (2, 50)
    away = (numbers - data["exact/distribution/number"])[:, :5] / data["methods/dsmc/distribution/number_error"][:, :5]
    assert np.abs(away).max() < 4, "size distribution"
    assert len(data["methods/sections/repeats/M0"]) == 1
    assert np.isnan(data["methods/sections/history/M0_error"]).all()


def main(executable: str, *mpiexec: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        runs, tables = {}, {}
        for ranks in (1, 3):
            program = running.Program(executable, list(mpiexec), ranks)
            out = folder / str(ranks) / "out"
            begin = time.monotonic()
            result = run(program, DECK, folder / str(ranks))
            elapsed = time.monotonic() - begin
            assert not result.err, f"a good run complains:\n{result.err}"
            runs[ranks] = datasets(out / "results.h5")
            with open(out / "table.csv", encoding="utf-8") as file:
                tables[ranks] = list(csv.DictReader(file))
            record = json.loads((out / "run.json").read_text(encoding="utf-8"))
            assert record["status"] == "done" and record["ranks"] == ranks and record["seed"] == 7
            spent = [float(row["seconds_per_repeat [s]"]) * float(row["repeats"]) for row in tables[ranks]]
            assert all(0 <= seconds <= elapsed * ranks for seconds in spent), f"{spent} s of the processor in {elapsed} s"
            assert list(record["results"]["methods"]) == ["dsmc", "by_mass", "by_number", "sections"]
            verdicts = {row["method"]: row["verdict"] for row in tables[ranks]}
            assert all(verdicts[method] == "no bias" for method in ("dsmc", "by_mass", "by_number")), verdicts
            assert all(method in result.out for method in verdicts) and "Smoluchowski" not in result.err
        check_numbers(runs[1])
        timed = ("seconds_per_repeat [s]", "events_per_second [1/s]")
        for ranks in (3,):
            assert set(runs[ranks]) == set(runs[1])
            other = [path for path in runs[1] if not path.endswith(OWN) and
                     not np.array_equal(runs[1][path], runs[ranks][path], equal_nan=True)]
            assert not other, f"{ranks} ranks: other numbers than on one in {other}"
            for one, more in zip(tables[1], tables[ranks]):
                assert {k: v for k, v in one.items() if k not in timed} == {k: v for k, v in more.items() if k not in timed}
        empty = {row["method"]: row for row in tables[1]}
        assert empty["dsmc"]["z_M1 [1]"] == "" and empty["dsmc"]["z_M0 [1]"] != "" and empty["sections"]["z_M0 [1]"] == ""

        for ranks in (1, 2):
            program = running.Program(executable, list(mpiexec), ranks)
            gelled = folder / f"gelation{ranks}"
            result = run(program, GELATION, gelled, code=3)
            warning, *messages = [line for line in result.err.splitlines() if line.strip()]
            assert "warning: the population gels at t = 1 s; time.end = 2 s is later" in warning, result.err
            assert len(messages) == 1 and "the population gels at t = " in messages[0], result.err
            assert json.loads((gelled / "out/run.json").read_text(encoding="utf-8"))["status"] == "failed"
            assert not (gelled / "out/results.h5").exists()
            data = datasets(gelled / "out/results.h5.part")
            times = data["methods/dsmc/history/time"]
            assert 3 < len(times) and times[-1] < 1, f"rows up to {times[-1]} s; it gels at 1 s"
            result = program("check", gelled / "deck.yaml")
            assert result.code == 0 and "warning: the population gels at t = 1 s" in result.err, result.err

        result = run(running.Program(executable, list(mpiexec), 1), SHATTERED, folder / "shattered")
        assert result.err.splitlines() == [
            "lampblack: warning: nothing is compared with the exact solution from t = 1 s on: the exact solution of breakage "
            "into equal pieces is for times below 1e7 / (pieces B(v0))"], result.err
        exact = datasets(folder / "shattered/out/results.h5")["exact/history/M0"]
        assert exact[0] == 1 and np.isnan(exact[1]), exact

        result = run(running.Program(executable, list(mpiexec), 2), MODES, folder / "modes")
        before, after = result.err.splitlines()
        assert "warning: methods.dsmc: the 2000 particles that the first repeat starts from miss" in before, result.err
        assert "warning: methods.dsmc: at the start the mean of 5 repeats and its interval do not hold" in after, result.err
        data = datasets(folder / "modes/out/results.h5")
        for k in range(4):
            known = sum(n * (np.pi / 6 * d**3) ** k * np.exp(0.5 * (3 * k * np.log(s)) ** 2)
                        for n, d, s in ((3.2e9, 20e-9, 1.45), (2.9e9, 116e-9, 2.2)))
            found, exact = (data[f"{of}/history/M{k}"][0] for of in ("methods/sammc", "exact"))
            assert abs(exact / known - 1) < 1e-12 and abs(found / known - 1) < 1e-3, (k, found, exact, known)
        assert data["methods/dsmc/history/M3"][0] < 0.6 * known
    print("the same numbers on 1 and 3 ranks; gelation stops with its time")


main(*sys.argv[1:])
