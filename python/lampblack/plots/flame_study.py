"""Pictures of a study of one-dimensional flames: all of them on top of each other, and what changes over what is varied."""

import json

import numpy as np

from ..damage import reading
from .flame import APART, plot_together
from .flame_figures import plot_series
from ..flame_series import read_runs, series_of
from .style import plt, scaled_fraction
from ..study import read_table

# What is drawn over a varied number, where the runs have it.
SHOWN = [
    ("flame_speed_m_per_s", "flame speed, cm/s", 1e2),
    ("maximum_temperature_K", "largest temperature, K", 1.0),
    ("thermal_thickness_m", "thermal thickness, mm", 1e3),
    ("strain_global_per_s", "global strain rate, 1/s", 1.0),
    ("maximum_volume_fraction", "largest volume fraction", 1.0),
    ("maximum_number_density_per_m3", "largest number density, 1/cm$^3$", 1e-6),
]


def is_flame_study(folder):
    try:
        runs = json.loads(reading(folder / "study.json").read_text(encoding="utf-8"))["runs"]
        record = json.loads(reading(folder / runs[0]["run"] / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError, LookupError):
        return False
    return record.get("deck", {}).get("problem") == "flame1d"


def plot_flame_study(folder, pictures):
    rows = [row for row in read_table(folder / "study.csv") if row.get("status") == "done"]
    if not rows:
        pictures.skip("flames", "no run of the study has ended well")
        return
    with_files = [row for row in rows if (folder / row["run"] / "results.h5").is_file()]
    columns = list(rows[0])
    varied = columns[1:columns.index("status")]
    plot_together([folder / row["run"] for row in with_files], pictures, "flames",
                  varied[0].rsplit(".", 1)[-1].replace("_", " ") if len(varied) == 1 and varied[0] != "variant" else None)
    together = series_of(read_runs(folder, with_files))
    for series in together:
        plot_series(series, pictures)
    for key in varied:
        if key == "variant" and any(series.values[0] is not None for series in together):
            continue  # names of variants say less than the numbers behind them
        _plot_over(rows, key, [other for other in varied if other != key], pictures)


def leading_number(text):
    """The number in front of a unit: "20 cm/s" is 20. None where there is none."""
    try:
        return float(text.split()[0])
    except (ValueError, IndexError):
        return None


def _plot_over(rows, key, others, pictures):
    places = [leading_number(row[key]) for row in rows]
    names = list(dict.fromkeys(row[key] for row in rows))
    in_words = None in places
    if in_words:
        places = [names.index(row[key]) for row in rows]
    if len(set(places)) < 2:
        return
    shown = [item for item in SHOWN if any(row.get(item[0]) for row in rows)]
    figure, panels = plt.subplots(1, len(shown), figsize=(3.6 * len(shown), 4.4 if in_words else 3.4), squeeze=False)
    families = list(dict.fromkeys(tuple(row[other] for other in others) for row in rows))
    for axes, (name, label, factor) in zip(panels[0], shown):
        values = np.array([float(row[name]) for row in rows if row.get(name)])
        if name == "maximum_volume_fraction" and values.max() > 0:
            scaled, unit = scaled_fraction(values)
            factor, label = scaled.max() / values.max(), f"{label}{', ' + unit if unit else ''}"
        for family in families:
            points = sorted((place, float(row[name]) * factor) for place, row in zip(places, rows)
                            if tuple(row[other] for other in others) == family and row.get(name))
            axes.plot(*np.array(points).T.reshape(2, -1), "o" if in_words else "o-", ms=4, label=", ".join(family))
        if values.min() > 0 and values.max() > APART * values.min():
            axes.set_yscale("log")
        elif np.ptp(values) < 1e-3 * abs(values.max()):  # nothing to see in their last digits
            axes.set_ylim(factor * values.mean() * 0.99, factor * values.mean() * 1.01)
        axes.set_xlabel(key)
        if in_words:
            axes.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=8)
        axes.set_ylabel(label)
    if others:
        panels[0][0].legend(fontsize=7, title=", ".join(others), title_fontsize=7)
    pictures.save(figure, "over_" + key.rsplit(".", 1)[-1])
