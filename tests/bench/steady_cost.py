#!/usr/bin/env python3
"""What an iteration towards a steady state costs: processor time, iterations of the linear solvers and memory over the number of
cells, of species and of ranks.

Usage: steady_cost.py PROGRAM FOLDER [--cells F...] [--ranks N...] [--mechanisms NAME...] [--steps N] [--iterations FEW MANY]

A counterflow flame on a mesh of 750 cells times each of the refinements --cells, with DRM19; and the mechanisms on the mesh of
refinement 1.15. Each is run twice, --steps (20) in time and 5, then 25 iterations from there (--iterations; they end with exit code
3), and the difference counts: what the steps and the set-up take is not in it. Processor time is that of all ranks, user mode, children of
mpirun included; ranks that wait for each other take some too, so that those of several ranks mean nothing on a busy machine.
"""

import argparse
import json
import math
import os
import pathlib
import re
import subprocess

MECHANISMS = pathlib.Path(__file__).resolve().parents[2] / "cases/mechanisms"
SIZES = {"hydrogen_h2o2_10": (10, "H2: 0.5, N2: 0.5"), "methane_drm19_21": (21, "CH4: 1"), "ethylene_bisetti2012_47": (47, "C2H4: 1"),
         "methane_gri30_53": (53, "CH4: 1"), "ethylene_abf2000_101": (101, "C2H4: 1")}

DECK = """problem: flow
mechanism: {mechanism}
pressure: 1 bar
mesh:
  geometry: axisymmetric
  refinement: {refinement}
  r: [{{to: 8 mm, cells: 10}}, {{to: 12 mm, cells: 5}}]
  z: [{{to: 10 mm, cells: 50}}]
boundaries:
  fuel: {{type: inlet, side: z-min, to: 8 mm, velocity: 0.3 m/s, temperature: 298 K, composition: "{fuel}"}}
  air: {{type: inlet, side: z-max, to: 8 mm, velocity: 0.3 m/s, temperature: 298 K, composition: "O2: 0.21, N2: 0.79"}}
  fuel_flange: {{type: wall, side: z-min, from: 8 mm}}
  air_flange: {{type: wall, side: z-max, from: 8 mm}}
  axis: {{type: symmetry, side: r-min}}
  outflow: {{type: outlet, side: r-max, temperature: 298 K, composition: "N2: 1"}}
initial: {{low: fuel, high: air, position: 5 mm, width: 2.5 mm}}
time: {{mode: steady, steady: {{steps: {steps}, returns: 0, attempts: 0, coarser_meshes: 0, iterations: {iterations}, residual: 1e-15}}}}
"""


def measure(program, folder, mechanism, refinement, steps, iterations, ranks):
    """user time (s), largest memory of a rank (MiB), iterations of GMRES, cells."""
    name = f"{mechanism}_{refinement}_{iterations}_{ranks}"
    deck = folder / f"{name}.yaml"
    deck.write_text(DECK.format(mechanism=MECHANISMS / f"{mechanism}.yaml", refinement=refinement, fuel=SIZES[mechanism][1],
                                steps=steps, iterations=iterations), encoding="utf-8")
    command = [program, "run", str(deck), "--out", str(folder / name), "--force"]
    environment = dict(os.environ, PETSC_OPTIONS=f"-log_view :{folder / name}.petsc")
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
    with open(folder / f"{name}.log", "w", encoding="utf-8") as log, \
            subprocess.Popen(command, stdout=log, stderr=log, env=environment) as run:
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    text = (folder / f"{name}.log").read_text(encoding="utf-8")
    if run.returncode != 3 or f"and {iterations} iterations" not in text:
        raise SystemExit(f"{name}: exit {run.returncode}, expected {iterations} iterations\n{text[-2000:]}")
    petsc = (folder / f"{name}.petsc").read_text(encoding="utf-8", errors="replace")
    krylov = sum(int(found) for found in re.findall(r"^KSPGMRESOrthog\s+(\d+)", petsc, re.MULTILINE))
    cells = json.loads((folder / name / "run.json").read_text(encoding="utf-8"))["cells"]
    return usage.ru_utime, usage.ru_maxrss / 1024, krylov, cells


def row(options, mechanism, refinement, ranks):
    """Prints a row; the number of cells, species, and s an iteration."""
    few, many = (measure(options.program, options.folder, mechanism, refinement, options.steps, iterations, ranks)
                 for iterations in options.iterations)
    counted = options.iterations[1] - options.iterations[0]
    seconds, cells, species = (many[0] - few[0]) / counted, many[3], SIZES[mechanism][0]
    print(f"| {species} | {cells} | {ranks} | {seconds:.3f} | {1e6 * seconds / cells:.0f} | {(many[2] - few[2]) / counted:.1f} | "
          f"{many[1]:.0f} |", flush=True)
    return cells, species, seconds


def exponent(points):
    """Of y over x, least squares of the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    x, y = (sum(pair[i] for pair in logs) / len(logs) for i in (0, 1))
    return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--cells", type=float, nargs="*", default=[1.15, 2.3, 4.6])
    parser.add_argument("--ranks", type=int, nargs="*", default=[1, 2])
    parser.add_argument("--mechanisms", nargs="*", default=list(SIZES))
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--iterations", type=int, nargs=2, default=[5, 25])
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print("| species | cells | ranks | s an iteration | us a cell | GMRES iterations | MiB a rank |")
    for ranks in options.ranks:
        sizes = [row(options, "methane_drm19_21", refinement, ranks) for refinement in options.cells]
        species = [row(options, mechanism, 1.15, ranks) for mechanism in options.mechanisms]
        if len(sizes) > 1:
            print(f"{ranks} ranks: exponent of the cells {exponent([(point[0], point[2]) for point in sizes]):.2f}")
        if len(species) > 1:
            print(f"{ranks} ranks: exponent of the species {exponent([(point[1], point[2]) for point in species]):.2f}")


if __name__ == "__main__":
    main()
