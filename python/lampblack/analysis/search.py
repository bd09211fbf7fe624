"""Local searches on the unit cube. They ask for residuals of many points at once, as runs go side by side."""

import numpy as np
from scipy.optimize import least_squares, minimize

METHODS = ("least_squares", "nelder_mead", "hooke_jeeves")


class _Enough(Exception):
    """A search has asked for as many points as it may."""


class Asked:
    """Residuals of points, each asked for once, and the best of them. A failed run has none: its objective is infinite."""

    def __init__(self, residuals, most=None):
        self._residuals, self._most = residuals, most
        self._known, self.best, self.phi = {}, None, np.inf

    def __call__(self, points):
        points = np.atleast_2d(points)
        new = list(dict.fromkeys(tuple(x) for x in points if tuple(x) not in self._known))
        if self._most is not None and len(self._known) + len(new) > self._most:
            raise _Enough
        if new:
            for x, rest in zip(new, self._residuals(np.array(new))):
                self._known[x] = rest
                phi = objective(rest)
                if phi < self.phi:
                    self.best, self.phi = np.array(x), phi
        return [self._known[tuple(x)] for x in points]

    @property
    def count(self):
        return len(self._known)


def objective(residuals):
    phi = float(np.sum(np.square(residuals)))
    return phi if np.isfinite(phi) else np.inf


def difference_points(x, step, central):
    """The points of `jacobian`: one step away from the nearer bound, or one to each side."""
    points = []
    for i in range(len(x)):
        up, down = min(x[i] + step, 1.0), max(x[i] - step, 0.0)
        ends = (up, down) if central else ((up, x[i]) if x[i] <= 0.5 else (x[i], down))
        for end in ends:
            points.append(np.array(x, float))
            points[-1][i] = end
    return np.array(points)


def jacobian(residuals, x, step, central=False):
    """d(residual)/dx by differences, a column a parameter; nan where a run failed."""
    points = difference_points(x, step, central)
    values = residuals(points)
    columns = [(values[2 * i] - values[2 * i + 1]) / (points[2 * i][i] - points[2 * i + 1][i]) for i in range(len(x))]
    return np.array(columns).T


def _by_derivatives(asked, x, step, tolerance):
    def slopes(at):
        j = jacobian(asked, at, step)
        if not np.all(np.isfinite(j)):
            raise _Enough  # a run beside the point failed: there is no way to go on from here
        return j

    least_squares(lambda at: asked(at)[0], x, jac=slopes, bounds=(0.0, 1.0), method="trf", ftol=tolerance, xtol=tolerance, gtol=1e-10)


def _nelder_mead(asked, x, step, tolerance):
    first = np.array([x] + [np.clip(x + (1 if x[i] < 0.5 else -1) * max(0.1, step) * (np.arange(len(x)) == i), 0, 1) for i in range(len(x))])
    minimize(lambda at: min(objective(asked(np.clip(at, 0, 1))[0]), 1e300), x, method="Nelder-Mead", bounds=[(0, 1)] * len(x),
             options={"initial_simplex": first, "xatol": tolerance, "fatol": tolerance * max(1.0, asked.phi), "maxiter": 10**6})


def _hooke_jeeves(asked, x, step, tolerance):
    size, value = max(0.1, step), objective(asked(x)[0])
    while size > tolerance:
        base = x.copy()
        for i in range(len(x)):
            ends = np.clip([x + size * (np.arange(len(x)) == i), x - size * (np.arange(len(x)) == i)], 0, 1)
            found = [objective(rest) for rest in asked(ends)]
            if min(found) < value:
                x, value = ends[int(np.argmin(found))], min(found)
        if np.array_equal(x, base):
            size /= 2
            continue
        ahead = np.clip(2 * x - base, 0, 1)
        if (there := objective(asked(ahead)[0])) < value:
            x, value = ahead, there


def search(residuals, start, method, step=0.01, tolerance=1e-3, most=None):
    """The best point that a search from `start` found, its objective, the points it asked for, and whether it ended by itself."""
    asked, ended = Asked(residuals, most), True
    try:
        if not np.all(np.isfinite(asked(start)[0])):
            return np.array(start), np.inf, asked.count, False
        {"least_squares": _by_derivatives, "nelder_mead": _nelder_mead, "hooke_jeeves": _hooke_jeeves}[method](
            asked, np.array(start, float), step, tolerance)
    except _Enough:
        ended = False
    return asked.best, asked.phi, asked.count, ended
