"""Pictures of a population balance run: moments, their errors in time, size distributions, the self-preserving one."""

import numpy as np

from ..results import unit_of
from .style import plt

SECTIONS = ("sectional", "qmom", "momic")
# Geometric standard deviations of the diameter by number of self-preserving distributions of spheres.
SELF_PRESERVING = {"free_molecular": 1.46, "continuum": 1.44}
MARKS = "osv^D<>ph*PX"


class Method:
    """One method of the run: its tables as columns, and how it is drawn."""

    def __init__(self, name, group, number):
        kind = group.attrs.get("type", "")
        self.name = name
        self.kind = kind.decode("utf-8") if isinstance(kind, bytes) else str(kind)
        self.history = columns(group, "history")
        self.sigma = columns(group, "sigma")
        self.distribution = {key: item[()] for key, item in group.get("distribution", {}).items()}
        deterministic = self.kind in SECTIONS
        self.style = {"color": f"C{number % 10}", "lw": 1.4, "ls": "--" if deterministic or number >= 10 else "-"}
        self.mark = {"color": f"C{number % 10}", "marker": MARKS[number % len(MARKS)], "ms": 4, "ls": "none",
                     "mfc": "none"}
        self.label = name


def columns(group, name):
    return {key: item[()] for key, item in group.get(name, {}).items()}


def methods_of(results):
    group = results.file.get("methods", {})
    # In the order of the deck, where the record has it.
    order = list(results.record().get("deck", {}).get("methods", {}))
    names = [name for name in order if name in group] + [name for name in group if name not in order]
    return [Method(name, group[name], number) for number, name in enumerate(names)]


def plot_population(results, pictures):
    methods = methods_of(results)
    exact = columns(results.file, "exact/history")
    if not methods:
        pictures.skip("everything", "no method has results")
        return
    title = results.record().get("deck", {}).get("title", "")
    plot_moments(results, methods, exact, title, pictures)
    plot_sigma(methods, title, pictures)
    plot_distribution(results, methods, title, pictures)
    plot_self_preserving(results, methods, pictures)


def positive_log(axes, values):
    """A logarithmic axis where the values span more than a decade."""
    values = np.concatenate([np.ravel(v) for v in values]) if values else np.array([])
    values = values[np.isfinite(values) & (values > 0)]
    if len(values) and values.max() > 10 * values.min():
        axes.set_yscale("log")


def time_axis(results):
    """Whether the rows are spaced logarithmically."""
    return results.record().get("deck", {}).get("time", {}).get("spacing") == "logarithmic"


def plot_moments(results, methods, exact, title, pictures):
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 6.8), sharex=True)
    for k, axes in enumerate(panels.flat):
        name = f"M{k}"
        shown = []
        has_exact = name in exact and np.any(np.isfinite(exact[name]))
        if has_exact:
            axes.plot(exact["time"], exact[name], color="black", lw=1.0, label="exact")
            shown.append(exact[name])
        for number, method in enumerate(methods):
            history = method.history
            if name not in history or not len(history[name]):
                continue
            if has_exact:  # marks on the exact line, each method at times of its own
                step = max(1, len(history["time"]) // 10)
                pick = slice(1 + (number * step) // len(methods), None, step)
                axes.errorbar(history["time"][pick], history[name][pick], np.nan_to_num(history[name + "_error"][pick]),
                              **method.mark, elinewidth=0.8, label=method.label)
            else:
                axes.plot(history["time"], history[name], **method.style, label=method.label)
            shown.append(history[name])
        unit = next((unit_of(results.file[f"methods/{m.name}/history/{name}"]) for m in methods
                     if f"methods/{m.name}/history/{name}" in results.file), "")
        axes.set_ylabel(f"$M_{k}$" + (f", {unit}" if unit not in ("", "1") else ""))
        if k == 1 and shown:
            middle = np.nanmean(np.concatenate(shown))
            spread = max(np.nanmax(np.abs(np.concatenate(shown) / middle - 1)) if middle else 0, 1e-3)
            if spread < 0.3:
                axes.set_ylim(middle * (1 - 2 * spread), middle * (1 + 2 * spread))
                axes.ticklabel_format(axis="y", useOffset=False)
        positive_log(axes, shown)
        if time_axis(results):
            axes.set_xscale("log")
    for axes in panels[-1]:
        axes.set_xlabel("time, s")
    panels[0][0].legend(fontsize=7, ncol=2 if len(methods) > 6 else 1)
    figure.suptitle(title, fontsize=10)
    pictures.save(figure, "moments")


def plain_ticks(axes):
    """Numbers such as 0.5 rather than powers on a logarithmic axis of few decades."""
    low, high = axes.get_ylim()
    if 0 < low and high < 200 * low:
        for which in ("major", "minor"):
            getattr(axes.yaxis, f"set_{which}_formatter")(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "125" else "")


def plot_sigma(methods, title, pictures):
    with_sigma = [m for m in methods if any(np.any(np.isfinite(m.sigma.get(f"sigma_M{k}", np.array([])))) for k in range(4))]
    if not with_sigma:
        pictures.skip("errors", "no exact solution to compare with")
        return
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 6.8), sharex=True)
    for k, axes in enumerate(panels.flat):
        for method in with_sigma:
            sigma = 100 * method.sigma.get(f"sigma_M{k}", np.array([]))
            if not len(sigma):
                continue
            # What is exact to round-off cannot be told from zero on this axis.
            axes.semilogy(method.sigma["time"], np.where(sigma > 1e-6, sigma, np.nan), **method.style, label=method.label)
        axes.set_ylabel(rf"$\sigma_{{M_{k}}}$, %")
        plain_ticks(axes)
        if not axes.lines or not any(np.any(np.isfinite(line.get_ydata())) for line in axes.lines):
            axes.set_yticks([], minor=False)
            axes.set_yticks([], minor=True)
            axes.text(0.5, 0.5, "below 1e-6 %", ha="center", transform=axes.transAxes)
    for axes in panels[-1]:
        axes.set_xlabel("time, s")
    panels[0][0].legend(fontsize=7, ncol=2)
    figure.suptitle(title, fontsize=10)
    pictures.save(figure, "sigma")


def density(number, edges, logarithmic):
    """Number in bins to dN/d ln v or n(v), at the geometric or arithmetic middle of the bins."""
    if logarithmic:
        return np.sqrt(edges[1:] * edges[:-1]), number / np.log(edges[1:] / edges[:-1])
    return 0.5 * (edges[1:] + edges[:-1]), number / np.diff(edges)


def is_logarithmic(edges):
    return edges[0] > 0 and np.allclose(np.diff(np.log(edges)), np.log(edges[1] / edges[0]), rtol=1e-6)


def plot_distribution(results, methods, title, pictures):
    drawn = [m for m in methods if len(m.distribution.get("number", [])) and m.distribution["number"].size]
    if not drawn:
        pictures.skip("size distribution", "the deck has no section distribution, or no method has one")
        return
    exact = columns(results.file, "exact/distribution")
    edges = drawn[0].distribution["bin_edges"]
    times = drawn[0].distribution["time"]
    logarithmic = is_logarithmic(edges)
    count = len(times)
    width = min(count, 2)
    rows = -(-count // width)
    figure, panels = plt.subplots(rows, width, figsize=(5.4 * width, 4.0 * rows), squeeze=False, sharey=True)
    top = 0.0
    for t, axes in enumerate(panels.flat):
        if t >= count:
            axes.set_axis_off()
            continue
        largest = 0.0
        if len(exact.get("number", [])) > t and np.any(np.isfinite(exact["number"][t])):
            size, value = density(exact["number"][t], edges, logarithmic)
            axes.plot(size, np.where(value > 0, value, np.nan), color="black", lw=1.2, label="exact", zorder=5)
            largest = np.nanmax(value)
        for method in drawn:
            if t >= len(method.distribution["number"]):
                continue
            size, value = density(method.distribution["number"][t], method.distribution["bin_edges"], logarithmic)
            # The bins of a distribution with few sizes are mostly empty: what is there is drawn, not joined.
            sparse = np.count_nonzero(value > 0) < 0.7 * np.count_nonzero(value >= 0)
            options = dict(method.mark, ms=3) if not sparse or method.kind not in SECTIONS else dict(method.style)
            axes.plot(size, np.where(value > 0, value, np.nan), label=method.label, **options)
            largest = max(largest, np.nanmax(value, initial=0.0))
        axes.set_xscale("log")
        axes.set_yscale("log")
        top = max(top, largest)
        axes.set_title(f"t = {times[t]:g} s", fontsize=9)
        axes.set_xlabel("volume, m$^3$")
    if top > 0:
        panels.flat[0].set_ylim(1e-7 * top, 3 * top)
    for row in panels:
        row[0].set_ylabel("dN/d ln v, 1/m$^3$" if logarithmic else "n(v), 1/m$^6$")
    panels.flat[0].legend(fontsize=7, ncol=2 if len(drawn) > 6 else 1)
    figure.suptitle(title, fontsize=10)
    pictures.save(figure, "distribution")


def plot_self_preserving(results, methods, pictures):
    """psi = n M1 / M0^2 over eta = v M0 / M1 at the last time, and how the geometric standard deviation gets there."""
    processes = results.record().get("deck", {}).get("processes", {})
    kernel = processes.get("coagulation", {}).get("kernel") if list(processes) == ["coagulation"] else None
    if kernel not in SELF_PRESERVING:
        return
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4))
    for method in methods:
        history, distribution = method.history, method.distribution
        deviation = history.get("geometric_standard_deviation", np.array([]))
        if len(deviation) and np.any(np.isfinite(deviation)):
            right.semilogx(history["time"], deviation, **method.style, label=f"{method.label}: {deviation[-1]:.4f}")
        if not len(distribution.get("number", [])):
            continue
        edges, number = distribution["bin_edges"], distribution["number"][-1]
        middle = np.sqrt(edges[1:] * edges[:-1])
        psi = number / np.diff(edges) * history["M1"][-1] / history["M0"][-1] ** 2
        eta = middle * history["M0"][-1] / history["M1"][-1]
        options = method.style if method.kind in SECTIONS else dict(method.mark, ms=3.5)
        left.loglog(eta, np.where(psi > 0, psi, np.nan), label=method.label, **options)
    left.set_xlim(1e-3, 20)
    left.set_ylim(1e-5, 5)
    left.set_xlabel(r"$\eta = v\,M_0/M_1$")
    left.set_ylabel(r"$\psi = n\,M_1/M_0^2$")
    left.legend(fontsize=8)
    right.axhline(SELF_PRESERVING[kernel], color="black", lw=0.8, ls=":", label=f"literature: {SELF_PRESERVING[kernel]}")
    right.set_xlabel("time, s")
    right.set_ylabel("geometric standard deviation of the diameter")
    right.legend(fontsize=8)
    pictures.save(figure, "self_preserving")
