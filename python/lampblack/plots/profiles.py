"""Profiles along the centreline, with reference profiles over them."""

from ..reference import read_reference
from .style import plt, shown_time

# Field, column of the reference, label, factor to the unit shown, logarithmic.
PROFILES = [
    ("temperature", "T_K", "T, K", 1.0, False),
    ("velocity", "u_m_s", "axial velocity, m/s", 1.0, False),
    ("X_C2H4", "X_C2H4", "X C$_2$H$_4$", 1.0, False),
    ("X_O2", "X_O2", "X O$_2$", 1.0, False),
    ("X_OH", "X_OH", "X OH", 1.0, False),
    ("X_C2H2", "X_C2H2", "X C$_2$H$_2$", 1.0, False),
    ("X_A1", "X_A1", "X benzene (A1), ppm", 1e6, False),
    ("X_A2", "X_A2", "X naphthalene (A2), ppm", 1e6, False),
    ("soot_volume_fraction", None, "soot volume fraction, ppb", 1e9, False),
    ("soot_number_density", None, "soot number, 1/cm$^3$", 1e-6, False),
]


def plot_profiles(results, pictures, references):
    """One picture with a panel for each profile that the results hold."""
    if not results.steps:
        pictures.skip("centreline profiles", "no step was written")
        return
    column, z = results.centreline()
    if len(column) < 2:
        pictures.skip("centreline profiles", "there is no column of cells along the axis")
        return
    present = []
    for field, reference_column, label, factor, _ in PROFILES:
        values = results.field(field)
        if values is None:
            pictures.skip(f"centreline profile of {field}", "the results hold no such field")
            continue
        values = values[column, 1] if values.ndim == 2 else values[column]
        present.append((label, reference_column, values * factor, factor))
    if not present:
        return
    along = results.axis_names()[1]
    columns = 2
    rows = (len(present) + columns - 1) // columns
    figure, panels = plt.subplots(rows, columns, figsize=(9.0, 2.3 * rows), sharex=True, squeeze=False)
    for axes, (label, reference_column, values, factor) in zip(panels.flat, present):
        axes.plot(z * 1e3, values, color="tab:red", label="Lampblack")
        for path in references:
            reference = read_reference(path)
            if reference_column in reference:
                axes.plot(reference["z_m"] * 1e3, reference[reference_column] * factor, "k--", lw=1.0, label=path.stem)
        axes.set_ylabel(label)
    for axes in list(panels.flat)[len(present) :]:
        axes.set_axis_off()
    for axes in panels[-1]:
        axes.set_xlabel(f"{along}, mm")
    panels[0][0].legend(fontsize=7)
    line = "Centreline" if along == "z" else f"Along y at x = {results.centres[column[0], 0] * 1e3:.3g} mm"
    figure.suptitle(f"{line} at t = {shown_time(results.time(results.steps[-1]))}")
    pictures.save(figure, "centreline")
