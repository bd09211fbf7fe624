"""Pictures of what was followed from a one-dimensional flame: the branch over the strain, the flame in time."""

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from .style import plt, scaled_fraction


def plot_branch(results, pictures):
    group = results.file.get("continuation")
    if group is None or group["load"].shape[0] < 2:
        return
    load, temperature = group["load"][()], group["maximum_temperature"][()]
    strain = group["strain_rate"][()]
    named = np.all(np.isfinite(strain))
    figure, axes = plt.subplots(figsize=(6.0, 4.2))
    axes.semilogx(strain if named else load, temperature, "k.-", ms=5, lw=1.0)
    turns = group["turning_points"]
    for at, highest, point in zip(turns["strain_rate" if named else "load"][()], turns["highest"][()], turns["point"][()]):
        word = "extinction" if highest else "turns again"  # ignition, or a flame as thick as the space for it
        axes.plot(at, temperature[int(point)], "o", color="tab:red" if highest else "tab:blue",
                  label=f"{word}: {at:.4g}{' 1/s' if named else ''}")
    axes.set_xlabel("strain rate, 1/s" if named else "factor on the strain")
    axes.set_ylabel("largest temperature, K")
    if named and strain.max() < 30 * strain.min():  # too few powers of ten for ticks
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())
    if len(turns["load"]):
        axes.legend(fontsize=9)
    pictures.save(figure, "branch")


def plot_course(results, pictures):
    group = results.file.get("unsteady")
    if group is None or group["time"].shape[0] < 2:
        return
    time, z = group["time"][()] * 1e3, group["z"][()] * 1e3
    history = results.history()
    with_soot = "soot_volume_fraction" in group
    figure, panels = plt.subplots(3 if with_soot else 2, 1, figsize=(7.0, 8.4 if with_soot else 6.0), sharex=True)
    panels[0].plot(time, history["maximum_temperature"][: len(time)], color="tab:red")
    panels[0].set_ylabel("largest temperature, K", color="tab:red")
    other = panels[0].twinx()
    other.spines["right"].set_visible(True)
    other.plot(time, history["load"][: len(time)], color="black", lw=0.9)
    other.set_ylabel("factor on the strain")
    drawn = [("temperature", "inferno", "temperature, K", 1.0)]
    if with_soot:
        largest = group["soot_volume_fraction"][()].max(initial=1e-12)
        scaled, unit = scaled_fraction(np.array([largest]))
        drawn.append(("soot_volume_fraction", "viridis", f"volume fraction{', ' + unit if unit else ''}", scaled[0] / largest))
    for axes, (name, colours, label, factor) in zip(panels[1:], drawn):
        shades = axes.pcolormesh(time, z, group[name][()].T * factor, cmap=colours, shading="nearest")
        figure.colorbar(shades, cax=axes.inset_axes([1.02, 0, 0.03, 1]), label=label)
        axes.set_ylabel("z, mm")
    panels[-1].set_xlabel("time, ms")
    pictures.save(figure, "in_time")
