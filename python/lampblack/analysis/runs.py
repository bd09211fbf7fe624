"""Runs of points: each is a run of a deck with settings, known by both, started by `lampblack sweep` in batches. What is there is taken,
of this analysis or of another that names the same folder."""

import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import time

import numpy as np

from ..arrays import table_of_csv
from ..errors import InputError, error_of
from ..program import executable
from .measurements import refuse_other_dimension


PROGRESS = "study: about"  # how its line begins, study_progress.cpp
BEYOND = "a measured place, with its shift, lies beyond the run"


def processors():
    return len(os.sched_getaffinity(0))


_BASE = re.compile(r"""\bbase["']?\s*:\s*(?:"([^"\n]+)"|'([^'\n]+)'|([^\s,}#"'][^,}#\n]*))""")


def _bases(deck, text):
    """The texts of the decks of its folder that a deck goes on from (`base`), found without PyYAML. The words may also stand in a comment:
    one text more in a key does no harm, one that is missing does."""
    names = ["".join(found).strip() for found in _BASE.findall(text)]
    return [(deck.parent / name).read_text(encoding="utf-8") for name in names if (deck.parent / name).is_file()]


def run_key(experiment, settings):
    """Of the text of the deck and of its base, where they stand, and the settings."""
    deck = experiment.deck.read_text(encoding="utf-8")
    text = json.dumps([deck, *_bases(experiment.deck, deck), str(experiment.deck.parent), settings])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


class JobsWritten(Exception):
    """What is missing was written for SLURM instead of being run."""

    def __init__(self, script, count):
        super().__init__(str(script))
        self.script, self.count = script, count


class Runs:
    """The runs of a problem in a folder of batches, each with its study. `jobs`: nothing is run, what is missing is written as an array
    of so many jobs."""

    def __init__(self, problem, folder, ranks=None, jobs=None):
        self.problem, self.folder, self.jobs = problem, pathlib.Path(folder), jobs
        per_run = problem.options["ranks_per_run"]
        # A job has what it is given: the processors of whoever writes it are not the cluster's.
        self.ranks = ranks or (per_run if jobs else max(1, processors() // per_run) * per_run)
        self.taken, self.begun, self._places, self._failed, self._tables = 0, 0, {}, {}, {}
        if self.ranks % per_run:
            raise InputError(f"ranks_per_run: {self.ranks} ranks cannot be shared out in groups of {per_run}")
        for study in sorted(self.folder.glob("*/study.yaml")):
            if not (study.parent / "study.json").is_file():
                self._note_finished(study.parent)
            else:
                self._note(study.parent, earlier=True)

    @property
    def any(self):
        """Whether there are some."""
        return bool(self._places or self._failed)

    def _note(self, batch, earlier=False):
        """What a batch that has ended left. A wrong input of an earlier session may be one no more, as where a file was mended: it is tried
        again, but for jobs, which would never end."""
        lasting = ("numerics failed",) if earlier and not self.jobs else ("numerics failed", "wrong input")
        for run in json.loads((batch / "study.json").read_text(encoding="utf-8"))["runs"]:
            key = run["run"].rpartition("_")[2]
            if run["status"] == "done":
                self._places[key] = batch / run["run"]
            elif run["status"] in lasting:
                self._failed[key] = run["message"]

    def _note_finished(self, batch):
        """What a batch that was cut short has finished."""
        for record in sorted(batch.glob("*/run.json")):
            try:
                if json.loads(record.read_text(encoding="utf-8"))["status"] == "done":
                    self._places[record.parent.name.rpartition("_")[2]] = record.parent
            except (ValueError, KeyError):
                continue

    def _study(self, missing):
        """A study with a variant a run; a deck's runs are those of its own batch."""
        deck = missing[0][1].deck
        return {"study": self.problem.name, "deck": str(deck), "ranks_per_run": self.problem.options["ranks_per_run"],
                "collect": {"tables": []}, "variants": [{"name": key, "set": settings} for key, _, settings in missing]}

    def run(self, points, experiments):
        """Has every point of the unit cube (rows) run in each of the experiments where it is not there yet."""
        wanted = {}
        for x in points:
            for experiment in experiments:
                settings = self.problem.settings(experiment, x)
                wanted.setdefault(run_key(experiment, settings), (experiment, settings))
        missing = [(key, *what) for key, what in wanted.items() if key not in self._places and key not in self._failed]
        self.taken += len(wanted) - len(missing)
        by_deck = {}
        for one in missing:
            by_deck.setdefault(one[1].deck, []).append(one)
        if missing and self.jobs:
            self._write_jobs([part for runs in by_deck.values() for part in _parts(runs, self.jobs)])
        for runs in by_deck.values():
            self._sweep(runs)
        self.begun += len(missing)

    def _batch(self, runs):
        """The folder of a batch, by its runs, with its study."""
        batch = self.folder / ("batch_" + hashlib.sha256(" ".join(key for key, *_ in runs).encode()).hexdigest()[:12])
        batch.mkdir(parents=True, exist_ok=True)
        (batch / "study.yaml").write_text(json.dumps(self._study(runs), indent=1), encoding="utf-8")
        return batch

    def _sweep(self, runs):
        batch = self._batch(runs)
        (batch / "study.json").unlink(missing_ok=True)  # of runs that all were a wrong input in an earlier session: it would say so again
        words = [executable(), "sweep", str(batch / "study.yaml"), "--out", str(batch)]
        ranks = min(self.ranks, len(runs) * self.problem.options["ranks_per_run"])
        if ranks > 1:
            words += ["--ranks", str(ranks)]
        with open(batch / "log.txt", "a", encoding="utf-8") as log, tempfile.TemporaryFile("w+", errors="replace") as errors:
            sweep = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors, text=True, errors="replace")
            try:
                _follow(sweep.stdout, log)
                code = sweep.wait()
            except BaseException:
                sweep.terminate()  # it keeps what has ended
                log.writelines(sweep.stdout)  # until it has ended: a closed pipe would kill it
                sweep.wait()
                raise
            errors.seek(0)
            message = errors.read()
        if code == 2 and self.any and not (batch / "study.json").is_file():
            # Not one of these can begin, while others could: it is the points.
            self._failed.update((key, error_of(code, message).message) for key, *_ in runs)
            return
        if not (batch / "study.json").is_file() or code > 128 or code < 0:
            raise error_of(code or 1, message)
        self._note(batch)
        lost = [key for key, *_ in runs if key not in self._places and key not in self._failed]
        if lost:
            raise error_of(code or 1, message)

    def _write_jobs(self, batches):
        """Studies and a script for SLURM's job arrays."""
        folders = [self._batch(runs) for runs in batches]
        listing = self.folder / "jobs.txt"
        listing.write_text("".join(f"{folder.resolve()}\n" for folder in folders), encoding="utf-8")
        script = self.folder / "jobs.slurm"
        script.write_text(f"""#!/usr/bin/env bash
# The runs of an analysis that are missing, a batch a job: sbatch {shlex.quote(str(script))}; afterwards the command of the analysis goes on.
#SBATCH --array=1-{len(folders)}
#SBATCH --ntasks={self.ranks}
set -euo pipefail
batch="$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {shlex.quote(str(listing.resolve()))})"
exec {shlex.quote(shutil.which("lampblack") or executable())} sweep "$batch/study.yaml" --out "$batch" --ranks {self.ranks}
""", encoding="utf-8")
        raise JobsWritten(script, len(folders))

    def _of(self, outputs):
        """The experiments of outputs, in the problem's order."""
        return [one for one in self.problem.experiments if any(o.experiment is one for o in outputs)]

    def place(self, experiment, x):
        """The folder of a run, or none where it failed."""
        return self._places.get(run_key(experiment, self.problem.settings(experiment, x)))

    def failure(self, x, outputs):
        """The message of the first experiment of these outputs that failed at a point, or nothing."""
        return next((self._failed[key] for experiment in self._of(outputs)
                     if (key := run_key(experiment, self.problem.settings(experiment, x))) in self._failed), "")

    def _table(self, folder, name):
        if (folder, name) not in self._tables:
            if not (folder / name).is_file():
                raise InputError(f"quantities: the run {folder} has no table {name}")
            self._tables[folder, name] = table_of_csv(folder / name)
        return self._tables[folder, name]

    def _of_result(self, folder, output):
        key = (folder, "run.json")
        if key not in self._tables:
            self._tables[key] = json.loads((folder / "run.json").read_text(encoding="utf-8"))["results"]
        numbers = self._tables[key]

        def look(name):
            at = numbers
            for part in name.split("."):
                if isinstance(at, list):
                    at = at[int(part)] if part.isdigit() and int(part) < len(at) else None
                else:
                    at = at.get(part) if isinstance(at, dict) else None
            return at

        quantity = output.quantity
        value = look(quantity.result)
        if not isinstance(value, (int, float)):
            raise InputError(f"quantities.{quantity.name}.result: the run {folder} has no number {quantity.result}; it has {', '.join(numbers)}")
        return value, look(quantity.error or f"{quantity.result}_error") or 0.0

    def _of_table(self, folder, output, shift):
        quantity = output.quantity
        table = self._table(folder, quantity.table)
        for name in (quantity.column, quantity.along, quantity.error):
            if name is not None and name not in table:
                raise InputError(f"quantities.{quantity.name}: {quantity.table} has no column {name}; it has {', '.join(table)}")
        values = np.asarray(table[quantity.column], float)
        refuse_other_dimension(output, table[quantity.column].unit, "value")
        errors = table.get(quantity.error or f"{quantity.column}_error")
        errors = np.zeros(len(values)) if errors is None else np.asarray(errors, float)
        if output.place is None:
            at = {"last": len(values) - 1, "maximum": int(np.argmax(values)), "mean": slice(None)}[quantity.take]
            return float(np.mean(values[at])), float(np.mean(errors[at]))
        refuse_other_dimension(output, table[quantity.along].unit, "abscissa")
        along, place = np.asarray(table[quantity.along], float), output.place + shift
        if not along[0] <= place <= along[-1]:
            if shift != 0:
                return np.nan, np.nan
            raise InputError(f"measurements: {output.name} lies beyond the run, which goes from {along[0]:.6g} to {along[-1]:.6g}; let the deck run further, "
                             "or leave such rows out by decks[].abscissa_from and abscissa_to")
        return float(np.interp(place, along, values)), float(np.interp(place, along, errors))

    def values(self, points, outputs):
        """Each output at each point (a row a point) and its standard error; nan where the run failed, or a shift
        moves the place beyond it. What is missing is run, of the decks of these outputs alone."""
        self.run(points, self._of(outputs))
        values, errors = np.full((2, len(points), len(outputs)), np.nan)
        for i, x in enumerate(points):
            for k, output in enumerate(outputs):
                folder = self.place(output.experiment, x)
                if folder is None:
                    continue
                if output.quantity.result is not None:
                    values[i, k], errors[i, k] = self._of_result(folder, output)
                else:
                    values[i, k], errors[i, k] = self._of_table(folder, output, self.problem.shift(output.experiment, x))
        return values, errors


def _follow(lines, log, seconds=10.0):
    """Keeps what a study says, and passes on how far it is, not more often than that."""
    told = time.monotonic()
    for line in lines:
        log.write(line)
        if line.startswith(PROGRESS) and time.monotonic() - told > seconds:
            print(line.rstrip(), flush=True)
            log.flush()
            told = time.monotonic()


def _parts(runs, count):
    """In so many parts of about the same length, none empty."""
    return [part for i in range(count) if (part := runs[i * len(runs) // count:(i + 1) * len(runs) // count])]
