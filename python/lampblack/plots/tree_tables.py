"""Pictures of the tables of every particle, its primaries and necks: distributions, a joint one, and averages by classes of the
diameter of collision; of spheres in space their fractal law."""

import numpy as np
from matplotlib.ticker import LogLocator

from .micrographs import plot_micrographs
from .style import plt, shown_time

CLASSES = 12
FIT_FROM = 8  # primaries of a particle that counts for the fractal law
LEAST = 5  # particles that a class has to have


class TreeTables:
    """Of a moment; columns as arrays."""

    def __init__(self, group):
        self.particles, self.primaries, self.necks = ({name: values[()] for name, values in group[table].items()}
                                                      for table in ("particles", "primaries", "necks"))
        place = next(name for name in ("position", "time") if name in group.attrs)
        at = float(group.attrs[place])
        self.moment = shown_time(at) if place == "time" else f"z = {at * 1e3:.3g} mm"


def plot_tree_tables(results, pictures):
    groups = results.file.get("particles/tables", {})
    for name in sorted(groups, key=int):
        tables = TreeTables(groups[name])
        ending = f"_{name}" if len(groups) > 1 else ""
        if len(tables.particles["number"]) < 2:
            pictures.skip(f"particles at {tables.moment}", "there are none")
            continue
        plot_micrographs(tables, pictures, f"micrographs{ending}")
        if "gyration_radius" in tables.particles:
            _plot_fractal_law(tables, pictures, f"fractal_law{ending}")
        _plot_distributions(tables, pictures, f"particle_distributions{ending}")
        _plot_classes(tables, pictures, f"particle_classes{ending}")


def fractal_law(tables):
    """Of particles of FIT_FROM primaries and more: their numbers n, R_g/a (a: mean radius of a particle's spheres), and dimension,
    its standard error and prefactor of n = k (R_g/a)^D, by least squares of ln(R_g/a) over ln n."""
    count = tables.particles["primaries"]
    radius = np.bincount(tables.primaries["particle"], tables.primaries["radius"]) / count
    several = count >= FIT_FROM
    n, ratio = count[several], (tables.particles["gyration_radius"] / radius)[several]
    if len(n) < 3 or n.max() < 4 * n.min():
        return n, ratio, np.nan, np.nan, np.nan
    (slope, constant), covariance = np.polyfit(np.log(n), np.log(ratio), 1, cov=True)
    return n, ratio, 1 / slope, np.sqrt(covariance[0, 0]) / slope**2, np.exp(-constant / slope)


def _plot_fractal_law(tables, pictures, name):
    n, ratio, dimension, error, prefactor = fractal_law(tables)
    if not np.isfinite(dimension):
        pictures.skip(f"fractal law at {tables.moment}", f"too few particles of {FIT_FROM} primaries and more")
        return
    figure, axes = plt.subplots(figsize=(6.4, 4.8))
    axes.loglog(n, ratio, ".", color="0.6", ms=3)
    line = np.array([n.min(), n.max()])
    axes.loglog(line, (line / prefactor) ** (1 / dimension), color="black")
    axes.set_xlabel("primaries in a particle")
    axes.set_ylabel("radius of gyration over mean radius of spheres")
    axes.set_title(f"{len(n)} particles of {FIT_FROM} primaries and more at {tables.moment}:\n"
                   f"dimension {dimension:.3f} $\\pm$ {error:.3f}, prefactor {prefactor:.2f}", fontsize=9)
    pictures.save(figure, name)


def _logarithmic(axes):
    """A logarithmic axis of nm with plain numbers."""
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_locator(LogLocator(subs=(2, 3, 5)))
    axes.xaxis.set_minor_formatter("{x:g}")
    axes.tick_params(axis="x", which="minor", labelsize=10)


def _per_decade(axes, diameters, weights, bins=40):
    """dN/dlog10 d of diameters in nm."""
    low, high = np.log10(diameters.min()) - 0.02, np.log10(diameters.max()) + 0.02
    density, edges = np.histogram(np.log10(diameters), bins, (low, high), weights=weights)
    axes.stairs(density / np.diff(edges), 10**edges, fill=True, color="0.6")
    _logarithmic(axes)


def _plot_distributions(tables, pictures, name):
    particles, primaries, necks = tables.particles, tables.primaries, tables.necks
    number = particles["number"]
    figure, ((first, second), (third, joint)) = plt.subplots(2, 2, figsize=(9.6, 7.2))
    figure.suptitle(f"the {len(number)} numerical particles of the first repeat at {tables.moment}, {len(primaries['particle'])} primaries", fontsize=10)
    _per_decade(first, primaries["diameter"] * 1e9, number[primaries["particle"]])
    first.set_xlabel("diameter of primaries, nm")
    first.set_ylabel("dN/dlog$_{10}$ d, primaries per m$^3$")
    if len(necks["particle"]):
        second.hist(necks["sintering_level"], 40, (0, 1), weights=number[necks["particle"]] * 40, color="0.6")
    second.set_xlabel("sintering level of necks (0: point contact)")
    second.set_ylabel("dN/d level, necks per m$^3$")
    if all(component in particles for component in ("Si", "O", "OH")):
        ratio = particles["Si"] / (particles["O"] + particles["OH"])
        density, edges = np.histogram(ratio, 40, weights=number)
        third.stairs(density / np.diff(edges), edges, fill=True, color="0.6")
        third.set_xlabel("Si over O, that of OH included (SiO$_2$: 0.5), of particles")
        third.set_ylabel("dN/d ratio, particles per m$^3$")
    _plot_joint(figure, joint, particles)
    pictures.save(figure, name)


def _plot_joint(figure, axes, particles):
    """Collision diameter against mean sintering level, of particles that have a neck."""
    several = particles["primaries"] > 1
    axes.set_xlabel("diameter of collision, nm")
    axes.set_ylabel("mean sintering level")
    single = np.sum(particles["number"][~several]) / np.sum(particles["number"])
    axes.set_title(f"particles of two primaries or more (one only: {100 * single:.0f} %)", fontsize=9)
    if several.sum() < 2:
        return
    x, y, w = np.log10(particles["collision_diameter"][several] * 1e9), particles["sintering_level"][several], particles["number"][several]
    density, across, up = np.histogram2d(x, y, 32, ((x.min() - 0.02, x.max() + 0.02), (0, 1)), weights=w)
    density /= np.diff(across)[:, None] * np.diff(up)
    mesh = axes.pcolormesh(10**across, up, np.where(density > 0, density, np.nan).T, cmap="viridis", vmin=0)
    _logarithmic(axes)
    figure.colorbar(mesh, ax=axes, label="d$^2$N/dlog$_{10}$ d dlevel, 1/m$^3$")


def class_means(particles, classes=CLASSES, least=LEAST):
    """Classes of equal width of log10 of the collision diameter: their middles (m), numbers of particles in the sample, and of each
    averaged quantity mean and standard error. Classes of fewer than `least` particles are left out."""
    logarithm = np.log10(particles["collision_diameter"])
    edges = np.linspace(logarithm.min(), logarithm.max() + 1e-9, classes + 1)
    of = np.clip(np.digitize(logarithm, edges) - 1, 0, classes - 1)
    kept = [c for c in range(classes) if np.sum(of == c) >= least]
    middles = np.array([10 ** (0.5 * (edges[c] + edges[c + 1])) for c in kept])
    counts = np.array([np.sum(of == c) for c in kept])
    means = {}
    for name in ("primaries", "primary_diameter", "sintering_level"):
        inside = [particles[name][of == c] for c in kept]
        means[name] = (np.array([np.mean(v) for v in inside]), np.array([np.std(v) / np.sqrt(len(v)) for v in inside]))
    return middles, counts, means


def _plot_classes(tables, pictures, name):
    middles, counts, means = class_means(tables.particles)
    if len(middles) < 2:
        pictures.skip(f"classes at {tables.moment}", f"fewer than two have {LEAST} particles")
        return
    figure, panels = plt.subplots(3, 1, figsize=(6.4, 8.0), sharex=True)
    labels = {"primaries": ("primaries in a particle", 1.0), "primary_diameter": ("mean diameter of primaries, nm", 1e9),
              "sintering_level": ("mean sintering level\n(of one primary: 1)", 1.0)}
    for panel, (quantity, (label, factor)) in zip(panels, labels.items(), strict=True):
        mean, error = means[quantity]
        panel.errorbar(middles * 1e9, mean * factor, 2 * error * factor, fmt="o-", ms=4, lw=1.0, color="black", capsize=2)
        panel.set_ylabel(label)
    panels[0].set_title(f"means of particles by class of collision diameter at {tables.moment},\nwith two standard errors of the "
                        f"first repeat's sample; {counts.min()} to {counts.max()} particles in a class", fontsize=9)
    if means["primaries"][0].max() > 20:
        panels[0].set_yscale("log")
        panels[0].yaxis.set_major_formatter("{x:g}")
    panels[2].set_ylim(0, 1.05)
    _logarithmic(panels[2])
    panels[2].set_xlabel("diameter of collision, nm")
    pictures.save(figure, name)
