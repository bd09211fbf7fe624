"""The cells as polygons in a plane, the edges of their surface, and what lies inside it."""

import numpy as np
from matplotlib import tri


class Shapes:
    """What is drawn of the mesh of a run: `polygons` (m) of the cells with the numbers `cells`."""

    def __init__(self, results):
        self.cut = None
        if results.is_plane:
            self.cells = np.arange(len(results.cells))
            self.polygons = list(results.vertices[results.cells][:, :, :2])
            self._corners = results.cells
            self._vertices = results.vertices[:, :2]
        else:
            self._cut_in_the_middle(results)

    def _cut_in_the_middle(self, results):
        """The cells that the plane through the middle of the third axis goes through, cut by it."""
        places = results.vertices[results.cells]
        low, high = places[:, :, 2].min(), places[:, :, 2].max()
        self.cut = 0.5 * (low + high)
        # Not through the vertices of a layer.
        plane = self.cut + 1e-7 * (high - low)
        self.cells = np.flatnonzero((places[:, :, 2].min(axis=1) < plane) & (places[:, :, 2].max(axis=1) > plane))
        self.polygons = [_section(places[cell], plane) for cell in self.cells]
        self._centres = results.centres[self.cells, :2]
        self._corners = None

    def surface(self):
        """Edges (m) that belong to one cell alone; none of a cut."""
        if self._corners is None:
            return np.empty((0, 2, 2))
        edges = np.concatenate([self._corners[:, [k, (k + 1) % self._corners.shape[1]]]
                                for k in range(self._corners.shape[1])])
        edges = np.sort(edges[edges[:, 0] != edges[:, 1]], axis=1)
        edges, count = np.unique(edges, axis=0, return_counts=True)
        return self._vertices[edges[count == 1]]

    def values_at(self, values, x, y):
        """Values of the cells, given for all of them, at places (m): linear between the vertices, each of which has the mean of
        its cells; 0 where there is no cell."""
        if self._corners is None:
            mesh = tri.Triangulation(*self._centres.T)
            return np.ma.filled(tri.LinearTriInterpolator(mesh, values[self.cells])(x, y), 0.0)
        corners = self._corners
        triangles = np.concatenate([corners[:, [0, k, k + 1]] for k in range(1, corners.shape[1] - 1)])
        cell = np.tile(np.arange(len(corners)), corners.shape[1] - 2)
        whole = (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 0] != triangles[:, 1])
        triangles, cell = triangles[whole], cell[whole]
        mesh = tri.Triangulation(*self._vertices.T, triangles)
        size = np.bincount(triangles.ravel(), minlength=len(self._vertices))
        total = np.bincount(triangles.ravel(), weights=np.repeat(values[cell], 3), minlength=len(self._vertices))
        return np.ma.filled(tri.LinearTriInterpolator(mesh, total / np.maximum(size, 1))(x, y), 0.0)


def _section(corners, height):
    """Where a convex cell meets the plane z = height: the hull of where the lines between its corners do."""
    low, high = corners[corners[:, 2] < height], corners[corners[:, 2] >= height]
    share = (height - low[:, None, 2]) / (high[None, :, 2] - low[:, None, 2])
    places = (low[:, None, :2] + share[..., None] * (high[None, :, :2] - low[:, None, :2])).reshape(-1, 2)
    return _hull(places)


def _hull(places):
    """Counter-clockwise (Andrew's monotone chain)."""
    places = places[np.lexsort((places[:, 1], places[:, 0]))]

    def half(points):
        chain = []
        for point in points:
            while len(chain) > 1 and np.cross(chain[-1] - chain[-2], point - chain[-1]) <= 0:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return np.array(half(places) + half(places[::-1]))
