"""Pictures of a series of sooting flames: gas, soot, rates and particles over z, and their peaks over what is varied."""

import numpy as np

from .flame import APART, FlameData, plot_gas
from .flame_peaks import peak, shape
from ..results import Results
from .style import plt, scaled_fraction

DENSITIES = {"leung": 2000.0, "moss_brookes": 1800.0, "sectional": 1800.0}  # of docs/deck.md, where the deck names none

RATES = [  # name of the process, label, sign
    ("dimer_number", "dimers, 1/cm$^3$", 1e-6),
    ("dimer_production", "dimer production, 1/(cm$^3$ s)", 1e-6),
    ("growth", "growth by C2H2, kg/(m$^3$ s)", 1),
    ("condensation", "condensation, kg/(m$^3$ s)", 1),
    ("oxidation_O2", "oxidation by O2, kg/(m$^3$ s)", -1),
    ("oxidation_OH", "oxidation by OH, kg/(m$^3$ s)", -1),
    ("nucleation_number", "nucleation, 1/(cm$^3$ s)", 1e-6),
    ("coagulation_number", "loss by coagulation, 1/(cm$^3$ s)", -1e-6),
]


def soot_density(flat):
    return flat.get("particles.density", DENSITIES.get(flat.get("particles.carried", flat.get("particles.description")), 1850.0))


def plot_series(series, pictures):
    """All pictures of one series; without soot there is nothing to add to what a study shows anyway."""
    flames = [FlameData(Results(run["folder"])) for run in series.runs]
    if not all(flame.z.size and flame.soot and flame.soot["volume_fraction"].max() > 0 for flame in flames):
        return
    span = _span(flames)
    legend = series.quantity if series.values[0] is not None else None
    largest = np.array([max(flame.soot["volume_fraction"].max() for flame in flames)])
    scaled, unit = scaled_fraction(largest)
    factor = scaled[0] / largest[0]

    def panels(items, name, columns, limits):
        rows = -(-len(items) // columns)
        figure, grid = plt.subplots(rows, columns, figsize=(3.9 * columns + 1.2, 3.0 * rows), sharex=True, squeeze=False)
        for axes, (label, curves) in zip(grid.flat, items):
            _draw(axes, flames, curves, label, series.labels)
            axes.set_xlim(*limits)
        for axes in grid.flat[len(items):]:
            axes.axis("off")
        for axes in grid.flat[max(0, len(items) - columns):len(items)]:  # the last of each column, also above an empty place
            axes.set_xlabel("z, mm")
            axes.tick_params(labelbottom=True)
        grid[0][-1].legend(*grid[0][0].get_legend_handles_labels(), fontsize=8, title=legend, title_fontsize=8,
                           loc="upper left", bbox_to_anchor=(1.0, 1.0))
        pictures.save(figure, f"{series.name}_{name}")

    flames[0].label = f"{series.quantity}: {series.labels[0]}"
    plot_gas(flames[0], pictures, f"{series.name}_first_flame")
    fractions = [flame.soot["volume_fraction"] * factor for flame in flames]
    panels([(f"volume fraction{', ' + unit if unit else ''}", fractions)], "volume_fraction", 1, span)
    species = ["C2H2", "OH", "A1"]
    for run in series.runs:
        species += [name for name in run["flat"].get("particles.pah", []) if name not in species]
    gas = [("temperature, K", [flame.fields["temperature"] for flame in flames])]
    gas += [(f"mole fraction of {name}", [flame.X[name] for flame in flames]) for name in species
            if all(name in flame.X for flame in flames)]
    panels(gas, "gas", 3, (min(f.z[0] for f in flames), max(f.z[-1] for f in flames)))
    rates = []
    for name, label, factor_of_rate in RATES:
        curves = [flame.processes[name] * factor_of_rate if name in flame.processes else None for flame in flames]
        if any(values is not None and np.any(values != 0) for values in curves):
            rates.append((label, curves))
    panels(rates, "rates", 3, span)
    shapes = [shape(flame, soot_density(run["flat"])) for flame, run in zip(flames, series.runs)]
    particles = [("number density, 1/cm$^3$", [flame.soot["number_density"] * 1e-6 for flame in flames])]
    for place, label in enumerate(("primaries in an aggregate", "mobility diameter, nm", "gyration diameter, nm")):
        curves = [None if s is None else np.where(_enough(flame), s[place], np.nan) for s, flame in zip(shapes, flames)]
        if any(values is not None for values in curves):
            # Models of spheres have no primaries: there they are the nuclei that a particle holds.
            note = "" if all(s is None or s[3] for s in shapes) else " (by nuclei)"
            particles.append((label + note, curves))
    panels(particles, "particles", 2, span)
    if series.values[0] is not None:
        _plot_peaks(series, flames, fractions, unit, species, pictures)


def _enough(flame):
    fraction = flame.soot["volume_fraction"]
    return fraction > 1e-3 * fraction.max()


def _span(flames):
    low = min(flame.z[np.argmax(_enough(flame))] for flame in flames)
    high = max(flame.z[len(flame.z) - 1 - np.argmax(_enough(flame)[::-1])] for flame in flames)
    margin = 0.1 * (high - low)
    return max(low - margin, min(f.z[0] for f in flames)), min(high + margin, max(f.z[-1] for f in flames))


def _draw(axes, flames, curves, label, names):
    peaks = []
    for number, (flame, values, name) in enumerate(zip(flames, curves, names)):
        if values is None or not np.any(np.nan_to_num(values) != 0):
            axes.plot([], [], color=f"C{number % 10}", label=name)
            continue
        axes.plot(flame.z, values, color=f"C{number % 10}", lw=1.3, label=name)
        peaks.append(np.nanmax(values))
    axes.set_ylabel(label)
    if peaks and min(peaks) > 0 and max(peaks) > APART * min(peaks):
        least = min(np.nanmin(values[values > 0], initial=np.inf) for values in curves if values is not None)
        axes.set_yscale("log")
        axes.set_ylim(max(1e-2 * min(peaks), 1e-6 * max(peaks), 0.5 * least), 3 * max(peaks))
    else:
        axes.ticklabel_format(axis="y", scilimits=(-2, 4))


def _plot_peaks(series, flames, fractions, unit, species, pictures):
    at = series.values
    figure, ((a, b), (c, d)) = plt.subplots(2, 2, figsize=(11.0, 6.4), sharex=True)
    a.plot(at, [values.max() for values in fractions], "ko-", ms=4)
    a.set_ylabel(f"largest volume fraction{', ' + unit if unit else ''}")
    a.set_ylim(bottom=0)
    b.plot(at, [peak(flame.z, flame.soot["volume_fraction"])[1] for flame in flames], "ko-", ms=4, label="volume fraction")
    stagnation = [run["results"].get("stagnation_plane_m") for run in series.runs]
    if None not in stagnation:
        b.plot(at, [1e3 * z for z in stagnation], "s--", ms=4, color="0.5", label="stagnation plane")
    b.plot(at, [peak(flame.z, flame.fields["temperature"])[1] for flame in flames], "^-", ms=4, color="tab:red",
           label="temperature")
    b.set_ylabel("place of the peak, mm")
    for name in species:
        if name in ("OH",) or not all(name in flame.X for flame in flames):
            continue
        largest = [flame.X[name].max() for flame in flames]
        c.plot(at, np.array(largest) / largest[0], "o-", ms=4, label=name)
        if name not in ("C2H2", "A1"):
            b.plot(at, [peak(flame.z, flame.X[name])[1] for flame in flames], "o-", ms=3, lw=0.9, label=name)
    c.set_ylabel("largest mole fraction,\nover the first flame's")
    for name, label, _ in RATES:
        if all(name in flame.processes and np.any(flame.processes[name] != 0) for flame in flames):
            largest = np.array([np.max(np.abs(flame.processes[name])) for flame in flames])
            d.plot(at, largest / largest[0], "o-", ms=4, label=label.rsplit(",", 1)[0])
    d.set_ylabel("largest rate,\nover the first flame's")
    for axes in (b, c, d):
        axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    for axes in (c, d):
        axes.set_xlabel(series.quantity)
    pictures.save(figure, f"{series.name}_peaks")
