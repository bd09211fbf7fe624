"""The soot of the shipped counterflow flame, on a coarse grid, against scripts/check_soot_rates: equations 7-20 to 7-56 of
Wang (2025) recomputed without the program. And that the script sees what it is there for.

Usage: soot_rates_test.py EXECUTABLE MPIEXEC...
"""

import json
import pathlib
import shutil
import sys
import tempfile

import running

h5py = running.package("h5py")

SCRIPT = running.SOURCE / "scripts/check_soot_rates"
# Other numbers than the published ones, so that the deck's count.
VARIANT = ("particles.pah=[A2, A3, A4]", "particles.sticking=[1e-3, 0.015, 0.03]", "particles.site_density=3.5e19 1/m^2",
           "particles.density=1800 kg/m^3", "particles.van_der_waals=2", "particles.oh_efficiency=0.2")


def checked(folder):
    # On this grid the flame's own largest volume fraction is 5 % off that of the case's grid.
    done = running.script(SCRIPT, folder, "--transport-limit", "10", "--json")
    assert done.code in (0, 1), done.err
    return done.code, json.loads(done.out)


def spoiled(folder, name, path, factor):
    """A copy of the results in which one dataset is `factor` times what it was."""
    copy = folder.with_name(name)
    shutil.copytree(folder, copy)
    with h5py.File(copy / "results.h5", "r+") as file:
        file[path][...] *= factor
    return checked(copy)[0]


def main(executable, *mpiexec):
    program = running.Program(executable, list(mpiexec), 1)
    deck = running.SOURCE / "cases/flame1d/counterflow_ethylene_soot/deck.yaml"
    with tempfile.TemporaryDirectory() as name:
        folders = [pathlib.Path(name) / part for part in ("published", "variant")]
        for folder, settings in zip(folders, ((), VARIANT)):
            result = program("run", deck, "--out", folder, *running.settings("grid.slope=0.3", "grid.curve=0.5", *settings))
            assert result.code == 0, result.err
            code, found = checked(folder)
            print(folder.name, json.dumps(found))
            # The same double precision formulas in another order: a few hundred roundings.
            assert code == 0 and len(found["processes"]) == 11 and max(found["processes"].values()) < 1e-12, found
        for path in ("soot/processes/growth", "soot/processes/coagulation_number", "soot/surface_area", "X/A4"):
            assert spoiled(folders[0], path.replace("/", "_"), "flame/" + path, 1.00001) == 1, path
        # The transport alone: a gas that flows elsewhere puts the soot elsewhere.
        assert spoiled(folders[0], "flow", "flame/mass_flux", 1.2) == 1, "mass flux"
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
