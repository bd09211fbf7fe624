"""What scripts/compare_openfoam reads and says, on fields of OpenFOAM that are written here and a run of Lampblack that is."""

import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SPECIES = ["CH4", "O2", "CO2", "CO", "OH"]

FIELD = """FoamFile
{{
    version     2.0;
    format      ascii;
    class       volScalarField;
    object      {name};
}}
dimensions      [0 0 0 0 0 0 0];

internalField   {inside};

boundaryField
{{
    air {{ type fixedValue; value uniform 7; }}
    fuel {{ type fixedValue; value nonuniform List<scalar> 2(8 9); }}
}}
"""


def listed(values):
    return f"nonuniform List<scalar> \n{len(values)}\n(\n" + "\n".join(f"{v:.12g}" for v in values) + "\n)\n"


def write_case(folder, fields, times=("0", "0.005")):
    (folder / "system").mkdir(parents=True)
    (folder / "constant").mkdir()
    for time in times:
        (folder / time).mkdir()
        for name, inside in fields.items():
            (folder / time / name).write_text(FIELD.format(name=name, inside=inside if time == times[-1] else "uniform 0"))
    return folder


def write_run(folder, fields):
    folder.mkdir()
    with h5py.File(folder / "results.h5", "w") as file:
        file["mesh/cellCentre"], file["mesh/vertices"], file["mesh/cells"] = np.zeros((3, 3)), np.zeros((8, 3)), np.zeros((3, 4), int)
        for name, values in fields.items():
            file["steps/000004/" + ("temperature" if name == "T" else "X_" + name)] = np.array(values)
    return folder


def compared(*words):
    done = subprocess.run([sys.executable, "-m", "lampblack.plots.openfoam", *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(SCRIPTS.parent / "python")})
    return done.returncode, done.stdout, done.stderr


def main():
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        # Off by 3 and 0 and 0 K; the first species by 0.01 of a largest value of 0.5, the others not at all.
        tight = {"T": [300.0, 2000.0, 1000.0], **{s: [0.5, 0.1, 0.0] for s in SPECIES}}
        loose = {"T": [303.0, 2000.0, 1000.0], **{s: [0.5, 0.1, 0.01 if s == "CH4" else 0.0] for s in SPECIES}}
        texts = lambda fields: {name: listed(values) for name, values in fields.items()}
        foam = write_case(work / "foam", texts(loose)), write_case(work / "foam_tight", texts(tight))
        own = write_run(work / "own", loose), write_run(work / "own_tight", tight)

        code, said, error = compared("OpenFOAM", *foam, "Lampblack", *own)
        assert code == 0, error
        rows = said.splitlines()
        assert len(rows) == 3 and rows[1].split()[1:] == rows[2].split()[1:], said
        assert rows[1].split() == "OpenFOAM 3 / 1 2 / 0.67 0 / 0 0 / 0 0 / 0 0 / 0".split(), said

        # A uniform field is one number for all cells.
        same = write_case(work / "uniform", {**texts(tight), "T": "uniform 300"})
        code, said, error = compared("same", same, foam[1])
        assert code == 0 and said.splitlines()[1].split()[1:4] == ["1700", "/", "800"], said + error

        # What is missing or cut off ends in a line.
        bad = write_case(work / "cut", {**texts(tight), "OH": listed([1, 2, 3]).replace("3\n(", "4\n(")})
        for folder, word in ((bad, "3 values where 4 are announced"), (write_case(work / "start", texts(tight), ("0",)), "reconstructPar"),
                             (work / "nowhere", "there is no results.h5")):
            code, said, error = compared("bad", folder, foam[1])
            assert code == 2 and word in error and len(error.splitlines()) == 1, error
    print("compare_openfoam: fields, differences and messages as expected")


if __name__ == "__main__":
    main()
