#!/usr/bin/python3
"""Draws the pictures of runs and looks at what the runs left, two runs at a time, with the packages of python loaded once.

Usage: look_at_results.py FOLDER...
"""

import concurrent.futures
import multiprocessing
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/app"))
import running  # noqa: E402


def fault(folder: str) -> str:
    """What is wrong with a run; empty where nothing is."""
    for script in ("scripts/plot", ".ci/check_results.py"):
        done = running.script(ROOT / script, folder)
        if done.code != 0:
            return f"{script} {folder}: exit code {done.code}\n{done.out}{done.err}"
    pictures = pathlib.Path(folder, "pictures")
    wanted = "temperature.png" if pathlib.Path(folder, "results.xdmf").exists() else "*.png"
    return "" if any(pictures.glob(wanted)) else f"{pictures}: there is no picture {wanted}"


def main(*folders: str) -> int:
    running.load_plots()
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
        faults = [text for text in pool.map(fault, folders) if text]
    print(*faults, sep="\n")
    print(f"{len(folders) - len(faults)} of {len(folders)} runs have pictures and sound results")
    return 1 if faults else 0


sys.exit(main(*sys.argv[1:]))
