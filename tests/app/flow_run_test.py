"""A small sooting flow as users run it: rows of the history, the record of the run, a trajectory that leaves at once. And flows
between two plates, of which the lower rests, that end when they are steady or repeat themselves.

Usage: flow_run_test.py EXECUTABLE RANKS MPIEXEC...
"""

import cmath
import csv
import json
import math
import pathlib
import re
import sys
import tempfile

import running

# Nitrogen between plates 1 mm apart: the upper one moves at 1 m/s from the start on.
STEADY = ", steady: {tolerance: 2e-3, time: 3 ms}"
PLATES = f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/hydrogen_h2o2_10.yaml
mesh: {{geometry: planar, x: [{{to: 30 mm, cells: 3}}], y: [{{to: 1 mm, cells: 10}}]}}
boundaries:
  left: {{type: periodic, side: x-min}}
  right: {{type: periodic, side: x-max}}
  lower: {{type: wall, side: y-min, temperature: 300 K}}
  upper: {{type: wall, side: y-max, temperature: 300 K, tangential_velocity: 1 m/s}}
initial: {{layer: none, composition: "N2: 1", temperature: 300 K}}
time: {{end: 60 ms, maximum_step: 0.5 ms, sweeps: 2{STEADY}}}
output: {{interval: 11 ms}}
"""
DENSITY, VISCOSITY = 1.1380, 1.5893e-5  # kg/m^3, m^2/s, by the mechanism

SETTINGS = ("output.history_steps=3", "seed=7", "time.end=10 us", "time.maximum_step=1 us")


def steady_run(program, folder, name, text, *arguments):
    """What a run between the plates says, the text of its history, its last row, and what its record has of it."""
    deck = folder / f"{name}.yaml"
    deck.write_text(text, encoding="utf-8")
    out = folder / name
    result = program("run", deck, "--out", out, *arguments)
    assert result.code == 0, result.err
    history = (out / "history.csv").read_text(encoding="utf-8")
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    return result, history, list(csv.DictReader(history.splitlines()))[-1], record["results"]


def check_steady(program, folder, ranks) -> None:
    # By what the velocity differs from a straight line: 2/pi exp(-rate t) sin(pi y/H) in the end, rate = nu pi^2/H^2. Ranges are
    # those between the centres of cells.
    rate, time, tolerance = VISCOSITY * math.pi**2 / 1e-6, 3e-3, 2e-3
    expected = math.log(2 / math.pi * math.cos(math.pi / 20) * math.expm1(rate * time) / 0.9 / tolerance) / rate
    result, history, last, found = steady_run(program, folder, "steady", PLATES)
    end = float(last["time [s]"])
    assert expected - 0.5e-3 < end < expected + time / 4 + 0.5e-3, (expected, end)
    assert found["steady"] is True and tolerance / 2 < found["change"] < tolerance, found
    assert found["change"] == float(last["steady_change [1]"]) and found["residence_time_s"] == time, (found, last)
    assert found["period_s"] is None and last["steady_period [s]"] == "nan", (found, last)
    # The force of the sine that is left, by what it has changed, over the momentum that the gas brings in the time.
    amplitude = 0.9 * found["change"] / math.cos(math.pi / 20) / math.expm1(rate * time)
    left = rate * time * 2 / math.pi * amplitude / 0.95
    assert abs(found["residual"]["momentum"] / left - 1) < 0.05, (found, left)
    assert f"residual, of the throughflow: mass {found['residual']['mass']:.1e}, mass fluxes" in result.out, result.out
    assert f"steady at t = {end:.6g} s (time.steady.tolerance 0.002, maximum norm)" in result.out, result.out
    assert "in the last 0.003 s (time.steady.time) fields changed by" in result.out, result.out
    assert not result.err, result.err
    if ranks > 1:
        return

    # What Open MPI leaves of a process that was killed while it wrote a checkpoint of this name: nobody waits for it.
    semaphore = pathlib.Path("/dev/shm/sem.OMPIO_outputs_000052.h5.part")
    if semaphore.parent.is_dir():
        semaphore.write_bytes(bytes(32))
    # One that was broken off in the middle ends with the same bits; one whose first part did not ask ends a little later.
    unasked = PLATES.replace(STEADY, "")
    for name, first in (("whole", PLATES), ("unasked", unasked)):
        text = first.replace("end: 60 ms", "end: 11 ms")
        result, _, last, found = steady_run(program, folder, name, text + "checkpoint: {at_end: true}\n")
        assert (folder / name / "checkpoint/outputs_000052.h5").exists(), "the semaphore is of another step"
        asks = first == PLATES
        assert ("has come before the flow is steady" in result.err) == asks, result.err
        assert ("not steady (time.steady.tolerance 0.002, maximum norm)" in result.out) == asks, result.out
        assert found.get("steady") == (False if asks else None) and ("steady_change [1]" in last) == asks, (found, last)
        assert ("how steady it is can be told after 0.0" in result.out) != asks, result.out
        result, later, last, found = steady_run(program, folder, name, PLATES, "--restart")
        assert found["steady"] is True and end <= float(last["time [s]"]) < end + time, (end, last)
        assert (later == history) == asks and later.count("nan,nan,nan,nan") == (0 if asks else later.count("\n", 0, later.index(",0.011,"))), name
    semaphore.unlink(missing_ok=True)
    result, later, last, found = steady_run(program, folder, "whole", unasked.replace("end: 60 ms", "end: 45 ms"), "--restart")
    assert "steady" not in found and not any("steady" in name for name in last), (found, last)

    # Not before a time that is given; by the mean over the cells a little earlier than by the largest change.
    _, _, last, found = steady_run(program, folder, "after", PLATES.replace("time: 3 ms", "time: 3 ms, after: 45 ms"))
    assert found["steady"] is True and 45e-3 <= float(last["time [s]"]) < 45.6e-3, last
    result, _, last, found = steady_run(program, folder, "rms", PLATES.replace("time: 3 ms", "time: 3 ms, norm: rms"))
    assert found["change_rms"] < tolerance < found["change"] and float(last["time [s]"]) < end, (found, last)
    assert found["change_rms"] == float(last["steady_change_rms [1]"]) and "RMS norm)" in result.out, (found, last)

    # A plate that moves to and fro is never steady. Stokes' exact solution gives the amplitude of the momentum.
    period = 20e-3
    waves = PLATES.replace("tangential_velocity: 1 m/s", f"formula: {{tangential_velocity: 'sin(2*pi*t/{period})'}}")
    result, _, last, found = steady_run(program, folder, "waves", waves.replace("end: 60 ms", "end: 120 ms"))
    assert found["steady"] is False and found["change"] > 0.3, found
    assert abs(found["period_s"] - period) < 2e-3 * period and float(last["steady_period [s]"]) == found["period_s"], found
    k = cmath.sqrt(2j * math.pi / period / VISCOSITY)
    amplitude = DENSITY * 0.03 * abs((cmath.cosh(k * 1e-3) - 1) / (k * cmath.sinh(k * 1e-3)))
    said = re.search(r"repeats itself every 0.02 s \(50 Hz\); momentum along x (\S+) to (\S+) kg m/s/m", result.out)
    assert said, result.out
    for sign, number in zip((-1, 1), said.groups()):
        assert abs(float(number) - sign * amplitude) < 0.03 * amplitude, (said.groups(), amplitude)


def main(executable: str, ranks: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_steady(program, folder, int(ranks))
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
