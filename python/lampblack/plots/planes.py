"""Pictures of a field over the plane, in space over a cut through the middle of the third axis; what is axisymmetric is mirrored
about the axis, so that it looks like the flame."""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LogNorm

from ..results import unit_of
from .shapes import Shapes
from .style import plt, scaled_fraction, shown_time

STRIP = 20  # longer over wider: drawn without equal axes

# Name of the picture, field, title, colour map, whether it is a small fraction.
PLANES = [
    ("temperature", "temperature", "Temperature", "inferno", False),
    ("velocity", "velocity", "Velocity", "cividis", False),
    ("swirl", "swirl_velocity", "Velocity about the axis", "cividis", False),
]
# The same by what the particles are called: of them, and of what they come from.
PARTICLES = {
    "soot": [
        ("C2H2", "X_C2H2", "C$_2$H$_2$ mole fraction", "viridis", True),
        ("A2", "X_A2", "Naphthalene (A2) mole fraction", "viridis", True),
        ("soot_volume_fraction", "soot_volume_fraction", "Soot volume fraction", "magma", True),
    ],
    "silica": [
        ("H4O4SI", "X_H4O4SI", "Silicic acid (H4O4SI) mole fraction", "viridis", True),
        ("silica_volume_fraction", "silica_volume_fraction", "Silica volume fraction", "magma", True),
    ],
}


def _cells(axes, results, shapes, values, colours, side):
    """The cells in their colours, in mm, and the edges of the surface but for the axis; `side` is -1 for the mirrored ones."""
    mirror = np.array([side, 1.0]) * 1e3
    drawn = PolyCollection([polygon * mirror for polygon in shapes.polygons], array=values[shapes.cells], cmap=colours,
                           edgecolors="face", linewidths=0.2)
    axes.add_collection(drawn)
    edges = shapes.surface()
    if results.touches_axis():
        edges = edges[np.abs(edges[:, :, 0]).max(axis=1) > 0]
    axes.add_collection(LineCollection(edges * mirror, colors="black", linewidths=0.8))
    return drawn


def draw(axes, results, shapes, values, colours, limits):
    """The cells and, where there is an axis, their mirror images."""
    drawn = None
    for side in (1.0, -1.0) if results.touches_axis() else (1.0,):
        drawn = _cells(axes, results, shapes, values, colours, side)
        drawn.set_clim(*limits)
    axes.autoscale_view()
    # A strip would be a line: it is drawn as wide as it is long.
    width, height = axes.get_xlim()[1] - axes.get_xlim()[0], axes.get_ylim()[1] - axes.get_ylim()[0]
    axes.set_aspect("equal" if 1 / STRIP < width / height < STRIP else "auto")
    across, along = results.axis_names()
    axes.set_xlabel(f"{across}, mm")
    axes.set_ylabel(f"{along}, mm")
    return drawn


def _figure_size(results):
    """As wide as the plane wants at a height that suits, with room for the colour bar."""
    width, height = np.ptp(results.vertices[:, 0]), np.ptp(results.vertices[:, 1])
    ratio = height / max(width * (2.0 if results.touches_axis() else 1.0), 1e-300)
    return (7.0, float(np.clip(1.2 + 5.0 * ratio, 2.6, 9.0)))


def _streamlines(axes, results, shapes, velocity):
    """Streamlines on a regular grid between the cells; none where all cells stand in one row."""
    x, y = results.centres[shapes.cells, 0] * 1e3, results.centres[shapes.cells, 1] * 1e3
    if np.ptp(x) == 0 or np.ptp(y) == 0:
        return
    grid_x, grid_y = np.linspace(x.min(), x.max(), 90), np.linspace(y.min(), y.max(), 120)
    at = np.meshgrid(grid_x * 1e-3, grid_y * 1e-3)
    u, v = (shapes.values_at(velocity[:, axis], *at) for axis in (0, 1))
    style = {"density": 0.9, "color": "white", "linewidth": 0.6, "arrowsize": 0.7}
    axes.streamplot(grid_x, grid_y, u, v, **style)
    if results.touches_axis():
        axes.streamplot(-grid_x[::-1], grid_y, -u[:, ::-1], v[:, ::-1], **style)


def _plot_flame(results, shapes, pictures):
    """The flame at a glance: temperature on the left of the axis, particles on the right."""
    temperature, soot = results.field("temperature"), results.field(f"{results.material}_volume_fraction")
    if temperature is None or soot is None or not results.touches_axis() or not np.all(np.isfinite(soot)):
        return
    soot, unit = scaled_fraction(soot)
    width, height = _figure_size(results)
    figure, axes = plt.subplots(figsize=(width + 3.0, height + 0.4))
    for side, values, colours, label, place in (
        (-1.0, temperature, "inferno", "T, K", "left"),
        (1.0, soot, "magma", f"{results.material} volume fraction, {unit}", "right"),
    ):
        drawn = _cells(axes, results, shapes, values, colours, side)
        figure.colorbar(drawn, ax=axes, label=label, location=place, pad=0.12 if place == "left" else 0.02)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel("r, mm")
    axes.set_ylabel("z, mm")
    axes.set_title(shown_time(results.time(results.steps[-1])))
    pictures.save(figure, "flame")


def _plot_aggregates(results, shapes, pictures):
    """Volume fraction, and where it is a thousandth of the largest or more, what aggregates are made of."""
    soot, diameter, primaries = (results.field(f"{results.material}_{end}") for end in (
        "volume_fraction", "primary_diameter", "primaries_per_aggregate"))
    if primaries is None or not np.nanmax(primaries) > 1.001:
        return
    there = soot > 1e-3 * soot.max()
    fraction, unit = scaled_fraction(soot)
    width, height = _figure_size(results)
    figure, panels = plt.subplots(1, 3, figsize=(1.9 * width, height + 0.4), sharey=True, layout="constrained")
    for axes, values, colours, label, norm in (
        (panels[0], fraction, "magma", f"{results.material} volume fraction, {unit}", None),
        (panels[1], np.where(there, diameter * 1e9, np.nan), "viridis", "diameter of primary particles, nm", None),
        (panels[2], np.where(there, primaries, np.nan), "cividis", "primary particles of an aggregate", LogNorm()),
    ):
        for side in (1.0, -1.0) if results.touches_axis() else (1.0,):
            drawn = _cells(axes, results, shapes, values, colours, side)
            if norm is not None:
                drawn.set_norm(norm)
            drawn.set_clim(np.nanmin(values), np.nanmax(values))
        figure.colorbar(drawn, ax=axes, label=label, location="top")
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.set_xlabel(f"{results.axis_names()[0]}, mm")
    panels[0].set_ylabel(f"{results.axis_names()[1]}, mm")
    pictures.save(figure, "aggregates")


def plot_planes(results, pictures):
    if not results.steps:
        pictures.skip("plane pictures", "no step was written")
        return
    step = results.steps[-1]
    shapes = Shapes(results)
    cut = "" if shapes.cut is None else f", z = {shapes.cut * 1e3:.3g} mm"
    _plot_flame(results, shapes, pictures)
    _plot_aggregates(results, shapes, pictures)
    for name, field, title, colours, is_fraction in PLANES + PARTICLES.get(results.material, []):
        values = results.field(field)
        if values is None:
            pictures.skip(f"{name} picture", f"the results hold no field '{field}'")
            continue
        unit = unit_of(results.fields(step)[field]) if field in results.fields(step) else ""
        _plot_plane(results, shapes, pictures, name, values, title, colours, None if is_fraction else unit, cut)


def plot_plane(results, name, values, title, unit, pictures):
    """A picture of one field of the last step; `unit` None: it is a small fraction."""
    shapes = Shapes(results)
    cut = "" if shapes.cut is None else f", z = {shapes.cut * 1e3:.3g} mm"
    _plot_plane(results, shapes, pictures, name, values, title, "viridis", unit, cut)


def _plot_plane(results, shapes, pictures, name, values, title, colours, unit, cut):
    step = results.steps[-1]
    velocity, is_fraction = None, unit is None
    if values.ndim == 2:
        velocity, values = values, np.linalg.norm(values, axis=1)
    if not np.all(np.isfinite(values)):
        pictures.skip(f"{name} picture", "the field has values that are not finite")
        return
    if is_fraction:
        values, unit = scaled_fraction(values)
    figure, axes = plt.subplots(figsize=_figure_size(results))
    low = 0.0 if is_fraction or velocity is not None else float(values.min())
    high = float(values.max())
    drawn = draw(axes, results, shapes, values, colours, (low, high if high > low else low + 1.0))
    if velocity is not None and results.centres.shape[0] > 3:
        _streamlines(axes, results, shapes, velocity)
    figure.colorbar(drawn, ax=axes, label=f"{title}, {unit}" if unit not in ("", "1") else title)
    axes.set_title(f"{title} at t = {shown_time(results.time(step))}, largest {high:.4g} {unit}".rstrip() + cut)
    pictures.save(figure, name)
