"""A run whose chemistry cannot be solved ends on all ranks, with exit code 3, one message and a record that says so.

Usage: chemistry_failure_test.py EXECUTABLE RANKS MPIEXEC...
"""

import json
import pathlib
import re
import sys
import tempfile

import running

# More than double precision has.
TOO_MUCH = ("chemistry.relative_tolerance=1e-18", "chemistry.absolute_tolerance=1e-40")


def main(executable: str, ranks: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        result = program("run", deck, *running.settings(*TOO_MUCH), "--out", folder / "out", timeout=120)
        assert result.code == 3, f"exit code {result.code}, expected 3\n{result.out}{result.err}"
        lines = result.err.splitlines()
        assert len(lines) == 1, f"expected one line on standard error\n{result.err}"
        for part in (r"^lampblack: numerics: chemistry failed in cell [0-9]+ at \([-0-9.e]+, [-0-9.e]+\) m at time [-0-9.e]+ s",
                     r"T = [0-9.]+ K", r"p = 101325 Pa", r"mass fractions \{.*(N2|C2H4): [0-9.e-]+"):
            assert re.search(part, lines[0]), f"the message lacks {part}\n{result.err}"
        record = json.loads((folder / "out/run.json").read_text(encoding="utf-8"))
        assert record["status"] == "failed", record
        assert record["message"] and record["message"] in lines[0], record
        assert not (folder / "out/results.h5").exists(), "a failed run looks finished"
        assert (folder / "out/results.h5.part").exists(), "what there was is lost"
    print(f"{ranks} rank(s): {lines[0][:150]}...")


main(*sys.argv[1:])
