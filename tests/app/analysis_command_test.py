"""`lampblack fit` and its sisters on quick reactors and populations: what they leave, what they refuse, and that they go on.

Usage: analysis_command_test.py EXECUTABLE [--all]
"""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import running

np = running.package("numpy")
running.needs("h5py", "scipy", "matplotlib")
sys.path.insert(0, str(running.SOURCE / "python"))

ALL = "--all" in sys.argv
REACTOR = running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml"
POPULATION = running.SOURCE / "cases/population_balance/chapter5_02_coagulation_monodisperse.yaml"
SHORT = ["time.end=0.2 ms", "output.interval=10 us", "sensitivity.reactions=[1]"]


def heating(**more) -> dict:
    """Hydrogen that ignites: temperature at the start and share of hydrogen, by the temperature over time."""
    return {
        "analysis": "two unknowns of an ignition", "runs": "shared",
        "decks": [{"deck": str(REACTOR), "name": "lean", "set": [*SHORT]}, {"deck": str(REACTOR), "name": "cold", "set": ["pressure=2 atm", *SHORT],
                                                                            "use": "validate"}],
        "parameters": [{"name": "T", "from": 1150, "to": 1350, "set": ["initial.temperature={T} K"]},
                       {"name": "h", "from": 0.4, "to": 1.1, "scale": "log", "set": ["initial.composition='H2: {h*2}, O2: 1, N2: 3.76'"]}],
        "quantities": {"T": {"table": "history.csv", "column": "temperature", "along": "time"},
                       "end": {"result": "final_temperature_K"}},
        "measurements": {"files": ["data.csv"]}, "design": {"points": 8}, "optimise": {"starts": 1, "tolerance": 1e-6, "step": 1e-3}, **more}  # fmt: skip


DATA = "deck,quantity,abscissa [us],value [K],error [K],source\n"


def thinned(*mistakes) -> tuple:
    """Each starts the program and python."""
    return mistakes if ALL else mistakes[::3]


class Analyses:
    """The command in a folder of its own, with files as texts."""

    def __init__(self, executable: str, folder: pathlib.Path):
        self.program, self.folder = running.Process(executable, ["mpirun", "-n"], 1), folder

    def file(self, name: str, content) -> pathlib.Path:
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return path

    def __call__(self, task: str, analysis, *words) -> running.Result:
        return self.program(task, self.file("analysis.yaml", analysis), *words)

    def good(self, task: str, analysis, out: str, *words) -> list:
        result = self(task, analysis, "--out", self.folder / out, *words)
        assert result.code == 0, f"{task}: exit code {result.code}\n{result.err}{result.out}"
        return result.out

    def table(self, name: str) -> list:
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def refused(self, words: str, task: str, analysis, *more) -> None:
        result = self(task, analysis, *(["--out", self.folder / "refused"] if task != "check" else []), *more)
        assert result.code == 2 and words in result.err and "Traceback" not in result.err, f"{words}: {result.code} {result.err}{result.out}"


def measured(run: Analyses, truth: dict) -> str:
    """What a run at the truth has at five times, as it is and at another pressure."""
    text = DATA
    for name, pressure in (("lean", "1 atm"), ("cold", "2 atm")):
        result = run.program("run", REACTOR, "--out", run.folder / name, "--set", f"pressure={pressure}", *(word for s in SHORT for word in ("--set", s)),
                             "--set", f"initial.temperature={truth['T']} K", "--set", f"initial.composition='H2: {2 * truth['h']}, O2: 1, N2: 3.76'")
        assert result.code == 0, result.err
        rows = run.table(f"{name}/history.csv")
        for row in rows[2::4]:
            text += f"{name},T,{1e6 * float(row['time [s]']):.12g},{row['temperature [K]']},5,here\n"
    return text


def check_fit(run: Analyses) -> None:
    """Found again from exact measurements; tables, warnings, decks that run; a cut-short analysis goes on to the same bits."""
    run.file("data.csv", measured(run, {"T": 1260, "h": 0.8}))
    said = run.good("fit", heating(), "fit")
    assert "objective" in said and "validate" in said, said
    rows = {row["parameter"]: row for row in run.table("fit/fit.csv")}
    assert abs(float(rows["T"]["value"]) - 1260) < 0.05 and abs(float(rows["h"]["value"]) - 0.8) < 1e-3, rows
    assert float(rows["T"]["low"]) < 1260 < float(rows["T"]["high"]) and rows["T"]["at_bound"] == "no" and abs(float(rows["T"]["correlation_T"]) - 1) < 1e-9
    record = json.loads((run.folder / "fit/analysis.json").read_text(encoding="utf-8"))
    assert record["phi_best"] < 1e-3 < record["phi_start"] and record["sources"] == ["here"] and record["runs_begun"] > 16, record
    points = run.table("fit/points.csv")
    assert len(points) == 9 and {row["status"] for row in points} == {"done"} and float(points[0]["phi"]) == record["phi_start"], points[0]
    kept_out = [row for row in run.table("fit/residuals.csv") if row["use"] == "validate"]
    assert kept_out and all(abs(float(row["residual_best"])) < 0.1 for row in kept_out)
    assert any(abs(float(row["residual_start"])) > 1 for row in run.table("fit/residuals.csv"))

    best = run.folder / "fit/best/lean.yaml"
    assert best.read_text(encoding="utf-8").startswith("# deck.yaml of ") and run.program("check", best).code == 0
    assert run.program("run", best, "--out", run.folder / "best").code == 0
    again, found = (run.table(f"{name}/history.csv")[-1]["temperature [K]"] for name in ("best", "lean"))
    assert abs(float(again) - float(found)) < 0.1, (again, found)
    pictures = run.program("plot", run.folder / "fit")
    assert pictures.code == 0 and "parity.png" in pictures.out and "profiles.png" in pictures.out and "pairs.png" in pictures.out, pictures.err + pictures.out

    # The same command again: nothing runs, and the same bits come out. Half of the runs gone, as after a kill: likewise.
    before = {name: (run.folder / "fit" / name).read_bytes() for name in ("fit.csv", "points.csv", "residuals.csv")}
    run.good("fit", heating(), "fit")
    assert json.loads((run.folder / "fit/analysis.json").read_text(encoding="utf-8"))["runs_begun"] == 0
    batches = sorted((run.folder / "shared").glob("batch_*"))
    for batch in batches[::2]:
        (batch / "study.json").unlink()
        shutil.rmtree(sorted(path for path in batch.iterdir() if path.is_dir())[0])
    run.good("fit", heating(), "fit", "--ranks", "1")
    assert json.loads((run.folder / "fit/analysis.json").read_text(encoding="utf-8"))["runs_begun"] == len(batches[::2])
    for name, content in before.items():
        assert (run.folder / "fit" / name).read_bytes() == content, f"{name} is another"

    wider = heating(propagate={"from": "posterior"})
    wider["parameters"][0]["to"] = 1400
    other = run("propagate", wider, "--out", run.folder / "fit")
    assert other.code == 2 and "parameters: these are not those of the fit" in other.err, other.err
    if not ALL:
        return
    surrogate = run.good("fit", heating(design={"points": 32}, optimise={"on": "surrogate", "starts": 2}, uncertainty={"method": "posterior", "samples": 2000}),
                         "posterior")
    assert "posterior: " in surrogate and "surrogates: R2" in surrogate
    rows = {row["parameter"]: row for row in run.table("posterior/fit.csv")}
    assert float(rows["T"]["posterior_low"]) < 1260 < float(rows["T"]["posterior_high"]), rows
    options = heating(design={"points": 32}, propagate={"from": "posterior", "samples": 200})
    before = {name: (run.folder / "posterior" / name).read_bytes() for name in ("analysis.json", "points.csv", "report.txt")}
    run.good("propagate", options, "posterior")
    assert all((run.folder / "posterior" / name).read_bytes() == content for name, content in before.items())
    assert json.loads((run.folder / "posterior/propagated.json").read_text(encoding="utf-8"))["task"] == "propagate"
    assert len(run.table("posterior/propagated_points.csv")) == 32 and (run.folder / "posterior/propagated_report.txt").is_file()
    band = next(row for row in run.table("posterior/bands.csv") if row["deck"] == "lean" and row["quantity"] == "end")
    assert float(band["q2.5"]) < float(run.table("lean/history.csv")[-1]["temperature [K]"]) < float(band["q97.5"]), band
    assert run.program("plot", run.folder / "posterior").code == 0


def check_warnings(run: Analyses) -> None:
    """A bound that is met, and two parameters that only their product tells."""
    narrow = heating()
    narrow["parameters"][0]["to"] = 1200
    assert "T is at its bound 1200" in run.good("fit", narrow, "bound")
    twins = heating()  # without nitrogen only the ratio of hydrogen to oxygen counts
    twins["parameters"] = [{"name": "h", "from": 0.5, "to": 0.9, "set": ["initial.composition='H2: {h*2}, O2: {o}, N2: 0.001'"]},
                           {"name": "o", "from": 0.9, "to": 1.1}]
    result = run("fit", twins, "--out", run.folder / "twins")
    assert result.code == 0 and "cannot tell them apart" in result.out or result.code == 3 and "say nothing of one combination" in result.err, \
        result.err + result.out


def check_sensitivity(run: Analyses) -> None:
    """Every method sees that the final temperature depends on the mixture more than on where it starts."""
    options = heating()
    options["decks"] = options["decks"][:1]
    del options["measurements"]
    found = {}
    for method, column, more in (("surrogate", "S_T", {}), ("saltelli", "S_T", {"points": 8}), ("morris", "mu_star", {"trajectories": 3}),
                                 ("local", "d_ln_output_d_ln_parameter", {})):
        options["sensitivity"] = {"method": method, **more}
        options["design"] = {"points": 32}
        run.good("sensitivity", options, method)
        found[method] = {row["parameter"]: float(row[column]) for row in run.table(f"{method}/sensitivity.csv") if row["output"] == "lean.end"}
        assert run.program("plot", run.folder / method).code == 0
    assert all(abs(one["h"]) > abs(one["T"]) for name, one in found.items() if name != "local"), found
    assert abs(found["surrogate"]["h"] + found["surrogate"]["T"] - 1) < 0.1, found
    options["sensitivity"] = {"method": "surrogate"}
    poor = run("sensitivity", options, "--set", "surrogate.least_r2=0.9999999", "--out", run.folder / "poor")
    assert poor.code == 3 and "numerics: surrogate" in poor.err and "held out" in poor.err, poor.err


def check_design_and_trade_off(run: Analyses) -> None:
    options = heating()
    options["decks"] = [{**one, "use": "candidate"} for one in options["decks"]]
    run.file("data.csv", DATA + "lean,T,20,,5,\nlean,T,150,,5,\ncold,T,20,,50,\ncold,T,150,,50,\n")
    said = run.good("design", options, "design")
    assert run.table("design/choice.csv") == [{"deck": "lean", "times": "1"}, {"deck": "cold", "times": "0"}], said

    options = heating(trade_off={"objectives": [{"quantity": "end", "deck": "lean", "sense": "maximise"}, {"quantity": "delay", "deck": "lean", "sense": "maximise"}],
                                 "points": 4}, design={"points": 32})
    options["decks"] = options["decks"][:1]
    options["quantities"]["delay"] = {"result": "ignition_delays_s.max_dTdt", "transform": "log10"}
    del options["measurements"]
    run.good("trade_off", options, "front")
    rows = run.table("front/front.csv")
    ends, delays = ([float(row[f"lean.{name}"]) for row in rows] for name in ("end", "delay"))
    assert len(rows) >= 2 and sorted(ends) == ends and sorted(delays, reverse=True) == delays, rows
    assert (run.folder / "front/best/1/lean.yaml").is_file() and run.program("plot", run.folder / "front").code == 0
    for words, constraint in (("at_least or at_most", {}), ("limit above 0", {"at_most": 0.0})):
        run.refused(words, "trade_off", {**options, "trade_off": {**options["trade_off"], "constraints": [{"deck": "lean", "quantity": "delay", **constraint}]}})
    run.refused("two are expected", "trade_off", {**options, "trade_off": {"objectives": options["trade_off"]["objectives"][:1]}})


def check_noise(run: Analyses) -> None:
    """Of stochastic populations the standard error is in the objective; a design by jobs, which then goes on."""
    options = {"analysis": "a kernel", "decks": [{"deck": str(POPULATION), "name": "k", "set": ["repeats=8", "methods={mmc: {type: mmc, particles: 200}}"],
                                                 "weight": 4}],
               "parameters": [{"name": "rate", "from": 5e-7, "to": 2e-6, "scale": "log", "set": ["processes.coagulation.rate={rate} cm^3/s"],
                               "prior": {"type": "lognormal", "mean": 1e-6, "deviation": 5}}],
               "quantities": {"M0": {"result": "methods.mmc.moments.0", "error": "methods.mmc.standard_errors.0", "transform": "log10"}},
               "measurements": {"files": ["data.csv"]}, "design": {"points": 4}, "optimise": {"starts": 1, "step": 0.2}}  # fmt: skip
    run.file("data.csv", f"deck,quantity,value [1/cm^3],error [%],source\nk,M0,{1e6 * 2 / 52},1,exact\n")
    jobs = run.good("fit", options, "kernel", "--jobs", "2")
    assert "sbatch" in jobs and "#SBATCH --array=1-2" in (run.folder / "kernel/runs/jobs.slurm").read_text(encoding="utf-8"), jobs
    assert "#SBATCH --ntasks=1\n" in (run.folder / "kernel/runs/jobs.slurm").read_text(encoding="utf-8")
    for place in ("1", "2"):
        done = subprocess.run(["bash", run.folder / "kernel/runs/jobs.slurm"], env={**os.environ, "SLURM_ARRAY_TASK_ID": place}, capture_output=True, check=False)
        assert done.returncode == 0, done.stderr
    run.good("fit", options, "kernel")
    assert json.loads((run.folder / "kernel/analysis.json").read_text(encoding="utf-8"))["runs_taken"] >= 5, "the jobs' runs were not taken"
    row = run.table("kernel/fit.csv")[0]
    assert abs(float(row["value"]) - 1e-6) < 3 * float(row["error"]) < 2e-7, row
    residual = run.table("kernel/residuals.csv")[0]
    noise, s = (float(residual[name]) for name in ("best_noise", "deviation"))
    expected = np.hypot(0.01, noise / float(residual["best"])) / np.log(10)
    assert noise > 0 and abs(s / expected - 1) < 1e-6, (noise, s, expected)
    apart = np.log10(float(residual["measured"]) / float(residual["best"])) / s  # whatever the weight
    assert abs(float(residual["residual_best"]) - apart) < 1e-6 * abs(apart), (residual, apart)
    assert json.loads((run.folder / "kernel/analysis.json").read_text(encoding="utf-8"))["degrees_of_freedom"] == 1  # a measurement and a prior


def check_failures(run: Analyses) -> None:
    """A point that fails is counted and left out."""
    options = heating(design={"points": 16})
    options["decks"] = options["decks"][:1]
    del options["measurements"]
    options["parameters"][1].update({"from": -0.5, "to": 1, "scale": "linear"})  # there is no gas with less than no hydrogen
    said = run.good("design", options, "failing")
    points = run.table("failing/points.csv")
    failed = [row for row in points if row["status"] == "failed"]
    assert 0 < len(failed) < 16 and all(float(row["h"]) < 0 and row["message"] for row in failed) and f"{len(failed)} points failed" in said, said
    assert all(not row["lean.end"] for row in failed)
    run.good("design", options, "failing")  # what was a wrong input is tried again, the others are taken
    assert json.loads((run.folder / "failing/analysis.json").read_text(encoding="utf-8"))["runs_begun"] == len(failed)


def check_refusals(run: Analyses) -> None:
    run.file("data.csv", DATA + "lean,T,20,1300,5,\nlean,T,50,1300,5,\n")
    good = run("check", heating())
    assert good.code == 0 and "2 parameters, 2 decks, 2 measurements" in good.out, good.err

    def changed(**more):
        return {**heating(), **more}

    def parameter(**more):
        return changed(parameters=[{**heating()["parameters"][0], **more}])

    for words, analysis in thinned(
            ("unknown key 'poins'", changed(design={"poins": 3})), ("one of: none, log10", changed(quantities={"T": {"result": "a", "transform": "ln"}})),
            (", parameter T: ", parameter(set=["initial.temprature={T} K"])), ("stands in no assignment", parameter(set=["initial.temperature=1200 K"])),
            ("there is no parameter U", parameter(set=["initial.temperature={U} K"])), ("above from", parameter(to=1.0)),
            ("is set by the parameter T already", changed(parameters=[heating()["parameters"][0], {**heating()["parameters"][0], "name": "U",
                                                                                                  "set": ["initial.temperature={U} K"]}])),
            ("given twice", changed(parameters=heating()["parameters"] * 2)), ("no file", changed(decks=[{"deck": "nowhere.yaml"}])),
            ("no deck of the name", parameter(shift=["nowhere"])), ("either result or table", changed(quantities={"T": {"column": "temperature"}}))):
        run.refused(words, "check", analysis)
    for words, key, more in thinned(
            ("'design.type: sobol' does not have this", "design", {"levels": 3}), ("design.type: factorial", "design", {"type": "factorial", "points": 9}),
            ("'optimise.on: surrogate' does", "optimise", {"on": "surrogate", "most_points": 9}), ("uncertainty.method", "uncertainty", {"samples": 999}),
            ("uncertainty.method", "uncertainty", {"sampler": "own"}), ("choose: saltelli", "sensitivity", {"points": 8}),
            ("choose: morris", "sensitivity", {"method": "local", "trajectories": 3}), ("choose: morris", "sensitivity", {"levels": 4}),
            ("choose: local", "sensitivity", {"method": "morris", "step": 0.1})):
        run.refused(words, "check", changed(**{key: more}))
    run.refused("'decks[0].use: validate' does not have this", "check", changed(decks=[{**heating()["decks"][1], "weight": 2}]))
    for words, task, setting in thinned(
            ("nothing of this `fit` uses the section propagate", "fit", "propagate.samples=100"), ("choose a method by surrogates", "fit", "surrogate.order=3"),
            ("`sensitivity` uses the section optimise", "sensitivity", "optimise.starts=2"), ("`design` uses the section surrogate", "design", "surrogate.order=3")):
        run.refused(words, task, heating(), "--set", setting)
    launched = running.Process(run.program.command[-1], ["mpirun", "-n"], 2)("fit", run.file("analysis.yaml", heating()), "--out", run.folder / "refused")
    assert launched.code == 2 and "starts its runs itself" in launched.err and not (run.folder / "refused").exists(), launched.err
    for words, text in thinned(("'furlong' is not a unit", DATA.replace("K", "furlong")), ("no deck of the name 'rich'", DATA + "rich,T,20,1300,5,\n"),
                        ("no quantity 'U'", DATA + "lean,U,20,1300,5,\n"), ("number is expected", DATA + "lean,T,20,hot,5,\n"),
                        ("error has to be above 0", DATA + "lean,T,20,1300,0,\n"), ("6 fields", DATA + "lean,T,20,1300\n"),
                        ("column 'error' is missing", "deck,quantity,value\n"), ("no column 'values'", "deck,quantity,values,error\n"),
                        ("value is missing", DATA + "lean,T,20,,5,\n"), ("not of the kind", DATA.replace("error [K]", "error [s]") + "lean,T,20,1300,5,\n")):
        run.file("data.csv", text)
        run.refused(words, "check", heating())
    for words, text in thinned(("needs as many measurements", DATA), ("in s, and the run has it in K", DATA.replace("value [K]", "value [s]").replace("error [K]", "error [%]")
                                                               + "lean,T,20,1300,5,\nlean,T,50,1300,5,\n"),
                        ("beyond the run", DATA + "lean,T,20,1300,5,\nlean,T,5000,1300,5,\n")):
        run.file("data.csv", text)
        run.refused(words, "fit", heating(design={"points": 2}))
    run.refused("powers of two", "design", changed(design={"points": 12}))
    run.refused("no posterior here", "propagate", changed(propagate={"from": "posterior"}))
    run.refused("cannot be shared out", "design", changed(ranks_per_run=2), "--ranks", "3")


def main(executable: str) -> None:
    os.environ.update(running.environment())
    with tempfile.TemporaryDirectory() as name:
        run = Analyses(executable, pathlib.Path(name))
        for check in (check_refusals, check_fit, check_failures, *((check_warnings, check_sensitivity, check_design_and_trade_off, check_noise) if ALL else ())):
            check(run)


if __name__ == "__main__":
    main(sys.argv[1])
