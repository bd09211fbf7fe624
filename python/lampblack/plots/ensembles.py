"""Sizes of the particles of ensembles in the cells of a flow: over the plane, along the centreline and lines, of regions, as a
film, and averages over time with their intervals."""

import numpy as np
from matplotlib.colors import LogNorm

from .planes import draw
from .shapes import Shapes
from .style import plt, scaled_fraction, shown_time

DECADES = 5  # of the distributions that are shown, below the largest
MOST_FRAMES = 100
PLACES = 6  # whose distributions stand beside the plane
LABEL = "dN/dlog$_{10}$d, 1/cm$^3$"


def _between(places):
    """Ends of intervals around places that increase."""
    middle = 0.5 * (places[1:] + places[:-1])
    return np.concatenate([[2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]])


class _Sizes:
    """What the results hold of sizes; the step is named, the last one otherwise."""

    def __init__(self, results):
        self.results = results
        self.edges = results.file[f"{results.material}_sizes/bin_edges"][()] * 1e9  # nm
        self.centres = np.sqrt(self.edges[1:] * self.edges[:-1])

    def name(self):
        return f"{self.results.material}_size_distribution"

    def density(self, step=None, mean=False):
        """dN/dlog10 d in 1/cm^3, a row a cell, or nothing."""
        values = self.results.field(self.name() + ("_mean" if mean else ""), step)
        return None if values is None or values.shape[1:] != self.centres.shape else values * 1e-6

    def diameter(self, step=None):
        """Mean mobility diameter (nm) and geometric deviation; nan where there are next to no particles."""
        number = self.results.field(f"{self.results.material}_number_density", step)
        diameter = self.results.field(f"{self.results.material}_mobility_diameter", step)
        deviation = self.results.field(f"{self.results.material}_geometric_standard_deviation", step)
        there = number > 1e-4 * max(number.max(), 1e-300)
        return np.where(there, diameter * 1e9, np.nan), np.where(there, deviation, np.nan)


def _norm(largest):
    return LogNorm(largest * 10.0**-DECADES, largest)


def _along(axes, sizes, places, density, norm, label):
    """Diameter against place (mm), in colours the distribution."""
    order = np.argsort(places)
    shown = np.where(density[order] > norm.vmin, density[order], np.nan)
    drawn = axes.pcolormesh(_between(places[order]), sizes.edges, shown.T, norm=norm, cmap="viridis", shading="flat")
    axes.set_yscale("log")
    filled = np.flatnonzero(np.nanmax(density, axis=0, initial=0.0) > norm.vmin)
    if filled.size:
        axes.set_ylim(sizes.edges[filled[0]], sizes.edges[min(filled[-1] + 2, len(sizes.edges) - 1)])
    axes.set_xlabel(label)
    axes.set_ylabel("mobility diameter, nm")
    return drawn


def _plot_centreline(results, sizes, pictures):
    column, z = results.centreline()
    if len(column) < 2:
        pictures.skip("sizes along the centreline", "there is no column of cells along the axis")
        return
    named = [("at t = " + shown_time(results.time(results.steps[-1])), sizes.density())]
    if (mean := sizes.density(mean=True)) is not None:
        named.append(("mean over time", mean))
    largest = max(density[column].max() for _, density in named)
    if not largest > 0:
        pictures.skip("sizes along the centreline", "there are no particles")
        return
    figure, panels = plt.subplots(1, len(named), figsize=(1.0 + 5.0 * len(named), 4.2), sharey=True, squeeze=False)
    for axes, (title, density) in zip(panels[0], named):
        drawn = _along(axes, sizes, z * 1e3, density[column], _norm(largest), f"{results.axis_names()[1]}, mm")
        axes.set_title(f"Centreline, {title}", loc="left", fontsize=10)
    figure.colorbar(drawn, ax=panels[0], label=LABEL)
    pictures.save(figure, "sizes_centreline")


def _plot_lines(results, sizes, pictures):
    for name, table in results.file.get("lines", {}).items():
        columns = sorted(key for key in table if key.startswith(sizes.name() + "_") and key[len(sizes.name()) + 1:].isdigit())
        if len(columns) != len(sizes.centres):
            continue
        last = table["step"][()] == table["step"][-1]
        density = np.stack([table[column][()][last] for column in columns], axis=1) * 1e-6
        if not density.max() > 0:
            pictures.skip(f"sizes along the line {name}", "there are no particles")
            continue
        figure, axes = plt.subplots(figsize=(6.4, 4.2))
        drawn = _along(axes, sizes, table["distance"][()][last] * 1e3, density, _norm(density.max()), "distance, mm")
        axes.set_title(f"Line {name} at t = {shown_time(table['time'][-1])}", loc="left", fontsize=10)
        figure.colorbar(drawn, ax=axes, label=LABEL)
        pictures.save(figure, f"sizes_line_{name}")


def _spread(results, shapes, weights):
    """Cells far from each other, of those that count: the one of the largest weight first."""
    usable = shapes.cells[weights[shapes.cells] > 5e-2 * weights.max()]
    chosen = [usable[np.argmax(weights[usable])]]
    size = np.ptp(results.centres[usable, :2], axis=0)
    places = results.centres[usable, :2] / np.where(size > 0, size, 1)
    away = np.full(len(usable), np.inf)
    while len(chosen) < min(PLACES, len(usable)):
        away = np.minimum(away, np.linalg.norm(places - places[usable == chosen[-1]], axis=1))
        chosen.append(usable[np.argmax(away)])
    return sorted(chosen, key=lambda cell: tuple(results.centres[cell, 1::-1]))


def _plot_plane(results, sizes, shapes, pictures):
    """Maps of the mean diameter and the deviation; distributions at places, which the first map has the numbers of."""
    diameter, deviation = sizes.diameter()
    mean = sizes.density(mean=True)
    density = sizes.density() if mean is None else mean
    weights = density.sum(axis=1)
    if not np.any(np.isfinite(diameter[shapes.cells])) or not weights[shapes.cells].max() > 0:
        pictures.skip("sizes over the plane", "there are no particles")
        return
    figure = plt.figure(figsize=(13.0, 7.2))
    maps, multiples = figure.subfigures(1, 2, width_ratios=(1.25, 1.0))
    panels = maps.subplots(2, 1)
    limits = ((np.nanmin(diameter), np.nanmax(diameter)), (1.0, max(1.01, np.nanmax(deviation))))
    for axes, values, colours, limit, label in ((panels[0], diameter, "viridis", limits[0], "mean mobility diameter, nm"),
                                                (panels[1], deviation, "magma", limits[1], "geometric standard deviation")):
        drawn = draw(axes, results, shapes, values, colours, limit)
        maps.colorbar(drawn, ax=axes, label=label)
    panels[0].set_title(f"at t = {shown_time(results.time(results.steps[-1]))}", loc="left", fontsize=10)
    places = _spread(results, shapes, weights)
    grid = multiples.subplots((len(places) + 1) // 2, 2, sharex=True, sharey=True, squeeze=False)
    top = density[places].max()
    for number, (axes, cell) in enumerate(zip(grid.flat, places), 1):
        x, y = results.centres[cell, :2] * 1e3
        panels[0].annotate(str(number), (x, y), ha="center", va="center", fontsize=8, color="black",
                           bbox={"boxstyle": "circle,pad=0.15", "fc": "white", "ec": "black", "lw": 0.6})
        axes.loglog(sizes.centres, np.where(density[cell] > 0, density[cell], np.nan), color="tab:blue", marker=".", ms=3)
        axes.set_ylim(top * 10.0**-DECADES, 2 * top)
        across, along = results.axis_names()
        axes.set_title(f"{number}: {across} = {x:.3g}, {along} = {y:.3g} mm", loc="left", fontsize=9)
    for axes in list(grid.flat)[len(places):]:
        axes.set_axis_off()
    multiples.supxlabel("mobility diameter, nm", fontsize=10)
    multiples.supylabel(LABEL + ("" if mean is None else ", mean over time"), fontsize=10)
    pictures.save(figure, "sizes_plane")


def _film(results, sizes, shapes, pictures):
    """Mean diameter over the plane and distribution along the centreline, a frame an output."""
    column, z = results.centreline()
    steps = [step for step in results.steps if (density := sizes.density(step)) is not None and density.max() > 0]
    if len(steps) < 2 or len(column) < 2:
        pictures.skip("film of the sizes", "fewer than two outputs have particles")
        return
    if len(steps) > MOST_FRAMES:
        pictures.skip("some frames of the film", f"{MOST_FRAMES} of {len(steps)} outputs are shown")
        steps = [steps[i] for i in np.linspace(0, len(steps) - 1, MOST_FRAMES).astype(int)]
    diameters = [sizes.diameter(step)[0] for step in steps]
    top = max(np.nanmax(values) for values in diameters)
    largest = max(sizes.density(step)[column].max() for step in steps)
    if not largest > 0:
        pictures.skip("film of the sizes", "no output has particles on the centreline")
        return
    filled = np.flatnonzero(np.max([sizes.density(step)[column].max(axis=0) for step in steps], axis=0)
                            > largest * 10.0**-DECADES)
    figure, panels = plt.subplots(2, 1, figsize=(7.6, 7.6), height_ratios=(1.0, 1.0))
    bars = []

    def frame(i):
        for bar in bars:
            bar.remove()
        bars.clear()
        for axes in panels:
            axes.clear()
        drawn = draw(panels[0], results, shapes, diameters[i], "viridis", (0.0, top))
        bars.append(figure.colorbar(drawn, ax=panels[0], label="mean mobility diameter, nm"))
        panels[0].set_title(f"t = {shown_time(results.time(steps[i]))}", loc="left")
        drawn = _along(panels[1], sizes, z * 1e3, sizes.density(steps[i])[column], _norm(largest),
                       f"{results.axis_names()[1]} on the centreline, mm")
        panels[1].set_ylim(sizes.edges[filled[0]], sizes.edges[min(filled[-1] + 2, len(sizes.edges) - 1)])
        bars.append(figure.colorbar(drawn, ax=panels[1], label=LABEL))

    pictures.film(figure, "sizes", frame, len(steps))


def _joint(axes, group):
    """The last joint distribution of a region: colours are the number in a bin over its area. False where it is empty."""
    step = group["step"][()]
    if step.size == 0:
        return None
    last = step == step.max()
    low = [group[f"{name}_low"][()][last] for name in ("primary_diameter", "primaries")]
    high = [group[f"{name}_high"][()][last] for name in ("primary_diameter", "primaries")]
    low[0], high[0] = low[0] * 1e9, high[0] * 1e9
    area = np.log10(high[0] / low[0]) * np.log10(high[1] / low[1])
    values = group["number_density"][()][last] * 1e-6 / area
    norm = _norm(values.max())
    colours = plt.cm.viridis(norm(np.maximum(values, norm.vmin)))
    axes.bar(low[0], high[1] - low[1], width=high[0] - low[0], bottom=low[1], align="edge", color=colours)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(1.0, None)
    axes.set_xlabel("primary diameter, nm")
    axes.set_ylabel("primary particles")
    return plt.cm.ScalarMappable(norm, "viridis")


def _plot_regions(results, pictures):
    regions = results.file.get("regions", {})
    for name, group in regions.items():
        table = group["sizes"]
        steps, step = np.unique(table["step"][()]), table["step"][()]
        density = table["size_distribution"][()] * 1e-6
        filled = [s for s in steps if density[step == s].max() > 0]
        if not filled:
            pictures.skip(f"sizes of the region {name}", "there are no particles in it")
            continue
        figure, panels = plt.subplots(1, 2 if "joint" in group else 1, figsize=(11.0 if "joint" in group else 6.4, 4.2),
                                      squeeze=False)
        axes = panels[0][0]
        for i in np.unique(np.linspace(0, len(filled) - 1, 7).astype(int)):
            of = step == filled[i]
            centres = np.sqrt(table["diameter_low"][()][of] * table["diameter_high"][()][of]) * 1e9
            axes.loglog(centres, np.where(density[of] > 0, density[of], np.nan), marker=".", ms=3,
                        color=plt.cm.viridis(i / max(len(filled) - 1, 1)), label=shown_time(table["time"][()][of][0]))
        axes.set_ylim(density.max() * 10.0**-DECADES, 2 * density.max())
        axes.set_xlabel("mobility diameter, nm")
        axes.set_ylabel(LABEL)
        axes.legend(fontsize=7)
        axes.set_title(f"Region {name}", loc="left", fontsize=10)
        if "joint" in group and (colours := _joint(panels[0][1], group["joint"])) is not None:
            figure.colorbar(colours, ax=panels[0][1], label="d$^2$N/dlog$_{10}$d$_p$ dlog$_{10}$n$_p$, 1/cm$^3$")
            panels[0][1].set_title(f"at t = {shown_time(group['joint']['time'][-1])}", loc="left", fontsize=10)
        pictures.save(figure, f"sizes_region_{name}")


def _plot_averages(results, pictures):
    """Means over time along the centreline, with their intervals where there are enough blocks."""
    column, z = results.centreline()
    material = results.material
    if results.field(f"{material}_volume_fraction_mean") is None or len(column) < 2:
        return
    figure, panels = plt.subplots(3, 1, figsize=(6.6, 7.6), sharex=True)
    for axes, name, label, factor in ((panels[0], "volume_fraction", f"{material} volume fraction", None),
                                      (panels[1], "number_density", f"{material} number, 1/cm$^3$", 1e-6),
                                      (panels[2], "mobility_diameter", "mean mobility diameter, nm", 1e9)):
        mean, interval, now = (results.field(f"{material}_{name}{end}") for end in ("_mean", "_interval", ""))
        scaled, unit = scaled_fraction(mean) if factor is None else (mean * factor, "")
        factor = factor or (scaled.max() / mean.max() if mean.max() > 0 else 1.0)
        shown = results.field(f"{material}_number_density_mean")[column]
        shown = shown > 1e-4 * max(shown.max(), 1e-300)
        middle = np.where(shown, scaled[column], np.nan)
        axes.plot(z * 1e3, np.where(shown, now[column] * factor, np.nan), color="0.6", lw=0.8, label="last step")
        axes.plot(z * 1e3, middle, color="tab:red", label="mean over time")
        if interval is not None:
            half = interval[column] * factor
            axes.fill_between(z * 1e3, middle - half, middle + half, color="tab:red", alpha=0.25, lw=0, label="95 % interval")
        axes.set_ylabel(f"{label}, {unit}" if unit else label)
        axes.set_ylim(0.0, None)
    panels[0].legend(fontsize=8)
    panels[-1].set_xlabel(f"{results.axis_names()[1]}, mm")
    since = results.history().get(f"{material}_averages_since")
    if since is not None and np.isfinite(since[-1]):
        figure.suptitle(f"Centreline, averages from {shown_time(since[-1])} to {shown_time(results.time(results.steps[-1]))}")
    pictures.save(figure, f"{material}_averages")


def plot_ensembles(results, pictures):
    """Nothing, without a word, of flows without ensembles."""
    if f"{results.material}_sizes" not in results.file or not results.steps:
        return
    sizes = _Sizes(results)
    _plot_averages(results, pictures)
    _plot_regions(results, pictures)
    _plot_lines(results, sizes, pictures)
    if sizes.density() is None:
        pictures.skip("sizes of the ensembles", f"the results hold no field '{sizes.name()}'")
        return
    shapes = Shapes(results)
    _plot_centreline(results, sizes, pictures)
    _plot_plane(results, sizes, shapes, pictures)
    _film(results, sizes, shapes, pictures)
