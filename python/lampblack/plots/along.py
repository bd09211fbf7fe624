"""Pictures of particles along a given gas: what there is of them over time, what they leave of species that they deplete, what
each process does, sizes at some times, trees as micrographs."""

import numpy as np

from .reactor import plot_particles, unit_of
from .style import plt
from .tree_tables import plot_tree_tables

MOST_TIMES = 6
RATES = (("nucleation", "inception"), ("condensation", "condensation"), ("growth", "surface growth"),
         ("oxidation_O2", "oxidation by O2"), ("oxidation_OH", "oxidation by OH"))


def plot_along(results, pictures):
    columns = results.history()
    factor, unit = unit_of(np.max(np.abs(columns["time"])), (("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)))
    axis, label = columns["time"] * factor, f"time, {unit}"
    plot_particles(columns, axis, label, pictures)
    _plot_depleted(columns, axis, label, pictures)
    _plot_rates(results, factor, label, pictures)
    _plot_sizes(results, axis, unit, pictures)
    plot_tree_tables(results, pictures)


def _plot_depleted(columns, axis, label, pictures):
    names = [name for name in columns if name.startswith("X_") and not name.endswith(("_error", "_ci95", "_ci999"))]
    if not names:
        return
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for name in names:
        axes.semilogy(axis, np.where(columns[name] > 0, columns[name], np.nan), label=name[2:])
    axes.set_ylim(bottom=1e-6 * max(np.max(columns[name]) for name in names))
    axes.set_xlabel(label)
    axes.set_ylabel("mole fraction that particles leave")
    axes.legend(fontsize=8)
    pictures.save(figure, "depleted")


def _plot_rates(results, factor, label, pictures):
    """Soot mass that each process gives or takes, of ensembles with the standard error."""
    rates = results.file.get("rates")
    if rates is None:
        return
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    middle = 0.5 * factor * (rates["from"][()] + rates["to"][()])
    for name, text in RATES:
        mean, error = rates[name][()], rates[f"{name}_error"][()]
        if not np.any(mean > 0):
            continue
        line, = axes.semilogy(middle, np.where(mean > 0, mean, np.nan), label=text)
        axes.fill_between(middle, np.where(mean > 2 * error, mean - 2 * error, np.nan), mean + 2 * error, color=line.get_color(),
                          alpha=0.3)
    axes.set_xlabel(label)
    axes.set_ylabel("soot mass by each process, kg/m$^3$/s")
    axes.legend(fontsize=8)
    pictures.save(figure, "rates")


def _plot_sizes(results, axis, unit, pictures):
    group = results.file.get("particles")
    if group is None:
        return
    diameter, sizes = 1e9 * group["diameter"][()], group["size_distribution"][()]
    filled = np.flatnonzero(np.any(sizes > 0, axis=1))
    if filled.size == 0:
        return
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for row in filled[np.unique(np.linspace(0, filled.size - 1, MOST_TIMES).astype(int))]:
        axes.loglog(diameter, np.where(sizes[row] > 0, sizes[row], np.nan), label=f"{axis[row]:.4g} {unit}")
    axes.set_xlabel("diameter, nm")
    axes.set_ylabel("dN/dlog$_{10}$d, 1/m$^3$")
    axes.legend(fontsize=8)
    pictures.save(figure, "sizes")
