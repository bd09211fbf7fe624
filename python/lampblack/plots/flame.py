"""Pictures of one-dimensional flames: temperature, heat release and species over z; soot with its processes and sizes; and
several flames in one picture."""

import numpy as np

from ..arrays import of_particles
from ..results import Results, text_of
from .style import plt, scaled_fraction

MOST_MAJOR, MOST_MINOR, MOST_SIZES = 8, 10, 7

# Major species are drawn on a linear scale, what is left of the largest on a logarithmic one.
MAJOR_FROM = 0.01

# Peaks that differ by more are drawn on a logarithmic scale, down to so much of the lowest peak.
APART = 30
BELOW_PEAK = {"volume fraction": 1e-2, "diameter": 0.2}


class FlameData:
    """The fields of one flame over z in mm."""

    def __init__(self, results):
        group = results.file["flame"]
        self.label = text_of(group.attrs.get("title", "")) or results.folder.name
        self.type = text_of(group.attrs.get("type", ""))
        self.attributes = {name: value for name, value in group.attrs.items() if np.isscalar(value)}
        self.z = group["z"][()] * 1e3 if "z" in group else np.empty(0)
        self.fields = {name: group[name][()] for name in group if name not in ("X", "Y", "soot", "restart")}
        self.X = {name: group["X"][name][()] for name in group.get("X", {})}
        soot = group.get("soot", {})
        self.soot = {name: soot[name][()] for name in soot if hasattr(soot[name], "shape")}
        self.processes = {name: soot["processes"][name][()] for name in soot.get("processes", {})}
        ensembles = results.file.get("stochastic", {})
        self.paths = [{"z": path["z"][()], **{name: of_particles(path, name)[()] for name in ("volume_fraction", "number_density")}}
                      for path in ensembles.values() if hasattr(path, "keys") and "z" in path]

    def span(self):
        """Where something happens: of long domains the part around the flame."""
        z, temperature = self.z, self.fields["temperature"]
        rise = temperature - temperature.min()
        if self.type != "free" or rise.max() < 1:
            return z[0], z[-1]
        steep = np.gradient(temperature, z)
        thickness = rise.max() / np.max(np.abs(steep))
        first = z[np.argmax(rise > 0.005 * rise.max())]
        return max(z[0], first - 2 * thickness), min(z[-1], first + 15 * thickness)


def plot_flame(results, pictures):
    flame = FlameData(results)
    if flame.z.size == 0:
        pictures.skip("flame", "the results hold no fields over z")
        return
    plot_gas(flame, pictures)
    if flame.soot:
        _plot_soot(flame, pictures)
        _plot_sizes(flame, pictures)


def _limit(axes, flame):
    low, high = flame.span()
    axes.set_xlim(low, high)
    return (flame.z >= low) & (flame.z <= high)


def plot_gas(flame, pictures, name="flame"):
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(7.0, 8.6), sharex=True)
    top.plot(flame.z, flame.fields["temperature"], color="tab:red", marker=".", ms=2.5, lw=1.2)
    top.set_ylabel("temperature, K", color="tab:red")
    other = top.twinx()
    other.spines["right"].set_visible(True)
    other.plot(flame.z, flame.fields["heat_release"] * 1e-6, color="tab:blue", lw=1.0)
    other.set_ylabel("heat release, MW/m$^3$", color="tab:blue")
    inside = _limit(top, flame)
    peak = {name: np.max(values[inside]) for name, values in flame.X.items()}
    order = sorted(peak, key=lambda name: -peak[name])
    major = [name for name in order if peak[name] >= MAJOR_FROM][:MOST_MAJOR]
    minor = [name for name in order if name not in major and peak[name] > 0]
    minor = [name for name in minor if peak[name] > 1e-4 * peak[minor[0]]][:MOST_MINOR]
    for species in major:
        middle.plot(flame.z, flame.X[species], label=species, lw=1.2)
    middle.set_ylabel("mole fraction")
    middle.set_ylim(bottom=0)
    middle.legend(fontsize=8, ncol=2, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    for species in minor:
        bottom.semilogy(flame.z, np.where(flame.X[species] > 0, flame.X[species], np.nan), label=species, lw=1.2)
    if minor:
        bottom.set_ylim(1e-4 * peak[minor[0]], 2 * peak[minor[0]])
        bottom.legend(fontsize=8, ncol=1, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    bottom.set_ylabel("mole fraction")
    bottom.set_xlabel("z, mm")
    top.set_title(flame.label, loc="left", fontsize=10)
    pictures.save(figure, name)


PROCESSES = {  # mass rates; losses negative
    "nucleation": "nucleation", "condensation": "condensation", "growth": "growth", "oxidation_O2": "oxidation by O2",
    "oxidation_OH": "oxidation by OH", "carbonisation": "carbonisation",
}


def soot_span(flame):
    """Where there is soot; None where there is none."""
    fraction = flame.soot["volume_fraction"]
    there = np.flatnonzero(fraction > 1e-4 * fraction.max()) if fraction.max() > 0 else []
    if len(there) < 2:
        return None
    margin = 0.05 * (flame.z[there[-1]] - flame.z[there[0]])
    return max(flame.z[0], flame.z[there[0]] - margin), min(flame.z[-1], flame.z[there[-1]] + margin)


def _plot_soot(flame, pictures):
    fraction, unit = scaled_fraction(flame.soot["volume_fraction"])
    if flame.soot["volume_fraction"].max() <= 0:
        pictures.skip("soot", "there is none")
        return
    figure, ((a, b), (c, d)) = plt.subplots(2, 2, figsize=(9.6, 6.4), sharex=True)
    a.plot(flame.z, fraction, color="black")
    a.set_ylabel(f"volume fraction{', ' + unit if unit else ''}")
    hot = a.twinx()
    hot.spines["right"].set_visible(True)
    hot.plot(flame.z, flame.fields["temperature"], color="tab:red", lw=0.8)
    hot.set_ylabel("T, K", color="tab:red")
    b.semilogy(flame.z, _positive(flame.soot["number_density"] * 1e-6), color="tab:blue")
    b.set_ylabel("number density, 1/cm$^3$")
    _bottom(b, flame.soot["number_density"] * 1e-6, 1e-6)
    enough = fraction > 1e-4 * fraction.max()
    drawn = []
    for name, label in (("mean_diameter", "mean volume"), ("primary_diameter", "primaries"),
                        ("mobility_diameter", "mobility"), ("gyration_diameter", "gyration")):
        values = flame.soot.get(name)
        # Spheres have one diameter: a curve on top of another is not drawn twice.
        same = any(np.allclose(values[enough], other[enough], rtol=1e-3) for other in drawn)
        if values is not None and np.any(values > 0) and not same:
            c.plot(flame.z, np.where(enough, values * 1e9, np.nan), label=label)
            drawn.append(values)
    c.set_ylabel("diameter, nm")
    c.legend(fontsize=8)
    for name, label in PROCESSES.items():
        values = flame.processes.get(name)
        if values is not None and np.any(values != 0):
            d.plot(flame.z, values, label=label)
    d.axhline(0, color="0.6", lw=0.6)
    d.set_ylabel("mass rate, kg/(m$^3$ s)")
    d.legend(fontsize=8)
    for axes in (c, d):
        axes.set_xlabel("z, mm")
    if soot_span(flame):
        a.set_xlim(*soot_span(flame))
    d.ticklabel_format(axis="y", scilimits=(-2, 4))
    a.set_title(flame.label, loc="left", fontsize=10)
    pictures.save(figure, "soot")


def _positive(values):
    return np.where(values > 0, values, np.nan)


def _bottom(axes, values, below):
    if np.max(values) > 0:
        axes.set_ylim(below * np.max(values), 3 * np.max(values))


def _plot_sizes(flame, pictures):
    if "size_distribution" not in flame.soot:
        return
    density, diameter = flame.soot["size_distribution"] * 1e-6, flame.soot["diameter"] * 1e9
    filled = np.flatnonzero(flame.soot["volume_fraction"] > 0.02 * flame.soot["volume_fraction"].max())
    if filled.size == 0 or density.max() <= 0:
        pictures.skip("size distributions", "there is no soot")
        return
    places = np.linspace(flame.z[filled[0]], flame.z[filled[-1]], MOST_SIZES)
    chosen = np.unique([np.argmin(np.abs(flame.z - place)) for place in places])
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for number, i in enumerate(chosen):
        axes.loglog(diameter, _positive(density[i]), color=plt.cm.viridis(number / max(1, len(chosen) - 1)), marker=".",
                    ms=3, label=f"{flame.z[i]:.3g} mm")
    _bottom(axes, density, 1e-7)
    shown = np.flatnonzero((density[chosen] > 1e-7 * density.max()).any(axis=0))
    if shown.size:
        axes.set_xlim(0.7 * diameter[shown[0]], 1.5 * diameter[shown[-1]])
    axes.set_xlabel("diameter, nm")
    axes.set_ylabel("dN/dlog$_{10}$d, 1/cm$^3$")
    axes.legend(fontsize=8, title="z")
    pictures.save(figure, "sizes")


def plot_together(folders, pictures, name="together", varied=None):
    """Temperature, soot or heat release of several flames on top of each other; `varied` is what their names give."""
    flames = [FlameData(Results(folder)) for folder in folders]
    labels = short_names([folder.name for folder in folders])
    usable = [(flame, label) for flame, label in zip(flames, labels) if flame.z.size]
    if len(usable) < len(flames):
        pictures.skip("some flames", "they hold no fields over z")
    if not usable:
        return
    with_soot = any(flame.soot for flame, _ in usable)
    panels = [("temperature", "temperature, K", lambda f: f.fields["temperature"])]
    if with_soot:
        largest = max((flame.soot["volume_fraction"].max() for flame, _ in usable if flame.soot), default=0.0)
        scaled, unit = scaled_fraction(np.array([largest]))
        factor = scaled[0] / largest if largest > 0 else 1.0
        panels += [
            ("volume fraction", f"volume fraction{', ' + unit if unit else ''}", lambda f: _soot(f, "volume_fraction", factor)),
            ("number density", "number density, 1/cm$^3$", lambda f: _soot(f, "number_density", 1e-6)),
            ("diameter", "mean diameter, nm", _mean_diameter),
        ]
    else:
        panels += [("heat release", "heat release, MW/m$^3$", lambda f: f.fields["heat_release"] * 1e-6),
                   ("velocity", "velocity, m/s", lambda f: f.fields["velocity"]),
                   ("OH", "mole fraction of OH", lambda f: f.X.get("OH"))]
    figure, grid = plt.subplots(2, 2, figsize=(10.0, 6.6), sharex=not with_soot)
    for axes, (title, label, values_of) in zip(grid.flat, panels):
        shown, peaks = 0.0, []
        for number, (flame, name_of_flame) in enumerate(usable):
            values = values_of(flame)
            if values is None:
                continue
            colour = f"C{number}" if len(usable) <= 10 else plt.cm.viridis(number / (len(usable) - 1))
            axes.plot(flame.z, values, color=colour, lw=1.3, label=name_of_flame)
            peaks.append(np.nanmax(values, initial=0.0))
            shown = max(shown, peaks[-1])
            for path in flame.paths:
                _along_path(axes, path, title, factor if with_soot else 1.0, colour)
        # Models may differ by orders of magnitude.
        least = min((p for p in peaks if p > 0), default=0.0)
        if shown > 0 and (title == "number density" or title in BELOW_PEAK and shown > APART * least):
            axes.set_yscale("log")
            axes.set_ylim(1e-6 * shown if title == "number density" else BELOW_PEAK[title] * least, 3 * shown)
        axes.set_ylabel(label)
    for axes in grid.flat if with_soot else grid[1]:
        axes.set_xlabel("z, mm")
    spans = [flame.span() for flame, _ in usable]
    grid[0][0].set_xlim(min(low for low, _ in spans), max(high for _, high in spans))
    sooty = [soot_span(flame) for flame, _ in usable if flame.soot]
    for axes in grid.flat[1:] if any(sooty) else []:
        axes.set_xlim(min(span[0] for span in sooty if span), max(span[1] for span in sooty if span))
    if any(flame.paths for flame, _ in usable):
        grid[0][0].set_title("dotted: ensembles", loc="left", fontsize=9)
    grid[0][1].legend(*grid[0][0].get_legend_handles_labels(), fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0),
                      title=varied, title_fontsize=8)
    pictures.save(figure, name)


def _along_path(axes, path, title, factor, colour):
    """The ensemble of a flame, dotted over its carried soot; its confidence is narrower than the line."""
    fraction, number = path["volume_fraction"], path["number_density"]
    with np.errstate(divide="ignore", invalid="ignore"):
        diameter = np.where(fraction > 1e-3 * fraction.max(), np.cbrt(6 * fraction / (np.pi * number)), np.nan)
    values = {"volume fraction": fraction * factor, "number density": number * 1e-6, "diameter": diameter * 1e9}.get(title)
    if values is not None:
        axes.plot(path["z"] * 1e3, values, color=colour, ls=":", lw=2.0)


def short_names(names):
    """Names without the words that all of them begin with."""
    words = [name.split("_") for name in names]
    same = 0
    while len(names) > 1 and all(len(w) > same + 1 and w[same] == words[0][same] for w in words):
        same += 1
    # "model-hmom" is hmom where every name says "model-".
    names = ["_".join(w[same:]) for w in words]
    keys = {name.split("-", 1)[0] for name in names if "-" in name}
    return [n.split("-", 1)[1] for n in names] if len(keys) == 1 and all("-" in n for n in names) else names


def _soot(flame, name, factor):
    return flame.soot[name] * factor if name in flame.soot else None


def _mean_diameter(flame):
    if "mean_diameter" not in flame.soot:
        return None
    fraction = flame.soot["volume_fraction"]
    return np.where(fraction > 1e-4 * fraction.max(), flame.soot["mean_diameter"] * 1e9, np.nan)
