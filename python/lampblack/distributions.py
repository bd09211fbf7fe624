"""Size distributions, of whatever kind of results, in one form."""

import dataclasses

import numpy as np

from .arrays import Array, array_of


@dataclasses.dataclass
class Distribution:
    """Densities over sizes: a row for each time, place or cell (`along`; None where there is one row for each cell), a column for
    each size. `edges` are those of the bins, or None where the sizes are those of sections."""

    sizes: Array
    density: Array
    along: Array | None = None
    edges: Array | None = None
    error: Array | None = None  # standard error

    def at(self, place):
        """The row nearest to a time or place: its density."""
        if self.along is None:
            raise ValueError("rows of cells are chosen by their number: density[cell]")
        return self.density[int(np.argmin(np.abs(np.asarray(self.along) - place)))]


def _middles(edges):
    return Array(np.sqrt(np.asarray(edges[1:]) * np.asarray(edges[:-1])), edges.name, edges.unit, "middles of the bins")


def _of_group(group, density, sizes=None, edges=None, along=None, error=None):
    """From the names of datasets in a group, those that are there; `along` may be an Array already."""
    edges = array_of(group[edges]) if edges and edges in group else None
    sizes = array_of(group[sizes]) if sizes and sizes in group else _middles(edges)
    along = array_of(group[along]) if isinstance(along, str) else along
    return Distribution(sizes, array_of(group[density]), along, edges, array_of(group[error]) if error and error in group else None)


def distributions_of(results):
    """Every size distribution of the results, by name: of methods, paths and trajectories theirs, otherwise 'soot' and the like.
    Of flows those of the cells in the last step."""
    file, found = results.file, {}
    flame = file.get("flame/soot")
    if flame is not None and "size_distribution" in flame:
        found["soot"] = _of_group(flame, "size_distribution", sizes="diameter", along=array_of(file["flame/z"]))
    for name, path in file.get("stochastic", {}).items():
        if "distribution" in path:
            found[name] = _of_group(path, "distribution", edges="bin_edges", along="distribution_z", error="distribution_error")
    found.update(_of_particles(file))
    for name, path in file.get("trajectories", {}).items():
        found[f"trajectory_{name}"] = _of_group(path, "size_distribution", edges="bin_edges", along="time")
    for name, method in file.get("methods", {}).items():
        if "distribution" in method and method["distribution/number"].size:
            found[name] = _of_group(method["distribution"], "number", edges="bin_edges", along="time", error="number_error")
    cells = f"{results.material}_size_distribution"
    if results.steps and cells in results.fields(results.steps[-1]):
        edges = array_of(file[f"{results.material}_sizes/bin_edges"])
        density = results.fields(results.steps[-1])[cells]
        found[results.material] = Distribution(_middles(edges), array_of(density), None, edges)
    return found


def _of_particles(file):
    """Of reactors and of particles along a gas: a row for each of the history, or for each reactor."""
    group, found = file.get("particles", {}), {}
    rows = file.get("history", {})
    along = next((array_of(rows[name]) for name in ("position", "time") if name in rows), None)
    for name in group:
        kind, _, rest = name.partition("size_distribution")
        if not rest and kind != name:
            edges = "bin_edges" if "bin_edges" in group else None
            found[kind.rstrip("_") or "soot"] = _of_group(group, name, sizes="diameter", edges=edges, along=along, error=name + "_error")
    return found
