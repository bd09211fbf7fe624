"""Pictures of aggregates of spheres: their shape as they grow or in time, and micrographs, spheres shaded by their depth."""

import numpy as np

from .micrographs import scale_bar, shade_by_depth
from .reactor import TIMES, unit_of
from .style import plt

MOST_DRAWN = 12


def plot_spheres(results, pictures):
    _plot_history(results.history(), pictures)
    _plot_micrographs(results.file.get("aggregates/spheres"), pictures)


def _plot_history(columns, pictures):
    time = np.asarray(columns["time"])
    is_timed = time[-1] > 0 and np.sum(time > 0) > 1
    if is_timed:
        factor, unit = unit_of(time[-1], TIMES)
        rows, x, label = time > 0, factor * time, f"time, {unit}"
    else:
        x, label = np.asarray(columns["spheres"]), "spheres of an aggregate"
        rows = x > 1
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 6.4), sharex=True)
    groups = (
        ("length, nm", 1e9, (("gyration", "radius of gyration"), ("radius", "radius of a sphere"), ("mobility_diameter", "diameter of mobility"))),
        ("fractal law", 1, (("fractal_dimension", "dimension"), ("fractal_prefactor", "prefactor"))) if np.any(np.isfinite(columns["fractal_dimension"][rows]))
        else ("surface of a particle, nm$^2$", 1e18, (("surface", ""),)),
        ("spheres of a particle", 1, (("spheres", "mean"), ("largest", "largest"))),
        ("radius of necks over radius", 1, (("neck_ratio", ""),)) if is_timed and np.nanmax(columns["neck_ratio"]) > 0
        else ("lines drawn for a collision", 1, (("lines", ""),)),
    )
    for axes, (title, factor_y, names) in zip(panels.flat, groups, strict=True):
        for name, text in names:
            mean, error = (factor_y * np.asarray(columns[n])[rows] for n in (name, f"{name}_error"))
            (line,) = axes.plot(x[rows], mean, ".-", label=text)
            axes.fill_between(x[rows], mean - 2 * error, mean + 2 * error, color=line.get_color(), alpha=0.25, lw=0)
        axes.set_ylabel(title)
        if len(names) > 1:
            axes.legend(fontsize=7)
    panels[0, 0].set_yscale("log")
    panels[1, 0].set_yscale("log")
    for axes in panels.flat:
        axes.set_xscale("log")
    for axes in panels[1]:
        axes.set_xlabel(label)
    pictures.save(figure, "history")


def _plot_micrographs(group, pictures):
    if group is None or len(group["radius"]) == 0:
        pictures.skip("micrographs", "no spheres were written ('output.aggregates')")
        return
    number = group["aggregate"][()].astype(int)
    places = 1e9 * np.stack([group[axis][()] for axis in "xyz"], axis=1)
    radius = 1e9 * group["radius"][()]
    count = min(number.max() + 1, MOST_DRAWN)
    if number.max() + 1 > count:
        pictures.skip("some aggregates", f"{count} of {number.max() + 1} are drawn")
    width = min(4, count)
    rows = -(-count // width)
    figure, panels = plt.subplots(rows, width, figsize=(2.7 * width, 2.7 * rows), squeeze=False, sharex=True, sharey=True)
    for axes in panels.flat:
        axes.set_axis_off()
        axes.set_aspect("equal")
    half = 1.1 * max(float((np.abs(places[:, :2]) + radius[:, None]).max()), 1e-3)
    deepest = max(float(np.abs(places[:, 2]).max()), 1e-3)
    for k in range(count):
        axes, mine = panels.flat[k], np.flatnonzero(number == k)
        shade_by_depth(axes, places[mine], radius[mine], deepest, half)
        axes.set_title(f"{len(mine)} sphere{'' if len(mine) == 1 else 's'}", fontsize=8)
    panels[0, 0].set_xlim(0, 2 * half)
    panels[0, 0].set_ylim(0, 2 * half)
    scale_bar(panels[0, 0], 2 * half)
    figure.suptitle("aggregates at the end on one scale; brighter spheres are nearer", fontsize=10)
    pictures.save(figure, "micrographs")
