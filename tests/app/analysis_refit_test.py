"""Two constants of soot are found again from synthetic measurements: volume fraction and number at ten places of a duct at three
temperatures, with errors of 10 %, from bounds a factor of ten to each side. Each constant lies within two errors as often as a normal
distribution says, 95.4 % of the seeds, within three binomial errors of that. With --ensemble soot is a small ensemble of particles, the truth a
mean of many of its repeats, and the noise of the runs counts in the objective.

Usage: analysis_refit_test.py EXECUTABLE [--surrogate] [--ensemble] [SEEDS]
"""

import contextlib
import csv
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import running

np = running.package("numpy")
running.needs("h5py", "scipy")
os.environ["LAMPBLACK_PROGRAM"] = str(pathlib.Path(sys.argv[1]).resolve())
os.environ.update(running.environment())
sys.path.insert(0, str(running.SOURCE / "python"))

from lampblack.analysis.fit import fit  # noqa: E402
from lampblack.analysis.measurements import Output  # noqa: E402
from lampblack.analysis.problem import Problem  # noqa: E402
from lampblack.analysis.work import Work  # noqa: E402

DUCT = running.SOURCE / "cases/reactor/plug_flow_soot/deck.yaml"
TRUE = {"alpha": 0.3, "stick": 2e-3}  # how much of the surface is active, and how often molecules stick when they meet
TEMPERATURES = (1700, 1800, 1900)
PLACES = [0.01 * (i + 1) for i in range(9)] + [0.1]
ENSEMBLE = ["particles.description=ensemble", "particles.number=32", "particles.coupling_change=0.5"]


def analysis(folder, soot, *, surrogate):
    """The file, with bounds about a factor of ten to each side of the truth, a share of all sites at most."""
    decks = [{"name": f"T{T}", "deck": str(DUCT), "set": [f"inlet.temperature={T} K", "output.spacing=10 mm", "particles.condensation=false", *soot]}
             for T in TEMPERATURES]
    parameters = [
        {"name": "alpha", "from": 0.03, "to": 1, "scale": "log", "set": ["particles.alpha={alpha}"]},
        {"name": "stick", "from": 1.8e-4, "to": 1.6e-2, "scale": "log", "set": ["particles.sticking=[{stick}]"]}]
    quantities = {"fv": {"table": "history.csv", "column": "soot_volume_fraction", "along": "position", "transform": "log10"},
                  "number": {"table": "history.csv", "column": "soot_number_density", "along": "position", "transform": "log10"}}
    text = {"analysis": "two constants of soot", "runs": "runs", "decks": decks, "parameters": parameters, "quantities": quantities,
            "measurements": {"files": ["data.csv"]}, "design": {"points": 64},
            "surrogate": {"order": 4, "least_r2": 0.3} if soot else {"order": 6},  # what surrogates miss counts as an error
            "optimise": {"on": "surrogate" if surrogate else "runs", "starts": 1, "step": 0.02, "tolerance": 1e-4}}
    path = folder / f"analysis_{len(soot)}.yaml"
    path.write_text(json.dumps(text), encoding="utf-8")
    return path


def resolved(path):
    """As the program hands it over: by a python3 that prints its arguments."""
    echo = path.with_name("python3")
    echo.write_text('#!/bin/sh\nif [ "$1" = -c ]; then exit 0; fi\nprintf %s "$6"\n', encoding="utf-8")
    echo.chmod(0o755)
    done = subprocess.run([os.environ["LAMPBLACK_PROGRAM"], "fit", str(path)], env={**os.environ, "LAMPBLACK_PYTHON": str(echo)}, capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout)


def write_data(folder, outputs, values, seed):
    draw = np.random.default_rng(seed)
    with open(folder / "data.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["deck", "quantity", "abscissa [cm]", "value", "error [%]", "source"])
        for output, value in zip(outputs, values):
            table.writerow([output.experiment.name, output.quantity.name, 100 * output.place, value * (1 + 0.1 * draw.standard_normal()), 10, "synthetic"])


def true_values(folder, soot):
    """Volume fraction and number at the true constants, without noise or with little."""
    path = analysis(folder, soot, surrogate=True)
    problem = Problem(resolved(path), path)
    outputs = [Output(e, q, place) for e in problem.experiments for q in problem.quantities.values() for place in PLACES]
    truth = np.array([[p.place(TRUE[p.name]) for p in problem.parameters]])
    values, errors = Work(problem, folder).runs.values(truth, outputs)
    return truth[0], outputs, values[0], errors[0] / values[0]


def main():
    surrogate, soot = "--surrogate" in sys.argv, ENSEMBLE if "--ensemble" in sys.argv else []
    seeds = int(sys.argv[-1]) if sys.argv[-1].isdigit() else 20
    kept = os.environ.get("LAMPBLACK_REFIT_FOLDER")
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(kept or made)
        truth, outputs, values, noise = true_values(folder, soot and [*soot, "particles.repeats=64", "particles.seed=2"])
        path = analysis(folder, soot and [*soot, "particles.repeats=4"], surrogate=surrogate)
        problem = Problem(resolved(path), path)
        work = Work(problem, folder)
        if soot:
            print(f"noise of the truth, mean {np.sqrt(np.mean(noise[:len(PLACES)]**2))}")
        rows = []
        for seed in range(seeds):
            write_data(folder, outputs, values, seed)
            with contextlib.redirect_stdout(io.StringIO()):
                best = fit(work)
            with open(folder / "fit.csv", newline="", encoding="utf-8") as file:
                found = list(csv.DictReader(file))
            with open(folder / "analysis.json", encoding="utf-8") as file:
                record = json.load(file)
            off = [(float(b) - float(t)) * float(p.slope(b)) / float(row["error"]) for b, t, p, row in zip(best, truth, problem.parameters, found)]
            rows.append(off)
            print(f"seed {seed}: {record['best']} off by {off[0]:+.2f} and {off[1]:+.2f} errors, objective {record['phi_best']:.1f} "
                  f"of {record['degrees_of_freedom']}", flush=True)
        inside = np.abs(rows) <= 2
        print(f"within two errors: {inside.sum(axis=0)} of {seeds} seeds, both {inside.all(axis=1).sum()}; root mean squares "
              f"{np.sqrt(np.mean(np.square(rows), axis=0))}")
        expected = 0.9545 * inside.size
        assert abs(inside.sum() - expected) <= 3 * np.sqrt(expected * 0.0455), f"{inside.sum()} of {inside.size}"


if __name__ == "__main__":
    main()
