"""Fields at places in the mesh of a flow: continuous, and never beyond what the cells around have."""

import numpy as np

from .errors import ResultsError

# Sides of cells in space by how many corners they have, in the order of VTK.
SIDES = {4: ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)), 5: ((0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
         6: ((0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
         8: ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))}
OUTSIDE = {2: 1e-9, 3: 1e-2}  # so little a place may be outside, over the size of a part of a cell; sides in space may be bent


class LineOfPlaces:
    """Places on a straight line, and what cells and vertices count for there."""

    def __init__(self, results, start, end, points):
        self._dimension = 2 if results.is_plane else 3
        self._vertices, self._centres = (of[:, :self._dimension] for of in (results.vertices, results.centres))
        self._cells = results.cells
        start, end = (self._place(of) for of in (start, end))
        if points < 2 or np.array_equal(start, end):
            raise ResultsError("a line needs two ends that differ, and two points or more")
        share = np.linspace(0.0, 1.0, points)
        self.places = start + share[:, None] * (end - start)
        self.distance = share * np.linalg.norm(end - start)
        # Of each place its cell, how deep it is in the best part of it, and the vertices of the part with their weights.
        self._cell, self._depth = np.full(points, -1), np.full(points, -np.inf)
        self._own, self._parts = np.zeros(points), [((), ())] * points
        self._find(start, end, share)
        self._correct()

    def _place(self, given):
        place = np.asarray(given, dtype=float)
        if place.shape != (self._dimension,) or not np.all(np.isfinite(place)):
            raise ResultsError(f"a place in this mesh has {self._dimension} coordinates in m, found {given}")
        return place

    def _find(self, start, end, share):
        """Looks for the parts of cells that the places are in, among the cells that the line may go through."""
        slack = 1e-9 * np.ptp(self._vertices, axis=0).max()
        first, last = np.full(len(self._cells), -slack), np.full(len(self._cells), 1.0 + slack)
        for axis in range(self._dimension):
            corners = self._vertices[self._cells, axis]
            low, high = corners.min(axis=1) - slack, corners.max(axis=1) + slack
            way = end[axis] - start[axis]
            if way == 0:
                last[(start[axis] < low) | (start[axis] > high)] = -1.0
                continue
            ends = np.sort([(low - start[axis]) / way, (high - start[axis]) / way], axis=0)
            first, last = np.maximum(first, ends[0]), np.minimum(last, ends[1])
        for cell in np.flatnonzero(first <= last):
            of = np.flatnonzero((share >= first[cell] - 1e-12) & (share <= last[cell] + 1e-12))
            if of.size:
                self._try(cell, of)
        outside = self._depth < -OUTSIDE[self._dimension]
        if np.any(outside):
            raise ResultsError(f"the place {tuple(float(x) for x in self.places[np.argmax(outside)])} m is outside the mesh")

    def _corners(self, cell):
        """Without those that stand there again."""
        corners = self._cells[cell]
        return corners[np.append(True, corners[1:] != corners[:-1])]

    def _try(self, cell, of):
        """Triangles or tetrahedra around the centre: in each the values at its corners are linear."""
        corners = self._corners(cell)
        count = len(corners)
        sides = [(k, (k + 1) % count) for k in range(count)] if self._dimension == 2 else SIDES[count]
        for side in sides:
            numbers = corners[list(side)]
            edges = self._vertices[numbers] - self._centres[cell]
            if self._dimension == 2:
                self._part(cell, of, numbers, edges, np.eye(2))
                continue
            mean = np.full(len(numbers), 1.0 / len(numbers))
            for k in range(len(numbers)):
                shares = np.stack([mean, *np.eye(len(numbers))[[k, (k + 1) % len(numbers)]]])
                self._part(cell, of, numbers, shares @ edges, shares)

    def _part(self, cell, of, numbers, edges, shares):
        """`shares`: what the vertices count for in the corners of the part but the centre."""
        if abs(np.linalg.det(edges)) < 1e-300:
            return
        weights = np.linalg.solve(edges.T, (self.places[of] - self._centres[cell]).T).T
        own = 1.0 - weights.sum(axis=1)
        depth = np.minimum(own, weights.min(axis=1))
        for i in np.flatnonzero(depth > self._depth[of] + 1e-12):
            place = of[i]
            self._depth[place], self._cell[place], self._own[place] = depth[i], cell, own[i]
            self._parts[place] = (numbers, weights[i] @ shares)

    def _correct(self):
        """What the cells around count for at each vertex: a linear field by least squares over them."""
        wanted = np.unique(np.concatenate([numbers for numbers, _ in self._parts]))
        cells, corners = np.nonzero(np.isin(self._cells, wanted))
        pairs = np.unique(np.stack([self._cells[cells, corners], cells], axis=1), axis=0)
        begin = np.searchsorted(pairs[:, 0], wanted)
        self._around = {}
        for vertex, around in zip(wanted, np.split(pairs[:, 1], begin[1:])):
            ways = self._centres[around] - self._vertices[vertex]
            root = 1.0 / np.sqrt(np.linalg.norm(ways, axis=1))
            mean = root**2 / np.sum(root**2)
            slopes = np.linalg.pinv(root[:, None] * (ways - mean @ ways), rcond=1e-6) * root
            led = -(mean @ ways) @ slopes
            self._around[vertex] = (around, mean + led - led.sum() * mean)

    def values(self, cells):
        """Of values of all cells, numbers or vectors, those at the places."""
        at = {}
        for vertex, (around, shares) in self._around.items():
            values = cells[around]
            at[vertex] = np.clip(np.tensordot(shares, values, 1), values.min(axis=0), values.max(axis=0))
        return np.array([own * cells[cell] + sum(weight * at[vertex] for vertex, weight in zip(numbers, weights))
                         for own, cell, (numbers, weights) in zip(self._own, self._cell, self._parts)])
