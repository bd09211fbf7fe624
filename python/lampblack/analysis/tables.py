"""What an analysis leaves: tables, its record, decks with the best constants."""

import csv
import datetime
import json
import re
import subprocess

import numpy as np
import scipy

from ..program import executable
from .runs import BEYOND


def text_of(value):
    if isinstance(value, (float, np.floating)):
        return f"{value:.17g}" if np.isfinite(value) else ""
    return str(value)


def write_table(path, head, rows):
    temporary = path.with_name("." + path.name)
    with open(temporary, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *([text_of(value) for value in row] for row in rows)])
    temporary.replace(path)


def write_points(path, problem, runs, points, outputs, values, errors, phi=None):
    """A row a point: parameters, how it ended, every output and its standard error, the objective."""
    head = [*(p.name for p in problem.parameters), "status", "message"]
    head += [name for output in outputs for name in (output.name, output.name + "_noise")] + (["phi"] if phi is not None else [])
    rows = []
    for i, x in enumerate(points):
        message = runs.failure(x, outputs) or ("" if np.all(np.isfinite(values[i])) else BEYOND)
        row = [*problem.values(x).values(), "failed" if message else "done", message.split("\n")[0]]
        row += [number for k in range(len(outputs)) for number in (values[i, k], errors[i, k])]
        rows.append(row + ([phi[i]] if phi is not None else []))
    write_table(path, head, rows)


def _without_nan(value):
    """JSON has no numbers that are not finite: null."""
    if isinstance(value, dict):
        return {key: _without_nan(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_without_nan(inner) for inner in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else None
    return value


def write_record(path, task, problem, runs, more):
    """analysis.json."""
    version = subprocess.run([executable(), "--version"], capture_output=True, text=True, check=False).stdout.strip()
    record = {
        "analysis": problem.name, "task": task, "file": str(problem.path.resolve()), "options": problem.options, "lampblack": version,
        "numpy": np.__version__, "scipy": scipy.__version__, "finished": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "seed": problem.options["design"]["seed"], "runs_begun": runs.begun, "runs_taken": runs.taken, **more,
    }  # fmt: skip
    temporary = path.with_name("." + path.name)
    temporary.write_text(json.dumps(_without_nan(record), indent=1, allow_nan=False, default=lambda one: one.tolist()) + "\n", encoding="utf-8")
    temporary.replace(path)


def aligned(head, rows):
    """A table for the console; five digits are enough to look at."""
    def shown(value):
        return f"{value:.5g}" if isinstance(value, (float, np.floating)) else str(value)

    lines = [[shown(value) for value in row] for row in [head, *rows]]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in lines)


_PLAIN = re.compile(r"[A-Za-z0-9_.+-][\w.+/^%-]*( [\w.+/^%-]+)*$")


def _scalar(text):
    return text if _PLAIN.match(text) else json.dumps(text, ensure_ascii=False)


def _flow(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_scalar(key)}: {_flow(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return _scalar(str(value))


def _yaml(value, indent=""):
    """Maps in lines, everything else in YAML's short form."""
    for key, inner in value.items():
        if isinstance(inner, dict) and inner:
            yield f"{indent}{_scalar(key)}:"
            yield from _yaml(inner, indent + "  ")
        else:
            yield f"{indent}{_scalar(key)}: {_flow(inner)}"


def _with_whole_paths(value, folder):
    """Files that a deck names, seen from its folder, by their whole paths."""
    if isinstance(value, dict):
        return {key: _with_whole_paths(inner, folder) for key, inner in value.items()}
    if isinstance(value, list):
        return [_with_whole_paths(inner, folder) for inner in value]
    if isinstance(value, str) and 0 < len(value) < 256 and (folder / value).is_file():
        return str((folder / value).resolve())
    return value


def _assign(deck, key, value):
    """As --set does: a.b[0].c."""
    parts = [int(part) if part.isdigit() else part for part in key.replace("[", ".").replace("]", "").split(".")]
    for part in parts[:-1]:
        deck = deck[part] if isinstance(part, int) else deck.setdefault(part, {})
    deck[parts[-1]] = value


def _over(base, own):
    """As the program lays a deck over its base (io/deck_base.hpp): maps key by key, all else is replaced."""
    if not (isinstance(base, dict) and isinstance(own, dict)):
        return own
    return {**base, **{key: _over(base[key], value) if key in base else value for key, value in own.items()}}


def _deck_of(path):
    """A deck over its base, with every scalar the text that it is: NO is a species. Needs the package yaml."""
    import yaml

    deck = yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.BaseLoader)
    base = deck.pop("base", None)
    return deck if base is None else _over(yaml.load((path.parent / base).read_text(encoding="utf-8"), Loader=yaml.BaseLoader), deck)


def write_best(folder, work, x, words):
    """best/<deck>.yaml: the decks with the constants in their places; each runs as it is. Needs the package yaml, or warns."""
    problem, runs = work.problem, work.runs
    try:
        import yaml
    except ImportError:
        warning = f"{work.folder / 'best'}: the decks with the constants are not written, as PyYAML (Debian: python3-yaml) is not installed"
        if warning not in work.warnings:
            work.warn(warning)
        return
    folder.mkdir(exist_ok=True)
    for experiment in problem.experiments:
        if runs.place(experiment, x) is None:
            continue
        deck = _deck_of(experiment.deck)
        for setting in problem.settings(experiment, x):
            key, _, value = setting.partition("=")
            _assign(deck, key, yaml.load(value, Loader=yaml.BaseLoader))
        head = [f"{experiment.deck.name} of {experiment.deck.parent} with constants of the analysis '{problem.name}'", *words,
                "Set: " + "; ".join(problem.settings(experiment, x))]
        lines = [f"# {line}" for line in head] + list(_yaml(_with_whole_paths(deck, experiment.deck.parent)))
        (folder / f"{experiment.name}.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
