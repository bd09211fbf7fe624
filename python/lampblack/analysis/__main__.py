"""Starts a task; `lampblack fit` and its sisters, and `lampblack check` of an analysis, come here with the analysis as their schema read it."""

import argparse
import json
import pathlib
import shutil
import signal
import sys

from ..errors import InputError, LampblackError, MachineError, NumericsError, ResultsError, Stopped

TASKS = ("fit", "sensitivity", "propagate", "design", "trade_off")
TABLES = ("points.csv", "searches.csv", "fit.csv", "residuals.csv", "errors.csv", "objective.csv", "sensitivity.csv", "bands.csv", "front.csv", "choice.csv",
          "errors_expected.csv", "posterior.h5", "analysis.json", "report.txt")
PROPAGATED = ("bands.csv", "propagated_points.csv", "propagated.json", "propagated_report.txt")  # beside a fit


def check_decks(problem):
    """Asks the program whether a run of each deck could begin, the parameters at their start. InputError with the parameter's name."""
    from ..program import check as check_deck

    for experiment in problem.experiments:
        pairs = [assignment.partition("=")[::2] for assignment in problem.settings(experiment, problem.start)]
        try:
            check_deck(experiment.deck, set=dict(pairs))
        except InputError as error:
            key = (error.setting or "").partition("=")[0]
            name = next((p.name for p in problem.parameters for assignment in p.set if key and assignment.partition("=")[0] == key), None)
            raise InputError(f"{problem.path}: deck {experiment.name}{f', parameter {name}' if name else ''}: {error.message}") from error


def check(problem):
    """Reads all that an analysis names."""
    from .measurements import read_measurements

    rows = read_measurements(problem)
    check_decks(problem)
    print(f"{problem.path} is a valid analysis: {len(problem.parameters)} parameters, {len(problem.experiments)} decks, {len(rows)} measurements.")


def begin(arguments, problem):
    """The folder of the analysis, and all that its task needs."""
    from .work import Work

    folder, task = arguments.out, arguments.task
    record = folder / "analysis.json"
    before = json.loads(record.read_text(encoding="utf-8")) if record.is_file() else None
    beside = before is not None and (before["task"], task) == ("fit", "propagate")  # a posterior is propagated in its own folder
    if beside:
        for key in ("parameters", "decks"):
            if before["options"][key] != problem.options[key]:
                raise InputError(f"{key}: these are not those of the fit in {folder}; give the analysis that was fitted, or fit anew, or choose another "
                                 "folder with --out DIR")
    elif before is not None and not arguments.force:
        if (before["task"], before["options"]) != (task, problem.options):
            raise InputError(f"{folder}: this folder holds another analysis already. Choose another with --out DIR, or replace it with --force; "
                             "runs that both have in common are taken from there where the key runs names one folder for both")
    if (folder / "run.json").is_file() or (folder / "study.json").is_file():
        raise InputError(f"{folder}: this folder holds a run or a study already; choose another with --out DIR")
    folder.mkdir(parents=True, exist_ok=True)
    if arguments.force:
        for name in PROPAGATED if beside else TABLES + PROPAGATED:
            (folder / name).unlink(missing_ok=True)
        if not beside:
            shutil.rmtree(folder / "best", ignore_errors=True)
    return Work(problem, folder, arguments.ranks, arguments.jobs, beside)


def work_on(arguments, problem):
    from .fit import fit
    from .front import trade_off
    from .studies import design, propagate, sensitivity

    work = begin(arguments, problem)
    if not work.runs.any:
        check_decks(problem)
    work.say(f"{problem.name}: {arguments.task}")
    {"fit": fit, "sensitivity": sensitivity, "propagate": propagate, "design": design, "trade_off": trade_off}[arguments.task](work)
    work.file("report.txt").write_text("\n".join(work.lines) + "\n", encoding="utf-8")
    print(f"analysis in {work.folder}; lampblack plot {work.folder} makes its pictures")


def told(kind, error, code):
    print(f"lampblack: {kind}{error.message}", file=sys.stderr)
    return code


def main():
    parser = argparse.ArgumentParser(prog="lampblack.analysis")
    parser.add_argument("task", choices=("check", *TASKS))
    parser.add_argument("analysis", type=pathlib.Path)
    parser.add_argument("--resolved", required=True, help="the analysis as the program has read it, JSON")
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--ranks", type=int)
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--force", action="store_true")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        from .problem import Problem
        from .runs import JobsWritten

        problem = Problem(json.loads(arguments.resolved), arguments.analysis)
        if arguments.task == "check":
            check(problem)
            return 0
        try:
            work_on(arguments, problem)
        except JobsWritten as written:
            print(f"the runs that are missing are {written.count} jobs; hand them to SLURM by\n  sbatch {written.script}\nand give this command again when they have ended")
        return 0
    except (InputError, ResultsError) as error:
        return told("", error, 2)
    except NumericsError as error:
        return told("numerics: ", error, 3)
    except MachineError as error:
        return told("", error, 3)
    except Stopped as error:
        return told("stopped: ", error, error.exit_code)
    except LampblackError as error:
        return told("", error, 1)
    except KeyboardInterrupt:
        print("lampblack: stopped; the runs that have ended are kept, and the same command goes on", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"lampblack: {error}", file=sys.stderr)
        return 3


if __name__ == "__main__":
    sys.exit(main())
