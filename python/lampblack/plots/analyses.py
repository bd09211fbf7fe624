"""Pictures of an analysis: runs beside measurements, profiles, the objective, pairs of parameters, indices, bands, fronts."""

import h5py
import numpy as np

from ..analysis.folder import Analysis
from .style import plt

MOST = 8  # panels of a picture


def plot_analysis(folder, pictures):
    analysis = Analysis(folder)
    for name, plot in (("residuals", plot_parity), ("residuals", plot_places), ("objective", plot_objective), ("sensitivity", plot_indices),
                       ("bands", plot_bands), ("front", plot_front), ("points", plot_pairs)):
        if analysis.has(name):
            plot(analysis, pictures)


def _panels(count, height=3.4):
    columns = min(3, count)
    figure, axes = plt.subplots(-(-count // columns), columns, figsize=(4.2 * columns, height * -(-count // columns)), squeeze=False)
    for spare in axes.flat[count:]:
        spare.set_axis_off()
    return figure, axes.flat


def _is_log(*values):
    values = np.concatenate([np.ravel(np.asarray(v, float)) for v in values])
    values = values[np.isfinite(values)]
    return len(values) > 0 and values.min() > 0 and values.max() > 20 * values.min()


def _words(column):
    return list(dict.fromkeys(map(str, column)))


def plot_parity(analysis, pictures):
    """Runs over measurements, at the start and at the best point."""
    table = analysis.table("residuals")
    quantities = _words(table["quantity"])[:MOST]
    figure, panels = _panels(len(quantities))
    for axes, quantity in zip(panels, quantities):
        here = table["quantity"] == quantity
        measured, best, start = (np.asarray(table[name], float)[here] for name in ("measured", "best", "start"))
        for k, deck in enumerate(_words(table["deck"][here])):
            one = table["deck"][here] == deck
            kept_out = table["use"][here][one][0] == "validate"
            axes.plot(measured[one], start[one], ls="none", marker="x", ms=4, color=f"C{k % 10}", alpha=0.5)
            axes.plot(measured[one], best[one], ls="none", marker="o", ms=4.5, color=f"C{k % 10}", mfc="none" if kept_out else f"C{k % 10}",
                      label=deck + (", kept out" if kept_out else ""))
        ends = [np.nanmin([measured, best]), np.nanmax([measured, best])]
        axes.plot(ends, ends, color="black", lw=0.8)
        if _is_log(measured, best, start):
            axes.set_xscale("log")
            axes.set_yscale("log")
        axes.set_xlabel(f"{quantity}, measured")
        axes.set_ylabel("run: best (dots), start (crosses)")
        axes.legend(fontsize=7)
    pictures.save(figure, "parity")


def plot_places(analysis, pictures):
    """Measurements along their abscissa with their errors, and the runs at the start and at the best point."""
    table = analysis.table("residuals")
    place = np.asarray(table["abscissa"], float) if table["abscissa"].dtype.kind == "f" else np.full(table.rows, np.nan)
    groups = [(d, q) for d in _words(table["deck"]) for q in _words(table["quantity"])
              if np.sum((table["deck"] == d) & (table["quantity"] == q) & np.isfinite(place)) > 1][:MOST]
    if not groups:
        pictures.skip("profiles", "no measurements have an abscissa")
        return
    figure, panels = _panels(len(groups))
    for axes, (deck, quantity) in zip(panels, groups):
        here = np.flatnonzero((table["deck"] == deck) & (table["quantity"] == quantity))
        here = here[np.argsort(place[here])]
        measured, error, start, best = (np.asarray(table[name], float)[here] for name in ("measured", "error", "start", "best"))
        axes.errorbar(place[here], measured, error, fmt="ko", ms=4, capsize=2, label="measured")
        axes.plot(place[here], start, color="0.6", ls="--", label="start")
        axes.plot(place[here], best, color="C3", label="best")
        if _is_log(measured, best, start):
            axes.set_yscale("log")
        axes.locator_params(axis="x", nbins=5)
        axes.set_xlabel("abscissa, SI unit")
        axes.set_ylabel(quantity)
        axes.set_title(deck, fontsize=9, loc="left")
        axes.legend(fontsize=7)
    pictures.save(figure, "profiles")


def plot_objective(analysis, pictures):
    table = analysis.table("objective")
    names = _words(table["parameter"])[:MOST]
    figure, panels = _panels(len(names), 2.8)
    for axes, name in zip(panels, names):
        here = table["parameter"] == name
        value, phi = np.asarray(table["value"], float)[here], np.asarray(table["phi"], float)[here]
        axes.plot(value, phi, color="black")
        axes.axhline(phi.min() + 3.84, color="0.6", lw=0.8, label="95 %")
        axes.legend(fontsize=7)
        axes.set_ylim(phi.min() - 1, min(phi.max(), phi.min() + 40) + 1)
        if _is_log(value):
            axes.set_xscale("log")
        axes.set_xlabel(name)
        axes.set_ylabel("objective, others at their best")
    pictures.save(figure, "objective")


def plot_indices(analysis, pictures):
    table = analysis.table("sensitivity")
    columns = next(names for names in (("S", "S_T"), ("mu_star", "sigma"), ("d_ln_output_d_ln_parameter",)) if names[0] in table)
    outputs = _words(table["output"])[:MOST]
    figure, panels = _panels(len(outputs))
    for axes, output in zip(panels, outputs):
        here = table["output"] == output
        names = list(map(str, table["parameter"][here]))
        for k, column in enumerate(columns):
            values = np.asarray(table[column], float)[here]
            at = np.arange(len(names)) + 0.4 * (k - 0.5 * (len(columns) - 1))
            low = f"{column}_low"
            bars = None if low not in table else np.abs([values - np.asarray(table[low], float)[here], np.asarray(table[f"{column}_high"], float)[here] - values])
            axes.barh(at, values, 0.38, xerr=bars, color=f"C{k}", label=column)
        axes.set_yticks(range(len(names)), names)
        axes.invert_yaxis()
        axes.set_title(output, fontsize=9, loc="left")
        axes.legend(fontsize=7)
    pictures.save(figure, "indices")


def plot_bands(analysis, pictures):
    """Intervals of 95 and 68 % of every quantity, along its places where it has some."""
    table = analysis.table("bands")
    place = np.asarray(table["abscissa"], float) if table["abscissa"].dtype.kind == "f" else np.full(table.rows, np.nan)
    groups = [(d, q) for d in _words(table["deck"]) for q in _words(table["quantity"])][:MOST]
    figure, panels = _panels(len(groups))
    for axes, (deck, quantity) in zip(panels, groups):
        every = (table["deck"] == deck) & (table["quantity"] == quantity)
        here = np.flatnonzero(every & np.isfinite(place))
        along = len(here) > 1
        here = here[np.argsort(place[here])] if along else np.flatnonzero(every & ~np.isfinite(place))
        x = place[here] if along else np.arange(len(here))
        q = [np.asarray(table[name], float)[here] for name in ("q2.5", "q16", "q50", "q84", "q97.5")]
        if along:
            axes.fill_between(x, q[0], q[4], color="C0", alpha=0.2, label="95 %")
            axes.fill_between(x, q[1], q[3], color="C0", alpha=0.35, label="68 %")
            axes.plot(x, q[2], color="C0")
            measured = np.asarray(table["measured"], float)[here] if table["measured"].dtype.kind == "f" else np.full(len(here), np.nan)
            if np.any(np.isfinite(measured)):
                axes.errorbar(x, measured, np.asarray(table["error"], float)[here], fmt="ko", ms=4, capsize=2, label="measured")
            axes.set_xlabel("abscissa, SI unit")
            axes.legend(fontsize=7)
        else:
            axes.errorbar(x, q[2], [q[2] - q[0], q[4] - q[2]], fmt="o", color="C0", capsize=4)
            axes.set_xticks([])
        if _is_log(*q):
            axes.set_yscale("log")
        axes.set_ylabel(quantity)
        axes.set_title(deck, fontsize=9, loc="left")
    pictures.save(figure, "bands")


def plot_front(analysis, pictures):
    table = analysis.table("front")
    first, second = analysis.record["objectives"]
    figure, axes = plt.subplots(figsize=(5.2, 4))
    axes.plot(table[first + "_surrogate"], table[second + "_surrogate"], color="0.6", label="surrogates")
    axes.errorbar(table[first], table[second], np.asarray(table[second + "_noise"]), np.asarray(table[first + "_noise"]), fmt="ko", ms=5, label="true runs")
    axes.set_xlabel(first)
    axes.set_ylabel(second)
    axes.legend(fontsize=8)
    pictures.save(figure, "front")


def plot_pairs(analysis, pictures):
    """The posterior where there is one, else the points of the design, coloured by what came out; the best point."""
    names = [p["name"] for p in analysis.record["options"]["parameters"]]
    logs = [p["scale"] == "log" for p in analysis.record["options"]["parameters"]]
    path = analysis.folder / "posterior.h5"
    points = analysis.table("points")
    if len(names) < 2:
        pictures.skip("pairs", "there is one parameter")
        return
    colours = [name for name in list(points)[len(names):] if name not in ("status", "message")]  # numbers, behind all parameters
    names, logs = names[:6], logs[:6]
    samples = None
    if path.is_file():
        with h5py.File(path) as file:
            samples = [file[name][()] for name in names if name in file]
    colour = np.asarray(points["phi"], float) if "phi" in points else np.asarray(points[colours[0]])
    colour = np.log10(colour) if colour.dtype.kind == "f" and _is_log(colour[np.isfinite(colour)]) else colour
    size = len(names) - 1
    figure, panels = plt.subplots(size, size, figsize=(3.2 * size + 0.8, 3 * size), squeeze=False)
    best = analysis.record.get("best")
    for row in range(size):
        for column in range(size):
            axes = panels[row][column]
            if column > row:
                axes.set_axis_off()
                continue
            i, k = column, row + 1
            axes.scatter(points[names[i]], points[names[k]], c=colour if colour.dtype.kind == "f" else "0.5", s=12, cmap="viridis")
            if samples is not None and len(samples) == len(names):
                every = max(1, len(samples[i]) // 3000)
                axes.plot(samples[i][::every], samples[k][::every], ls="none", marker=".", ms=1.5, color="C3", alpha=0.4)
            if best:
                axes.plot(best[names[i]], best[names[k]], marker="+", ms=12, color="black")
            axes.set_xscale("log" if logs[i] else "linear")
            axes.set_yscale("log" if logs[k] else "linear")
            axes.set_xlabel(names[i])
            axes.set_ylabel(names[k])
    pictures.save(figure, "pairs")
