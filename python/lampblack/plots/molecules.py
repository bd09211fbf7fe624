"""Pictures of molecules that grew: their rings, atoms and sites in time, the mass spectrum, and the rings of some of them."""

import numpy as np

from .reactor import TIMES, unit_of
from .style import plt

MOST_DRAWN = 12
BOND = 0.1395  # nm, of two carbon atoms in a ring
DIRECTIONS = ((1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1))
SITES = ("FE", "ZZ", "AC", "BY5", "BY6", "R5")


def plot_molecules(results, pictures):
    _plot_history(results.history(), pictures)
    _plot_spectrum(results.file.get("spectrum"), pictures)
    _plot_rings(results.file.get("molecules"), pictures)


def _plot_history(columns, pictures):
    time, (factor, unit) = columns["time"], unit_of(columns["time"][-1], TIMES)
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 6.4), sharex=True)
    groups = (
        ("atoms", ("carbon", "hydrogen")),
        ("rings", ("six_rings", "five_rings")),
        ("sites", tuple(f"sites_{site}" for site in SITES)),
        ("events since the start", tuple(n for n in columns if n.startswith("events_") and not n.endswith(("_error", "_ci95", "_ci999")))),
    )
    for axes, (title, names) in zip(panels.flat, groups, strict=True):
        for name in names:
            mean, error = np.asarray(columns[name]), np.asarray(columns[f"{name}_error"])
            if not np.any(mean > 0):
                continue
            label = name.replace("_rings", "-rings").removeprefix("sites_").removeprefix("events_")
            (line,) = axes.plot(factor * time, np.where(mean > 0, mean, np.nan) if name.startswith("events_") else mean, label=label)
            axes.fill_between(factor * time, mean - 2 * error, mean + 2 * error, color=line.get_color(), alpha=0.25, lw=0)
        axes.set_ylabel(f"{title} of a molecule")
        axes.legend(fontsize=7)
    panels[1, 1].set_yscale("log")
    panels[1, 1].set_ylim(bottom=1e-3)  # rarer ones are a few events of all molecules
    for axes in panels[1]:
        axes.set_xlabel(f"time, {unit}")
    pictures.save(figure, "history")


def _plot_spectrum(group, pictures):
    if group is None or len(group["time"]) == 0:
        pictures.skip("mass spectrum", "there is none")
        return
    values = {name: group[name][()] for name in ("time", "carbon", "hydrogen", "mass", "fraction")}
    last = values["time"] == values["time"].max()
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 6.4))
    above.vlines(1e3 * values["mass"][last], 0, values["fraction"][last], lw=1.2)
    above.set_ylim(bottom=0)
    above.set_xlabel("molar mass, g/mol")
    above.set_ylabel("part of the molecules")
    drawn = below.scatter(values["carbon"][last], values["hydrogen"][last], c=values["fraction"][last], s=18, cmap="viridis", norm="log")
    below.set_xlabel("carbon atoms")
    below.set_ylabel("hydrogen atoms")
    figure.colorbar(drawn, ax=below, label="part of the molecules")
    factor, unit = unit_of(values["time"].max(), TIMES)
    figure.suptitle(f"formulas at {factor * values['time'].max():.3g} {unit}", fontsize=10)
    pictures.save(figure, "spectrum")


def _plot_rings(group, pictures):
    if group is None or len(group["six_rings"]) == 0:
        pictures.skip("molecules", "no rings were written ('output.molecules')")
        return
    six, five = group["six_rings"][()], group["five_rings"][()]
    carbon, hydrogen = (group["formulas"][name][()] for name in ("carbon", "hydrogen"))
    count = min(len(carbon), MOST_DRAWN)
    if len(carbon) > count:
        pictures.skip("some molecules", f"{count} of {len(carbon)} are drawn")
    width = min(4, count)
    rows = -(-count // width)
    figure, panels = plt.subplots(rows, width, figsize=(2.6 * width, 2.6 * rows), squeeze=False, sharex=True, sharey=True)
    for axes in panels.flat:
        axes.set_axis_off()
        axes.set_aspect("equal")
    reach = 0.0
    for repeat in range(count):
        axes = panels.flat[repeat]
        rings = {tuple(cell) for cell in six[six[:, 0] == repeat, 1:]}
        shapes = [corners(cell) for cell in rings] + [five_ring(tuple(cell), rings) for cell in five[five[:, 0] == repeat, 1:]]
        points = np.concatenate(shapes)
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        for number, shape in enumerate(shapes):
            closed = np.concatenate([shape, shape[:1]]) - middle
            axes.fill(*closed.T, color="tab:orange" if number >= len(rings) else "0.88", lw=0)
            axes.plot(*closed.T, color="black", lw=1.0)
        reach = max(reach, float(np.abs(points - middle).max()))
        axes.set_title(f"C$_{{{int(carbon[repeat])}}}$H$_{{{int(hydrogen[repeat])}}}$", fontsize=9)
    panels[0, 0].set_xlim(-1.1 * reach, 1.1 * reach)
    panels[0, 0].set_ylim(-1.1 * reach, 1.1 * reach)
    figure.suptitle(f"molecules at the end, each in a square of {2.2 * reach:.2g} nm; rings of five in orange", fontsize=10)
    pictures.save(figure, "molecules")


def centre(cell):
    """Of a cell, in nm."""
    q, r = cell
    return BOND * np.array([np.sqrt(3) * (q + r / 2), 1.5 * r])


def corners(cell):
    """The six carbon atoms of a ring of six."""
    angles = np.pi / 6 + np.pi / 3 * np.arange(6)
    return centre(cell) + BOND * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def five_ring(cell, rings):
    """The three carbon atoms of the zigzag and, pushed out from them, the two that bridge it."""
    beside = [k for k, (dq, dr) in enumerate(DIRECTIONS) if (cell[0] + dq, cell[1] + dr) in rings]
    first = beside[0] if (beside[0] + 1) % 6 in beside else beside[-1]
    # Direction k of a cell is at 60 k degrees; the corner between k and k + 1 at 60 k + 30.
    angle = np.pi / 3 * (first + 0.5)
    zigzag = centre(cell) + BOND * np.array([[np.cos(angle + turn), np.sin(angle + turn)] for turn in (-np.pi / 3, 0, np.pi / 3)])
    out = -np.array([np.cos(angle), np.sin(angle)])
    side = np.array([-out[1], out[0]])
    bridge = [zigzag[1] + 1.9 * BOND * out + s * 0.5 * BOND * side for s in (1, -1)]
    ends = (zigzag[0], zigzag[2])
    nearer = bridge if np.linalg.norm(bridge[0] - ends[1]) < np.linalg.norm(bridge[1] - ends[1]) else bridge[::-1]
    return np.array([zigzag[0], zigzag[1], zigzag[2], nearer[0], nearer[1]])
