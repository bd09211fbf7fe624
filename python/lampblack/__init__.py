"""Lampblack from Python: results as arrays with units, runs, sweeps and analyses of the program, pictures (`lampblack.plots`).

    import lampblack
    flame = lampblack.run("free_methane/deck.yaml", set={"inlet.equivalence_ratio": 0.8}, out="results/lean")
    flame.profile()["temperature"].max(), flame.profile()["temperature"].unit
    lampblack.open("results/lean").history().to_pandas()

Needs numpy and h5py. pandas and xarray are used where they are asked for, matplotlib where pictures are made, scipy where an analysis runs.
"""

import importlib

_PLACES = {
    "open": "opening", "Results": "results", "Study": "study", "Array": "arrays", "Table": "arrays",
    "Distribution": "distributions", "run": "program", "check": "program", "sweep": "program", "analyse": "program", "Analysis": "analysis.folder",
    "LampblackError": "errors", "InputError": "errors", "NumericsError": "errors", "MachineError": "errors", "Stopped": "errors",
    "ProgramBug": "errors", "ResultsError": "errors",
}  # fmt: skip
__all__ = [name for name in _PLACES if name != "open"]  # `from lampblack import *` leaves Python's open


def __getattr__(name):
    """What is asked for is imported then: errors and scripts work without h5py."""
    if name not in _PLACES:
        raise AttributeError(f"module 'lampblack' has no attribute '{name}'")
    return getattr(importlib.import_module(f".{_PLACES[name]}", __name__), name)


def __dir__():
    return sorted([*globals(), *_PLACES])
