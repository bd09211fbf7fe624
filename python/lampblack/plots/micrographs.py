"""The largest and typical particles in the manner of electron micrographs: darker where the beam has more to go through."""

import numpy as np

from .aggregates import reconstructed
from .style import plt

PIXELS, SLICES = 420, 120
GREYS = 128  # a small file
TYPICAL = 4
SEED = 1
DEPTHS = 40  # shades


def plot_micrographs(tables, pictures, name):
    count = tables.particles["primaries"]
    random = np.random.default_rng(SEED)
    largest = int(np.argmax(count))
    median = int(np.median(count))
    # Of particles with the median number of primaries some at random.
    nearest = np.argsort(np.abs(count - median) + random.random(len(count)), kind="stable")
    typical = [int(i) for i in nearest if i != largest][:TYPICAL]
    figure, axes = plt.subplot_mosaic([["largest", "largest", 0, 1], ["largest", "largest", 2, 3]], figsize=(10.4, 5.6))
    are_placed = "radius" in tables.primaries
    shapes = {i: (_placed(tables, i) if are_placed else _shape(tables, i, random)) for i in [largest, *typical]}
    width = max(_width(*shapes[i]) for i in typical)
    draw = _draw_by_depth if are_placed else _draw
    draw(axes["largest"], *shapes[largest], _width(*shapes[largest]), _label(tables, largest))
    for place in range(TYPICAL):
        if place < len(typical):
            draw(axes[place], *shapes[typical[place]], width, _label(tables, typical[place]))
        else:
            axes[place].axis("off")
    axes["largest"].set_title("the particle of most primaries", fontsize=10)
    axes[0].set_title(f"typical ones, with the median number\nof primaries ({median}) or next to it", fontsize=10, loc="left")
    places = ("their places in space; brighter spheres are nearer" if are_placed
              else "reconstructed positions: neighbours and overlap are computed, directions are random")
    figure.suptitle(f"particles at {tables.moment}, {places}", fontsize=10)
    pictures.save(figure, name)


def _shape(tables, particle, random):
    """Centres and diameters in nm."""
    primaries = np.flatnonzero(tables.primaries["particle"] == particle)
    rows = np.flatnonzero(tables.necks["particle"] == particle)
    necks = {name: tables.necks[name][rows] - primaries[0] for name in ("left", "right", "first", "last")}
    necks["level"] = tables.necks["sintering_level"][rows]
    diameters = tables.primaries["diameter"][primaries] * 1e9
    return reconstructed(diameters, necks, random), diameters


def _placed(tables, particle):
    """The same of spheres whose places are known."""
    rows = tables.primaries["particle"] == particle
    centres = np.stack([tables.primaries[axis][rows] for axis in "xyz"], axis=1)
    return centres * 1e9, tables.primaries["radius"][rows] * 2e9


def _label(tables, particle):
    p = tables.particles
    count = p["primaries"][particle]
    return f"{count} primar{'y' if count == 1 else 'ies'}, $d_c$ = {p['collision_diameter'][particle] * 1e9:.3g} nm"


def _width(centres, diameters):
    """Of a square picture that shows all, a margin and a strip for the bar."""
    low, high = centres[:, :2] - diameters[:, None] / 2, centres[:, :2] + diameters[:, None] / 2
    return 1.35 * float(np.max(high.max(axis=0) - low.min(axis=0)))


def thickness(centres, diameters, width, pixels=PIXELS, slices=SLICES):
    """Of all spheres together along the beam, at each pixel of a square around their middle; what two share counts once."""
    radii = diameters / 2
    low, high = (centres - radii[:, None]).min(axis=0), (centres + radii[:, None]).max(axis=0)
    line = (np.arange(pixels) + 0.5) / pixels * width - width / 2
    x, y = (low[0] + high[0]) / 2 + line, (low[1] + high[1]) / 2 + line
    dz = (high[2] - low[2]) / slices
    z = low[2] + (np.arange(slices) + 0.5) * dz
    full = np.zeros((pixels, pixels, slices), dtype=bool)
    for centre, radius in zip(centres, radii, strict=True):
        i, j, k = (np.flatnonzero(np.abs(axis - c) < radius) for axis, c in zip((x, y, z), centre, strict=True))
        inside = (x[i] - centre[0])[:, None, None] ** 2 + (y[j] - centre[1])[None, :, None] ** 2 + (z[k] - centre[2]) ** 2 < radius**2
        full[np.ix_(i, j, k)] |= inside
    return full.sum(axis=2).T * dz


def _soft(picture, sigma):
    """Blurred by a Gaussian of so many pixels."""
    reach = int(3 * sigma) + 1
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        picture = np.apply_along_axis(lambda line: np.convolve(np.pad(line, reach, mode="edge"), kernel, "valid"), axis, picture)
    return picture


def _draw(axes, centres, diameters, width, label):
    beam = np.exp(-0.8 * thickness(centres, diameters, width) / np.mean(diameters))
    picture = np.round(_soft(0.1 + 0.72 * beam, 1.0) * GREYS) / GREYS
    axes.imshow(picture, cmap="gray", vmin=0, vmax=1, origin="lower", extent=(0, width, 0, width), interpolation="nearest")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(False)
    axes.set_xlabel(label, fontsize=9)
    scale_bar(axes, width)


def shade_by_depth(axes, centres, radii, deepest, shift):
    """Spheres seen along z, brighter where they are nearer; `deepest`: the largest |z| of the picture."""
    for i in np.argsort(centres[:, 2]):  # from below
        shade = 0.25 + 0.6 * round(DEPTHS * (centres[i, 2] / deepest + 1) / 2) / DEPTHS
        axes.add_patch(plt.Circle(centres[i, :2] + shift, radii[i], facecolor=str(shade), edgecolor="black", lw=0.25))


def _draw_by_depth(axes, centres, diameters, width, label):
    low, high = centres[:, :2] - diameters[:, None] / 2, centres[:, :2] + diameters[:, None] / 2
    shift = width / 2 - (low.min(axis=0) + high.max(axis=0)) / 2
    shade_by_depth(axes, centres, diameters / 2, max(float(np.abs(centres[:, 2]).max()), 1e-3), shift)
    axes.set_xlim(0, width)
    axes.set_ylim(0, width)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(False)
    axes.set_xlabel(label, fontsize=9)
    scale_bar(axes, width)


def scale_bar(axes, width):
    """In the lower left corner of a square picture whose axes begin at zero, so many nm wide."""
    bar = max(length for length in (m * 10.0**e for e in range(-2, 5) for m in (1, 2, 5)) if length <= 0.3 * width)
    axes.plot([0.05 * width, 0.05 * width + bar], [0.05 * width] * 2, color="black", lw=3, solid_capstyle="butt")
    axes.text(0.05 * width + bar / 2, 0.07 * width, f"{bar:g} nm", ha="center", va="bottom", fontsize=9)
