"""The program: checks, runs and sweeps of decks. Its errors are exceptions (`errors`)."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile

from .analysis.folder import Analysis
from .errors import error_of
from .opening import open as opened
from .study import Study


def executable():
    """LAMPBLACK_PROGRAM where that is set; the program that this package came with, installed or in the folder of a build; or the
    one of PATH."""
    if chosen := os.environ.get("LAMPBLACK_PROGRAM"):
        return chosen
    package = pathlib.Path(__file__).resolve().parent
    beside = (package.parents[3] / "bin/lampblack", package.parents[1] / "build/release/app/lampblack")
    found = next((str(path) for path in beside if os.access(path, os.X_OK)), None) or shutil.which("lampblack")
    if found is None:
        raise FileNotFoundError("there is no program lampblack beside this package or in PATH; LAMPBLACK_PROGRAM names one")
    return found


def setting(value):
    """As it would stand in a deck: texts as they are, numbers exactly, lists and maps in YAML's short form."""
    return value if isinstance(value, str) else json.dumps(value, default=lambda other: other.tolist())


def _settings(values):
    return [word for key, value in (values or {}).items() for word in ("--set", f"{key}={setting(value)}")]


def _call(*words):
    done = subprocess.run([executable(), *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                          check=False)
    if done.returncode != 0:
        raise error_of(done.returncode, done.stderr)
    return done.stdout


def _name(deck):
    """results/<case>, as scripts/run has it."""
    deck = pathlib.Path(deck).resolve()
    return deck.parent.name if deck.stem in ("deck", "study") else deck.stem


def check(deck, set=None):
    """Reads all that a deck names and runs nothing; returns what the program says of it. InputError where something is wrong."""
    return _call("check", deck, *_settings(set)).strip()


def run(deck, set=None, out=None, ranks=1, force=False):
    """Runs a deck and opens its results. `set` has other values for keys of the deck ({"time.end": "1 ms"}), `out` is the folder for
    the results (results/<case>), which `force` allows to be replaced."""
    out = pathlib.Path(out or pathlib.Path("results") / _name(deck))
    _call("run", deck, *_settings(set), "--out", out, *(["--ranks", ranks] if ranks > 1 else []), *(["--force"] if force else []))
    return opened(out)


def analyse(task, analysis, set=None, out=None, ranks=None, force=False):
    """Carries out an analysis (`task`: fit, sensitivity, propagate, design or trade_off) and opens what it left. `set` has other values for keys
    of the analysis; runs go side by side on all processors, or on so many `ranks`."""
    out = pathlib.Path(out or pathlib.Path("results") / f"{_name(analysis)}_{task}")
    _call(task, analysis, *_settings(set), "--out", out, *(["--ranks", ranks] if ranks else []), *(["--force"] if force else []))
    return Analysis(out)


def sweep(deck, vary=None, set=None, out=None, ranks=1, chain=1, force=False, allow_failures=False):
    """Runs a study and opens it. `deck` is a study, or a deck of which `vary` has keys and their values ({"inlet.temperature":
    ["300 K", "400 K"]}); all combinations are run, one-dimensional flames and flows in chains of so many. With `allow_failures` runs may fail,
    as Study.failed says; otherwise that is the program's error."""
    out = pathlib.Path(out or pathlib.Path("results") / _name(deck))
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(deck)
        if vary:
            study = pathlib.Path(folder) / "study.yaml"
            varied = [{"key": key, "values": [setting(value) for value in values]} for key, values in vary.items()]
            study.write_text(json.dumps({"study": _name(deck), "deck": str(pathlib.Path(deck).resolve()), "vary": varied, "chain": chain}),
                             encoding="utf-8")
        try:
            _call("sweep", study, *_settings(set), "--out", out, *(["--ranks", ranks] if ranks > 1 else []), *(["--force"] if force else []))
        except Exception:
            if not (allow_failures and (out / "study.json").is_file()):
                raise
    return Study(out)
