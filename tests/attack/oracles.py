"""Whether the results of a finished run can be true: readable, finite, done, and with budgets that close."""

import json
import pathlib

import h5py
import numpy as np

# Documented to be NaN where something did not happen or is not known (docs/formats.md).
MAY_BE_NAN = ("/ignition/", "/sensitivity/", "exact", "error", "sigma", "/methods/", "/history/residual_")
NO_SIGNATURE = "file signature not found"
LARGEST_IMBALANCE = 1e-5


def faults_of_file(path: pathlib.Path) -> str:
    """What is wrong with a results file: "" where nothing is."""
    found = []

    def look(name: str, item) -> None:
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
            values = item[()]
            if np.any(np.isinf(values)):
                found.append(f"{name} has infinities")
            if np.any(np.isnan(values)) and not any(word in f"/{name}" for word in MAY_BE_NAN):
                found.append(f"{name} has NaN")
            if name.rpartition("/")[2] == "temperature" and values.size and not 50 < np.nanmin(values) <= np.nanmax(values) < 7000:
                found.append(f"{name} from {np.nanmin(values):.4g} to {np.nanmax(values):.4g} K")

    try:
        with h5py.File(path, "r") as file:
            file.visititems(look)
    except OSError as error:
        return f"{path.name} cannot be read: {error}"
    return "; ".join(found[:3])


def imbalances(record) -> list:
    """Numbers of run.json that say how far a budget is from closed."""
    found = []
    if isinstance(record, dict):
        for key, value in record.items():
            if isinstance(value, (int, float)) and ("imbalance" in key or "budget_error" in key):
                found.append((key, value))
            else:
                found += imbalances(value)
    return found


def faults_of_results(out: pathlib.Path) -> str:
    """What is wrong with the folder of a run or study that ended with exit 0."""
    if (out / "study.json").is_file():
        study = json.loads((out / "study.json").read_text(encoding="utf-8"))
        faults = [faults_of_results(out / run["run"]) for run in study["runs"]]
        return "; ".join(fault for fault in faults if fault)
    try:
        record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        return f"run.json: {error}"
    if record["status"] != "done":
        return f"run.json says {record['status']} after exit 0"
    for key, value in imbalances(record.get("results", {})):
        if not abs(value) < LARGEST_IMBALANCE:
            return f"{key} is {value}"
    left = [path.name for path in out.rglob("*") if path.name.endswith((".part", ".tmp"))]
    if left:
        return f"unfinished files: {', '.join(left)}"
    return faults_of_file(out / "results.h5")


def faults_of_remains(out: pathlib.Path, orderly: bool = True) -> str:
    """What is wrong with what a run has left that could not end: results that cannot be read, a record that says it is
    still running, files of a moment. After SIGKILL (not `orderly`) only finished files can be asked to be whole."""
    for record in out.rglob("run.json") if orderly else []:
        try:
            status = json.loads(record.read_text(encoding="utf-8"))["status"]
        except (ValueError, KeyError) as error:
            return f"{record.name} cannot be read: {error}"
        if status == "running":
            return "run.json says running"
    for path in out.rglob("*"):
        if orderly and path.suffix in (".tmp", ".lock"):
            return f"{path.name} is left"
        if path.name == "results.h5" or (orderly and path.name == "results.h5.part"):
            fault = faults_of_file(path)
            # Without a signature nothing was ever complete.
            if fault and not (path.suffix == ".part" and NO_SIGNATURE in fault):
                return fault
    return ""
