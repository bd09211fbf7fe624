"""Lampblack's trees of silica against the independent calculation of the same case: every mean at two times.

Arguments: the program, the independent program.
"""
import csv
import io
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))

import running  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
NUMBER = 1024
PAIRS = {"number_density": "number", "volume_fraction": "Fv", "collision_diameter": "d_c", "sphere_diameter": "d_sph",
         "primaries": "primaries", "primary_diameter": "d_p", "sintering_level": "level", "O": "O", "OH": "OH"}
TIMES = (0.045, 0.2)
# Of 18 differences of means with errors of 16 repeats each: above 4.5 once in some thousand tries.
MOST = 4.5


def rows(text: str) -> list:
    return [{name.split(" [")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(text))]


def at(table: list, time: float) -> dict:
    return next(row for row in table if abs(row["time"] - time) < 1e-9)


def main(executable, independent):
    program = running.Program(executable, [], 1)
    done = subprocess.run([independent, f"gas={HERE / 'silica_5ppm_gas.csv'}", f"particles={NUMBER}", "seeds=16", "end=0.21"],
                          capture_output=True, text=True, check=True)
    law = rows(done.stdout)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        options = running.settings("particles.sintering.inner_parts=sphere", f"particles.number={NUMBER}", "particles.repeats=16",
                                   "time.end=0.2 s", "output.interval=5 ms")
        result = program("run", running.SOURCE / "cases/reactor/silica_batch/deck.yaml", *options, "--out", out, timeout=300)
        assert result.code == 0, result.err
        ours = rows((out / "history.csv").read_text(encoding="utf-8"))
    failures = 0
    for time in TIMES:
        here, there = at(ours, time), at(law, time)
        for name, other in PAIRS.items():
            ours_name = f"silica_{name}"
            error = math.hypot(here[f"{ours_name}_error"], there[f"{other}_error"])
            z = (here[ours_name] - there[other]) / error
            print(f"{time} s {name}: {here[ours_name]:.5g}, {there[other]:.5g}, z {z:.1f}")
            failures += abs(z) > MOST
    sys.exit(f"{failures} means differ" if failures else 0)


main(*sys.argv[1:])
