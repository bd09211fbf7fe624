"""Particle sizes along the trajectories: distributions at several times, and their mean and number over time."""

import numpy as np

from ..arrays import of_particles
from .style import plt

MOST_TRAJECTORIES = 6
MOST_CURVES = 7


def _distribution(axes, group):
    """dN/dlog10 d at times spread over those when there are particles. False where there never are any."""
    edges = group["bin_edges"][()] * 1e9
    density = group["size_distribution"][()] * 1e-6
    centres = np.sqrt(edges[:-1] * edges[1:])
    times = group["time"][()] * 1e3
    filled = np.flatnonzero(density.max(axis=1) > 0)
    if filled.size == 0 or density.shape[1] != centres.size:
        return False
    chosen = np.unique(filled[np.linspace(0, filled.size - 1, min(MOST_CURVES, filled.size)).astype(int)])
    for i in chosen:
        shown = np.where(density[i] > 0, density[i], np.nan)
        shade = plt.cm.viridis(i / max(len(times) - 1, 1))
        axes.loglog(centres, shown, color=shade, marker=".", markersize=3, label=f"{times[i]:.3g} ms")
    axes.set_xlabel("diameter, nm")
    axes.set_ylabel("dN/dlog$_{10}$d, 1/cm$^3$")
    axes.legend(fontsize=7, title="time", title_fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
    return True


def _path(axes, group):
    times = group["time"][()] * 1e3
    handles = []
    diameter = of_particles(group, "mean_diameter")
    if diameter is not None:
        handles += axes.plot(times, diameter[()] * 1e9, color="tab:blue", label="mean diameter, nm")
        axes.set_ylabel("mean diameter, nm", color="tab:blue")
    if "temperature" in group:
        other = axes.twinx()
        handles += other.plot(times, group["temperature"][()], color="tab:red", lw=1.0, label="T, K")
        other.set_ylabel("T, K", color="tab:red")
        other.spines["right"].set_visible(True)
    axes.set_xlabel("time along the path, ms")


def _start(group):
    if "position" not in group:
        return ""
    r, z = group["position"][0] * 1e3
    return f" from ({r:.3g}, {z:.3g}) mm"


def plot_sizes(results, pictures):
    usable = {}
    for name, group in results.trajectories().items():
        if {"time", "bin_edges", "size_distribution"} <= set(group) and group["time"].shape[0] > 0:
            usable[name] = group
        else:
            pictures.skip(f"sizes along trajectory {name}", "it holds no size distribution")
    if not usable:
        pictures.skip("size distributions", "the results hold no trajectories with sizes")
        return
    names = sorted(usable, key=lambda n: (not n.isdigit(), int(n) if n.isdigit() else 0, n))
    if len(names) > MOST_TRAJECTORIES:
        spread = np.linspace(0, len(names) - 1, MOST_TRAJECTORIES).astype(int)
        pictures.skip("some trajectories", f"{MOST_TRAJECTORIES} of {len(names)} are shown")
        names = [names[i] for i in spread]
    figure, panels = plt.subplots(len(names), 2, figsize=(10.5, 3.0 * len(names)), squeeze=False)
    for row, name in zip(panels, names):
        if not _distribution(row[0], usable[name]):
            row[0].text(0.5, 0.5, "no particles on this path", ha="center", transform=row[0].transAxes)
        _path(row[1], usable[name])
        row[0].set_title(f"trajectory {name}{_start(usable[name])}", loc="left", fontsize=10)
    pictures.save(figure, "size_distributions")
