"""The history of a run: each column over simulated time, errors of budgets together on a logarithmic axis."""

import numpy as np

from .style import plt

MOST_PANELS = 8
# Shown first where there are more columns than panels.
FIRST = ("dt", "maximum_temperature", "peak_soot_volume_fraction", "peak_silica_volume_fraction", "minimum_mass_fraction", "imbalance_after")


def _is_error(name):
    return any(word in name.lower() for word in ("error", "residual", "drift"))


def _is_shown(name):
    return name not in ("time", "step", "steps") and not name.endswith(("_content", "_inflow", "_outflow", "_averages_since"))


def plot_history(results, pictures):
    columns = results.history()
    if "time" not in columns or len(columns["time"]) < 2:
        pictures.skip("history", "there is none, or it has fewer than two rows")
        return
    time = columns["time"] * 1e3
    errors = {name: column for name, column in columns.items() if _is_error(name)}
    others = [name for name in columns if name not in errors and _is_shown(name)]
    others.sort(key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST))
    shown = {name: columns[name] for name in others[:MOST_PANELS]}
    if len(others) > len(shown):
        pictures.skip("some columns of the history", f"{MOST_PANELS} of {len(others)} are shown")
    count = len(shown) + (1 if errors else 0)
    if count == 0:
        pictures.skip("history", "it has no columns besides the time")
        return
    width = 2 if count > 1 else 1
    rows = (count + width - 1) // width
    figure, panels = plt.subplots(rows, width, figsize=(4.8 * width, 2.3 * rows), squeeze=False, sharex=True)
    places = list(panels.flat)
    for axes, values in zip(places, shown.values()):
        axes.plot(time, values, color="tab:blue")
        axes.set_ylabel(values.label)
    if errors:
        axes = places[len(shown)]
        for name, values in errors.items():
            size = np.abs(values)
            axes.semilogy(time, np.where(size > 0, size, np.nan), label=name, lw=1.0)
        axes.set_ylabel("errors, absolute")
        axes.legend(fontsize=7)
    for axes in places[count:]:
        axes.set_axis_off()
    for axes in panels[-1]:
        axes.set_xlabel("time, ms")
    pictures.save(figure, "history")
