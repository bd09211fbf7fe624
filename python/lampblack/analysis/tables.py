"""What an analysis leaves: tables, its record, decks with the best constants."""

import csv
import datetime
import json
import subprocess

import numpy as np
import scipy

from ..program import executable


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
        message = runs.failure(x)
        row = [*problem.values(x).values(), "failed" if message else "done", message.split("\n")[0]]
        row += [number for k in range(len(outputs)) for number in (values[i, k], errors[i, k])]
        rows.append(row + ([phi[i]] if phi is not None else []))
    write_table(path, head, rows)


def write_record(path, task, problem, runs, more):
    """analysis.json."""
    version = subprocess.run([executable(), "--version"], capture_output=True, text=True, check=False).stdout.strip()
    record = {
        "analysis": problem.name, "task": task, "file": str(problem.path.resolve()), "options": problem.options, "lampblack": version,
        "numpy": np.__version__, "scipy": scipy.__version__, "finished": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "seed": problem.options["design"]["seed"], "runs_begun": runs.begun, "runs_taken": runs.taken, **more,
    }  # fmt: skip
    temporary = path.with_name("." + path.name)
    temporary.write_text(json.dumps(record, indent=1, default=lambda one: one.tolist()) + "\n", encoding="utf-8")
    temporary.replace(path)


def aligned(head, rows):
    """A table for the console; five digits are enough to look at."""
    def shown(value):
        return f"{value:.5g}" if isinstance(value, (float, np.floating)) else str(value)

    lines = [[shown(value) for value in row] for row in [head, *rows]]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in lines)


def _yaml(value, indent=""):
    """Maps in lines, everything else in YAML's short form."""
    for key, inner in value.items():
        if isinstance(inner, dict) and inner:
            yield f"{indent}{key if key.replace('_', '').isalnum() and not key[0].isdigit() else json.dumps(key)}:"
            yield from _yaml(inner, indent + "  ")
        else:
            yield f"{indent}{key if key.replace('_', '').isalnum() and not key[0].isdigit() else json.dumps(key)}: {json.dumps(inner, ensure_ascii=False)}"


def _with_whole_paths(value, folder):
    """Files that a deck names, seen from its folder, by their whole paths."""
    if isinstance(value, dict):
        return {key: _with_whole_paths(inner, folder) for key, inner in value.items()}
    if isinstance(value, list):
        return [_with_whole_paths(inner, folder) for inner in value]
    if isinstance(value, str) and 0 < len(value) < 256 and (folder / value).is_file():
        return str((folder / value).resolve())
    return value


def write_best(folder, problem, runs, x, words):
    """best/<deck>.yaml: all keys as the best run had them, with the constants in their places; each runs as it is."""
    folder.mkdir(exist_ok=True)
    for experiment in problem.experiments:
        place = runs.place(experiment, x)
        if place is None:
            continue
        deck = json.loads((place / "run.json").read_text(encoding="utf-8"))["deck"]
        head = [f"{experiment.deck.name} of {experiment.deck.parent} with constants of the analysis '{problem.name}'", *words,
                "Set: " + "; ".join(problem.settings(experiment, x)), "All keys, in SI units."]
        lines = [f"# {line}" for line in head] + list(_yaml(_with_whole_paths(deck, experiment.deck.parent)))
        (folder / f"{experiment.name}.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
