"""A small sooting flow as users run it: rows of the history, the record of the run, a trajectory that leaves at once.

Usage: flow_run_test.py EXECUTABLE RANKS MPIEXEC...
"""

import csv
import json
import pathlib
import sys
import tempfile

import running

SETTINGS = ("output.history_steps=3", "seed=7", "time.end=10 us", "time.maximum_step=1 us")


def main(executable: str, ranks: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        text = deck.read_text(encoding="utf-8")
        # The second trajectory starts half a nanometre from the outlet.
        deck.write_text(text.replace("{r: 2 mm, z: 4.5 mm}", "{r: 13.9999995 mm, z: 6 mm}"), encoding="utf-8")
        out = folder / "out"
        result = program("run", deck, *running.settings(*SETTINGS), "--out", out)
        assert result.code == 0, result.err
        assert result.err.count("warning: trajectory 1 from (0.014, 0.006) m leaves the domain") == 1, result.err
        files = {path.name for path in out.iterdir()}
        assert {"results.h5", "results.xdmf", "history.csv", "run.json"} == files, files

        with open(out / "history.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        steps = [int(float(row["step [1]"])) for row in rows]
        last = steps[-1]
        assert steps == [*range(3, last, 3), last], f"not every third step and the last: {steps}"
        # A sum of a dozen steps, each rounded.
        assert abs(float(rows[-1]["time [s]"]) - 1e-5) < 1e-19, rows[-1]["time [s]"]

        record = json.loads((out / "run.json").read_text(encoding="utf-8"))
        expected = {"status": "done", "message": "", "seed": 7, "ranks": int(ranks), "cells": 60, "steps": last,
                    "simulated_time_s": float(rows[-1]["time [s]"]), "overrides": list(SETTINGS)}
        found = {key: record[key] for key in expected}
        assert found == expected, f"{found} instead of {expected}"
        mesh = record["mesh"]
        assert mesh["quadrilateral"] == 60 and mesh["angle"]["value"] == 0 and mesh["growth"]["value"] > 1, mesh
        assert "mesh: 60 quadrilaterals of " in result.out, result.out
        checked = program("check", deck)
        assert "mesh: 60 quadrilaterals of " in checked.out and "all faces are orthogonal" in checked.out, checked.out
        assert record["deck"]["output"]["history_steps"] == 3 and abs(record["deck"]["time"]["end"] - 1e-5) < 1e-19


main(*sys.argv[1:])
