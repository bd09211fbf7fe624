"""Pictures of an engine: pressure and temperature, heat, emissions, soot over the crank angle, and particles over equivalence ratio."""

import numpy as np

from .style import plt

MOST_SPECIES = 12  # in a picture


def plot_engine(results, pictures):
    columns = results.history()
    _plot_cycle(columns, pictures)
    _plot_species(columns, pictures)
    _plot_scatter(results.file.get("particles"), pictures)
    if "soot_along" in results.file:
        _plot_soot(results.file["soot_along"], pictures)


def _draw(axes, columns, names, factor=1.0):
    angle = np.asarray(columns["angle"])
    for name, text in names:
        mean = factor * np.asarray(columns[name])
        (line,) = axes.plot(angle, mean, label=text)
        if f"{name}_ci95" in columns:
            half = factor * np.asarray(columns[f"{name}_ci95"])
            axes.fill_between(angle, mean - half, mean + half, color=line.get_color(), alpha=0.25, lw=0)
    if len(names) > 1:
        axes.legend(fontsize=7)


def _plot_cycle(columns, pictures):
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 6.4), sharex=True)
    _draw(panels[0, 0], columns, (("pressure", ""),), 1e-5)
    panels[0, 0].set_ylabel("pressure, bar")
    _draw(panels[0, 1], columns, (("temperature", "mean"), ("temperature_10", "10 %"), ("temperature_90", "90 %")))
    panels[0, 1].set_ylabel("temperature, K")
    _draw(panels[1, 0], columns, (("heat_release", "by the reactions"), ("net_heat_release", "net, from the pressure")))
    panels[1, 0].set_ylabel("heat release, J/deg")
    _draw(panels[1, 1], columns, (("chemical_heat", "set free"), ("wall_heat", "to the walls"), ("work", "work")))
    panels[1, 1].set_ylabel("since the inlet closed, J")
    for axes in panels[1]:
        axes.set_xlabel("crank angle, deg")
    pictures.save(figure, "cycle")


def _plot_species(columns, pictures):
    names = [(name, name[2:]) for name in columns if name.startswith("X_") and not name.endswith(("_error", "_ci95", "_ci999"))]
    if not names:
        pictures.skip("emissions", "no species were written ('output.species')")
        return
    names = sorted(names, key=lambda one: -np.max(columns[one[0]]))[:MOST_SPECIES]
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    _draw(axes, columns, names, 1e6)
    axes.set_yscale("log")
    axes.set_ylim(bottom=1e-2)
    axes.set_xlabel("crank angle, deg")
    axes.set_ylabel("mole fraction, ppm")
    axes.legend(fontsize=7)
    pictures.save(figure, "emissions")


def _plot_scatter(group, pictures):
    if group is None or len(group["angle"]) == 0:
        pictures.skip("scatter", "no particles were written ('output.particles_at')")
        return
    angle, ratio, temperature, mass = (group[name][()] for name in ("angle", "equivalence_ratio", "temperature", "mass"))
    figure, axes = plt.subplots(figsize=(6.4, 4.8))
    for one in np.unique(angle):
        rows = angle == one
        axes.scatter(ratio[rows], temperature[rows], s=20 * mass[rows] / mass[rows].mean(), alpha=0.6, label=f"{one:g} deg")
    middle, half = 0.5 * (ratio.max() + ratio.min()), 0.5 * np.ptp(ratio)
    axes.set_xlim(middle - max(1.1 * half, 0.05), middle + max(1.1 * half, 0.05))  # alike particles are a line
    axes.set_xlabel("equivalence ratio")
    axes.set_ylabel("temperature, K")
    axes.legend(fontsize=7)
    pictures.save(figure, "scatter")


def _plot_soot(group, pictures):
    angle = group["angle"][()]
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 4.2), sharex=True)
    for axes, name, label, least in ((panels[0], "volume_fraction", "volume fraction of soot", 1e-10), (panels[1], "number_density", "particles of soot, 1/m³", 1e8)):
        for part, text in (("carried", "in the particles of gas"), ("along", "the same model along the mean gas"), ("population", "population along the mean gas")):
            if f"{part}_{name}" not in group:
                continue
            mean = group[f"{part}_{name}"][()]
            shown = mean > least
            (line,) = axes.plot(angle[shown], mean[shown], label=text)
            if f"{part}_{name}_error" in group:
                error = 2 * group[f"{part}_{name}_error"][()][shown]
                axes.fill_between(angle[shown], np.maximum(mean[shown] - error, least), mean[shown] + error, color=line.get_color(), alpha=0.25, lw=0)
        axes.set_yscale("log")
        axes.set_xlabel("crank angle, deg")
        axes.set_ylabel(label)
    panels[0].legend(fontsize=7)
    pictures.save(figure, "soot")
