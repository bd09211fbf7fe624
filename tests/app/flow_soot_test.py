"""A flow's soot over a few steps against the closed solution: a gas of one temperature whose only reactant is naphthalene, which
dimerises by its second-order law whatever the coupling and the step.

Usage: flow_soot_test.py EXECUTABLE MPIEXEC...
"""

import math
import pathlib
import sys
import tempfile

import running

h5py = running.package("h5py")

AVOGADRO, BOLTZMANN = 6.02214076e23, 1.380649e-23
CARBON, HYDROGEN = 12.011e-3, 1.008e-3
T, PRESSURE, FRACTION, END = 1000.0, 101325.0, 1e-3, 20e-6
GAS = f"temperature={T} K", f'composition="A2: {FRACTION}, N2: {1 - FRACTION}"'


def expected():
    """Carbon in soot at the end, kg/m3: Wang (2025), eqs. 7-34 to 7-42 for one PAH of sticking coefficient 0.002."""
    mass = (10 * CARBON + 8 * HYDROGEN) / AVOGADRO
    density = 1e6 * (10 * CARBON + 8 * HYDROGEN) / 18 / (0.260884 * 2.46**2 * 3.35)
    diameter = (6 * mass / (math.pi * density)) ** (1 / 3)
    rate = 0.002 * math.sqrt(math.pi * BOLTZMANN * T / mass) * 4 * diameter**2 * AVOGADRO
    start = FRACTION * PRESSURE / (AVOGADRO * BOLTZMANN * T)
    return 10 * CARBON * (start - start / (1 + rate * start * END))


def main(executable, *mpiexec):
    program = running.Program(executable, list(mpiexec), 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        same = [f"boundaries.{inlet}.{value}" for inlet in ("fuel", "oxidiser") for value in GAS]
        for step in ("10 us", "4 us"):
            out = folder / step
            result = program("run", deck, "--out", out, *running.settings(
                *same, f"time.end={END} s", f"time.maximum_step={step}", f"time.first_step={step}"))
            assert result.code == 0, result.err
            with h5py.File(out / "results.h5", "r") as file:
                last = file["steps"][max(file["steps"])]
                carbon = last["soot_carbon"][()]
            # Away from the inlets. What a third of the naphthalene gives off warms the gas by some 1.5 K, of which rate and
            # concentration feel one part in 1e4.
            ratio = carbon.max() / expected()
            print(f"steps of {step}: {ratio:.6f}")
            assert abs(ratio - 1) < 5e-4, ratio
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
