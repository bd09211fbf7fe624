"""Pictures of a study: z-scores and errors of all its runs, and errors against the number of particles."""

import numpy as np

from ..study import read_table
from .style import plt

BOUND = 3.3  # 99.9 % of a normal distribution
MARKS = "osv^D<>ph*PX"


def number(row, name):
    text = row.get(name, "")
    return float(text) if text else np.nan


def plot_study(folder, pictures):
    rows = [row for row in read_table(folder / "study_table.csv") if "method" in row and "z_M0" in row]
    if rows:
        plot_scores(rows, pictures)
        plot_errors(rows, pictures)
    else:
        pictures.skip("scores", "no run of the study has a table of methods")
    plot_convergence(folder, pictures)


def by_method(rows):
    """Methods in order of appearance, and the runs likewise."""
    return list(dict.fromkeys(row["method"] for row in rows)), list(dict.fromkeys(row["run"] for row in rows))


def short(run):
    """chapter5_03_coagulation_exponential as 5.3, anything else as it is."""
    words = run.split("_")
    if len(words) > 1 and words[0].startswith("chapter") and words[1].isdigit():
        return f"{words[0][7:]}.{int(words[1])}"
    return run


def place_marks(axes, runs):
    axes.set_xticks(range(len(runs)), [short(run) for run in runs], fontsize=8, rotation=90 if len(runs[0]) > 40 else 0)
    axes.set_xlim(-0.6, len(runs) - 0.4)
    for place in range(len(runs) - 1):
        axes.axvline(place + 0.5, color="0.9", lw=0.6, zorder=0)


def plot_scores(rows, pictures):
    methods, runs = by_method(rows)
    figure, panels = plt.subplots(4, 1, figsize=(max(7.0, 0.5 * len(runs) + 2), 10), sharex=True)
    for k, axes in enumerate(panels):
        axes.axhspan(-BOUND, BOUND, color="0.93", zorder=0)
        for m, method in enumerate(methods):
            for known in (False, True):
                chosen = [row for row in rows if row["method"] == method and any(word in row.get("verdict", "") for word in ("expected", "known")) == known]
                x = [runs.index(row["run"]) + 0.7 * (m / max(1, len(methods) - 1) - 0.5) for row in chosen]
                z = np.array([number(row, f"z_M{k}") for row in chosen])
                axes.plot(x, z, ls="none", ms=4.5, marker=MARKS[m % len(MARKS)], color=f"C{m % 10}",
                          mfc="none" if known else f"C{m % 10}", label=None if known else method)
        axes.set_yscale("symlog", linthresh=5)
        reach = max(6.0, 1.2 * max((abs(number(row, f"z_M{k}")) for row in rows if row.get(f"z_M{k}")), default=0.0))
        axes.set_ylim(-reach, reach)
        ticks = [t for t in (3.3, 10, 100, 1000) if t < reach]
        axes.set_yticks([-t for t in ticks[::-1]] + [0] + ticks, [f"{t:g}" for t in [-t for t in ticks[::-1]] + [0] + ticks])
        axes.set_yticks([], minor=True)
        axes.set_ylabel(f"z of $M_{k}$")
        place_marks(axes, runs)
    panels[0].legend(fontsize=6, ncol=6, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    panels[-1].set_xlabel("case (open: the method is known to be biased there)")
    pictures.save(figure, "scores")


def plot_errors(rows, pictures):
    methods, runs = by_method(rows)
    figure, panels = plt.subplots(3, 1, figsize=(max(7.0, 0.5 * len(runs) + 2), 9), sharex=True)
    for axes, k in zip(panels, (0, 2, 3)):
        for m, method in enumerate(methods):
            chosen = [row for row in rows if row["method"] == method]
            x = [runs.index(row["run"]) + 0.7 * (m / max(1, len(methods) - 1) - 0.5) for row in chosen]
            sigma = 100 * np.array([number(row, f"sigma_M{k}") for row in chosen])
            axes.semilogy(x, np.where(sigma > 1e-9, sigma, np.nan), ls="none", ms=4.5, marker=MARKS[m % len(MARKS)],
                          color=f"C{m % 10}", label=method)
        axes.set_ylabel(rf"$\sigma_{{M_{k}}}$ at the end, %")
        place_marks(axes, runs)
    panels[0].legend(fontsize=6, ncol=6, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    panels[-1].set_xlabel("case")
    pictures.save(figure, "errors")


def plot_convergence(folder, pictures):
    points = read_table(folder / "convergence.csv")
    if not points:
        return
    slopes = {(row["method"], row["moment"]): row for row in read_table(folder / "convergence_slopes.csv")}
    methods = list(dict.fromkeys(row["method"] for row in points))
    shown = [k for k in range(4) if any(number(row, f"error_M{k}") > 1e-12 for row in points)]
    if not shown:
        pictures.skip("convergence", "nothing has an error")
        return
    figure, panels = plt.subplots(1, len(shown), figsize=(4.6 * len(shown), 4.4), squeeze=False)
    for axes, k in zip(panels[0], shown):
        for m, method in enumerate(methods):
            chosen = sorted((row for row in points if row["method"] == method), key=lambda row: number(row, "particles"))
            x = np.array([number(row, "particles") for row in chosen])
            error = np.array([number(row, f"error_M{k}") for row in chosen])
            limit = np.array([number(row, f"confidence_M{k}") for row in chosen])
            if not np.any(error > 1e-12):
                continue
            slope = slopes.get((method, f"M{k}"), {})
            text = f"{method}: slope {number(slope, 'error_slope'):.2f} ± {number(slope, 'error_slope_standard_error'):.2f}"
            axes.loglog(x, error, color=f"C{m}", marker=MARKS[m], ms=5, label=text)
            axes.loglog(x, limit, color=f"C{m}", lw=0.8, ls=":")
        x = np.array(sorted({number(row, "particles") for row in points}))
        largest = max(number(row, f"error_M{k}") for row in points)
        axes.loglog(x, largest * x[0] / x, color="black", lw=0.8, label="slope -1")
        axes.set_xlabel("numerical particles")
        axes.set_ylabel(f"mean relative error of $M_{k}$")
        axes.legend(fontsize=7)
    panels[0][0].set_title("dotted: 99.9 % confidence of the mean", fontsize=8, loc="left")
    pictures.save(figure, "convergence")
