"""Pictures of a reactor run, of each reactor of a network with ensembles: temperature and main species over time or place, the ignition, what it depends on."""

import numpy as np

from .sensitivities import plot_sensitivities
from .style import plt
from .tree_tables import plot_tree_tables

TIMES = (("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9))
MOST_SPECIES = 8


def plot_reactor(results, pictures):
    columns = results.history()
    if "temperature" in columns:
        delays = {name: time for name, time in results.ignition_delays().items() if np.isfinite(time)}
        if "position" in columns:
            factor, unit = unit_of(np.max(columns["position"]), (("m", 1.0), ("cm", 1e2), ("mm", 1e3)))
            _plot_history(columns, columns["position"] * factor, f"z, {unit}", {}, pictures)
            plot_particles(columns, columns["position"] * factor, f"z, {unit}", pictures)
        else:
            shown = 2.5 * max(delays.values()) if delays else np.max(columns["time"])
            factor, unit = unit_of(shown, TIMES)
            delays = {name: time * factor for name, time in delays.items()}
            _plot_history(columns, columns["time"] * factor, f"time, {unit}", delays, pictures)
            plot_particles(columns, columns["time"] * factor, f"time, {unit}", pictures)
            _plot_ignition(columns, columns["time"] * factor, f"time, {unit}", delays, pictures)
    elif "time" in columns:
        factor, unit = unit_of(np.max(columns["time"]), TIMES)
        for reactor in [name.removesuffix("_temperature") for name in columns if name.endswith("_temperature")]:
            own = {name.removeprefix(f"{reactor}_"): values for name, values in columns.items() if name.startswith(f"{reactor}_")}
            _plot_history(own, columns["time"] * factor, f"time, {unit}", {}, pictures, f"reactor_{reactor}")
            plot_particles(own, columns["time"] * factor, f"time, {unit}", pictures, f"particles_{reactor}")
    _plot_reactors(results, pictures)
    plot_sensitivities(results, pictures)
    plot_tree_tables(results, pictures)


def unit_of(largest, units):
    """Factor and name of the unit in which the largest value is at least one."""
    return next(((factor, name) for name, factor in units if largest * factor >= 1.0), units[-1][::-1])


def _main_species(columns):
    """The fractions that are largest and that change."""
    names = [name for name in columns if name.startswith(("X_", "Y_")) and not name.endswith(("_error", "_ci95", "_ci999"))]
    moving = [name for name in names if np.ptp(columns[name]) > 0.02 * np.max(np.abs(columns[name]), initial=1e-300)]
    return sorted(moving or names, key=lambda name: -np.max(columns[name]))[:MOST_SPECIES]


def _plot_history(columns, axis, label, delays, pictures, picture="reactor"):
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 6.4), sharex=True)
    above.plot(axis, columns["temperature"], color="tab:red")
    above.set_ylabel("temperature, K")
    for name in _main_species(columns):
        below.semilogy(axis, np.where(columns[name] > 0, columns[name], np.nan), label=name[2:])
    below.set_ylim(1e-6, 1.5)
    below.set_ylabel("mole fraction" if any(name.startswith("X_") for name in columns) else "mass fraction")
    below.set_xlabel(label)
    below.legend(fontsize=8, ncol=2)
    for value in delays.values():
        above.axvline(value, color="0.6", lw=0.6, ls=":")
        below.axvline(value, color="0.6", lw=0.6, ls=":")
    if delays:
        above.set_xlim(0, min(axis[-1], 2.5 * max(delays.values())))
    pictures.save(figure, picture)


def plot_particles(columns, axis, label, pictures, picture="particles"):
    """Volume fraction, number and mean diameter; of ensembles with the standard error of the repeats."""
    shown = [name for name in columns if name.endswith(("_volume_fraction", "_number_density", "_mean_diameter"))]
    if not shown:
        return
    figure, panels = plt.subplots(len(shown), 1, figsize=(6.4, 2.4 * len(shown)), sharex=True)
    units = {"fraction": ("volume fraction, ppm", 1e6), "density": ("number, 1/m$^3$", 1.0), "diameter": ("mean diameter, nm", 1e9)}
    for panel, name in zip(panels, shown, strict=True):
        title, factor = units[name.rsplit("_", 1)[1]]
        panel.plot(axis, factor * columns[name], color="black")
        if f"{name}_error" in columns:
            spread = 2 * factor * columns[f"{name}_error"]
            panel.fill_between(axis, factor * columns[name] - spread, factor * columns[name] + spread, color="0.8")
        panel.set_ylabel(title)
    panels[-1].set_xlabel(label)
    pictures.save(figure, picture)


def _plot_ignition(columns, axis, label, delays, pictures):
    """dT/dt and the marks of ignition, around the steepest rise."""
    if "max_dTdt" not in delays:
        return
    tau = delays["max_dTdt"]
    rate = columns["temperature_rate"]
    figure, axes = plt.subplots(figsize=(6.4, 4.0))
    axes.plot(axis, rate, color="black", marker=".", ms=3, lw=1.0)
    for colour, (name, value) in enumerate(delays.items()):
        axes.axvline(value, color=f"C{colour}", lw=1.2, label=f"{name}: {value:.5g} {label.split(', ')[1]}")
    # Where the rate is noticeable, and all marks.
    high = axis[rate > 0.01 * np.max(rate)]
    low, top = min(high.min(), *delays.values()), max(high.max(), *delays.values())
    margin = 0.1 * max(top - low, 0.01 * tau)
    axes.set_xlim(max(0.0, low - margin), top + margin)
    axes.set_ylabel("dT/dt, K/s")
    axes.set_xlabel(label)
    axes.legend(fontsize=8)
    pictures.save(figure, "ignition")


def _plot_reactors(results, pictures):
    """Temperature and main species of each reactor in a network."""
    table = results.reactors()
    if not table:
        return
    names, columns = table
    places = np.arange(len(names))
    figure, (above, below) = plt.subplots(2, 1, figsize=(2.4 + 0.9 * max(4, len(names)), 6.4), sharex=True)
    above.plot(places, columns["temperature"], "o-", color="tab:red")
    above.set_ylabel("temperature, K")
    species = sorted((name for name in columns if name.startswith(("X_", "Y_"))), key=lambda n: -np.max(columns[n]))
    pollutants = [name for name in species if name[2:] in ("NO", "CO", "OH")]
    for name in list(dict.fromkeys(species[:MOST_SPECIES] + pollutants)):
        below.semilogy(places, np.where(columns[name] > 0, columns[name], np.nan), "o-", ms=4, label=name[2:])
    below.set_ylim(1e-7, 1.5)
    below.set_ylabel("mole fraction" if any(name.startswith("X_") for name in columns) else "mass fraction")
    below.set_xticks(places, names, rotation=30, ha="right")
    below.legend(fontsize=8, ncol=3)
    pictures.save(figure, "reactors")
