"""What the walls of a flow have taken of its particles: rate and what has gathered along each wall whose faces are in the results."""

import numpy as np

from .style import plt

MOST_TIMES = 5


def plot_walls(results, pictures):
    for name in results.file.get("deposits", {}):
        table = results.table(f"deposits/{name}")
        steps = np.unique(table["step"])
        if not np.any(table["deposited"] > 0):
            pictures.skip(f"deposit_{name}", "the wall has taken no particles")
            continue
        axes_names = [axis for axis in ("r", "x", "y", "z") if axis in table]
        along = max(axes_names, key=lambda axis: np.ptp(table[axis]))
        figure, panels = plt.subplots(2, 1, figsize=(5.5, 5.0), sharex=True)
        for step in steps[np.unique(np.linspace(0, len(steps) - 1, MOST_TIMES).round().astype(int))]:
            rows = np.flatnonzero(table["step"] == step)
            rows = rows[np.argsort(table[along][rows], kind="stable")]
            for panel, column in zip(panels, ("deposition", "deposited")):
                panel.plot(table[along][rows] * 1e3, table[column][rows], ".-" if len(rows) < 40 else "-",
                           label=f"{1e3 * table['time'][rows[0]]:.3g} ms")
        for panel, column in zip(panels, ("deposition", "deposited")):
            panel.set_ylabel(table[column].label)
            panel.set_ylim(bottom=0)
        panels[0].legend(fontsize=7)
        panels[1].set_xlabel(f"{along}, mm")
        figure.suptitle(f"particles on the wall {name}", fontsize=9)
        pictures.save(figure, f"deposit_{name}")
