#!/usr/bin/python3
"""What one changed line costs: for each module the seconds from a line added to a source of it until everything is built again,
and until the fast tests of the module are through. The compiler's cache is off; sources are left as they were.

Usage: tests/bench/change_to_verdict.py BUILD [SOURCE...]      (an up-to-date build; by default a source a module)
"""

import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ("core/least_squares.cpp", "chemistry/mechanism/rate_reader.cpp", "chemistry/kinetics/batch_kinetics.cpp",
           "particles/trees/tree_sintering.cpp", "particles/stochastic/particle_rows.hpp", "flow/boundaries/gas_variation.cpp",
           "coupling/block_statistics.cpp", "io/gmsh_stream.cpp", "app/problems/flow/flow_case.cpp")


def seconds(*command: str) -> float:
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, env=dict(os.environ, CCACHE_DISABLE="1"), check=False)
    if done.returncode != 0:
        sys.exit(done.stdout[-3000:] + done.stderr[-1000:])
    return time.monotonic() - begin


def main(build: str, *sources: str) -> None:
    def made() -> float:
        return seconds("ninja", "-C", build, "-j2")

    made()
    print("| changed | build s | tests s |\n|---|---|---|")
    for name in sources or SOURCES:
        source = ROOT / name
        text = source.read_bytes()
        try:
            source.write_bytes(text + b"\n// One more line.\n")
            building = made()
            tests = pathlib.Path(build) / "tests" / pathlib.Path(name).parts[0]
            testing = seconds("ctest", "--test-dir", str(tests), "-LE", "^long$", "-j2")
        finally:
            source.write_bytes(text)
        print(f"| `{name}` | {building:.0f} | {testing:.0f} |", flush=True)
    made()


if __name__ == "__main__":
    main(*sys.argv[1:])
