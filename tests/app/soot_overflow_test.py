"""Soot that outgrows its sections: a failure that names the keys to raise, or, asked for, a number in the record.

Usage: soot_overflow_test.py EXECUTABLE MPIEXEC NUMPROC_FLAG
"""

import json
import pathlib
import sys
import tempfile

import running

DECK = f"""problem: flame1d
mechanism: {running.SOURCE}/cases/mechanisms/ethylene_abf2000_101.yaml
flame: {{type: burner, length: 10 mm, energy: given}}
inlet: {{temperature: 400 K, fuel: "C2H4: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 2.3, velocity: 8 cm/s}}
temperature_profile: {{position: [0 mm, 1 mm, 3 mm, 10 mm], temperature: [400 K, 1400 K, 1700 K, 1600 K]}}
particles: {{description: sectional, sectional: {{sections: 4, aggregation: spheres}}}}
grid: {{slope: 0.4, curve: 0.8}}
"""


def main(executable, *mpiexec):
    program = running.Program(executable, list(mpiexec), 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "deck.yaml"
        deck.write_text(DECK, encoding="utf-8")
        result = program("run", deck, "--out", folder / "few")
        assert result.code == 3, f"exit code {result.code}\n{result.out}{result.err}"
        assert "the sections of the soot end too early" in result.err, result.err
        assert "particles.sectional.sections" in result.err and "particles.sectional.factor" in result.err, result.err
        record = json.loads((folder / "few/run.json").read_text(encoding="utf-8"))
        assert record["status"] == "failed" and record["results"]["soot_in_last_section"] > 1e-3, record["results"]

        result = program("run", deck, "--out", folder / "counted",
                         *running.settings("particles.sectional.overflow=1", f"initial={folder}/few/results.h5.part"))
        assert result.code == 0, result.err
        record = json.loads((folder / "counted/run.json").read_text(encoding="utf-8"))
        assert record["status"] == "done" and record["results"]["soot_in_last_section"] > 1e-3, record["results"]
        assert "soot in last section" in result.out, result.out

        result = program("run", deck, "--out", folder / "enough",
                         *running.settings("particles.sectional.sections=12", "particles.sectional.factor=16"))
        assert result.code == 0, result.err
    print("ok")
    return 0


sys.exit(main(*sys.argv[1:]))
