"""Polynomials in place of runs: RS-HDMR, orthonormal shifted Legendre polynomials of one and two parameters on the unit cube
(Rabitz and Alis 1999; Sobol indices from the coefficients: Sudret 2008)."""

import itertools

import numpy as np

from ..errors import NumericsError


NOT_BELOW = 1.2  # how near to points left out a surrogate may come, in standard errors of the runs


def legendre(x, order):
    """Values of the polynomials of degree 0 to order at x in [0, 1], orthonormal there: a column a degree."""
    x = 2 * np.asarray(x, float) - 1
    values = np.ones((len(x), order + 1))
    if order > 0:
        values[:, 1] = x
    for n in range(1, order):
        values[:, n + 1] = ((2 * n + 1) * x * values[:, n] - n * values[:, n - 1]) / (n + 1)
    return values * np.sqrt(2 * np.arange(order + 1) + 1)


def terms_up_to(order, dimensions, pairs):
    """Degrees of each parameter in each term, the constant first: total degree up to order, two parameters at most."""
    terms = [(0,) * dimensions]
    for i in range(dimensions):
        terms += [tuple(n if j == i else 0 for j in range(dimensions)) for n in range(1, order + 1)]
    if pairs:
        for i, j in itertools.combinations(range(dimensions), 2):
            terms += [tuple(a if k == i else b if k == j else 0 for k in range(dimensions))
                      for a in range(1, order) for b in range(1, order + 1 - a)]
    return np.array(terms)


def basis(x, terms):
    """A row a point, a column a term."""
    x = np.atleast_2d(x)
    columns = [legendre(x[:, i], int(terms.max(initial=0))) for i in range(x.shape[1])]
    values = np.ones((len(x), len(terms)))
    for i, one in enumerate(columns):
        values *= one[:, terms[:, i]]
    return values


def left_out(matrix, f):
    """Least squares, and its residuals at each point when that point is left out."""
    q, r = np.linalg.qr(matrix)
    if np.min(np.abs(np.diag(r))) < 1e-10 * np.max(np.abs(np.diag(r))):
        return None, np.full(len(f), np.inf)
    coefficients = np.linalg.solve(r, q.T @ f)
    leverage = np.sum(q * q, axis=1)
    return coefficients, (f - matrix @ coefficients) / np.maximum(1 - leverage, 1e-12)


def _r2(rest, f, floor=0.0):
    """Differences below a floor, in the mean, are all alike."""
    spread = np.sum((f - f.mean()) ** 2)
    return 1 - max(np.sum(rest**2), len(f) * floor**2) / spread if spread > 0 else 1.0


def _selected(matrix, f, floor):
    """Columns taken one after another, each the one most like what is left, as long as the points left out agree better: at most one
    for two points."""
    chosen, best, best_r2 = [0], [0], -np.inf
    rest = f - f.mean()
    norms = np.linalg.norm(matrix, axis=0)
    misses = 0
    while len(chosen) < min(len(f) // 2, matrix.shape[1]) and misses < 5:
        likeness = np.abs(matrix.T @ rest) / norms
        likeness[chosen] = -1
        chosen.append(int(np.argmax(likeness)))
        coefficients, outside = left_out(matrix[:, chosen], f)
        if coefficients is None:
            break
        rest = f - matrix[:, chosen] @ coefficients
        r2 = _r2(outside, f, floor)
        misses = 0 if r2 > best_r2 else misses + 1
        if r2 > best_r2:
            best, best_r2 = list(chosen), r2
    return sorted(best), best_r2


class Surrogate:
    """One number as a polynomial of the parameters. `r2` is that of the fifth of the points that was held out while the terms were
    chosen and fitted; the coefficients are then those of all points. `noise` is the standard error of f: terms that only follow it are
    not taken."""

    def __init__(self, x, f, order, pairs=True, noise=0.0):
        x, f = np.atleast_2d(x), np.asarray(f, float)
        if len(f) < 5:
            raise NumericsError(f"surrogate: {len(f)} points that ran are not enough for a polynomial; increase design.points")
        held = np.arange(len(f)) % 5 == 2
        everything = terms_up_to(order, x.shape[1], pairs)
        degree = everything.sum(axis=1)
        inside, f_inside = basis(x[~held], everything), f[~held]
        best, best_r2, floor = [0], -np.inf, NOT_BELOW * noise
        for most in range(1, order + 1):
            columns = np.flatnonzero(degree <= most)
            if 2 * len(columns) > len(f_inside):
                break
            r2 = _r2(left_out(inside[:, columns], f_inside)[1], f_inside, floor)
            if r2 > best_r2:
                best, best_r2 = columns, r2
        if 2 * len(everything) > len(f_inside):  # too few points for all terms: those that matter
            columns, r2 = _selected(inside, f_inside, floor)
            if r2 > best_r2:
                best = columns
        self.terms = everything[best]
        coefficients, _ = left_out(inside[:, best], f_inside)
        self.r2 = _r2(f[held] - basis(x[held], self.terms) @ coefficients, f[held])
        self.coefficients, rest = left_out(basis(x, self.terms), f)
        self.deviation = float(np.sqrt(np.mean(rest**2)))  # of a point that is left out

    def __call__(self, x):
        return basis(x, self.terms) @ self.coefficients

    @property
    def mean(self):
        return self.coefficients[0]

    @property
    def variance(self):
        return float(np.sum(self.coefficients[1:] ** 2))

    def sobol_indices(self):
        """S_i of each parameter alone, S_Ti of it with all others."""
        uses, squares = self.terms > 0, self.coefficients**2
        variance = self.variance
        if variance == 0:
            return np.zeros(uses.shape[1]), np.zeros(uses.shape[1])
        alone = uses & (uses.sum(axis=1) == 1)[:, None]
        return squares @ alone / variance, squares @ uses / variance


class Together:
    """Many surrogates of the same parameters at once: the terms of all, each evaluated once."""

    def __init__(self, surrogates):
        self.terms, places = np.unique(np.concatenate([s.terms for s in surrogates]), axis=0, return_inverse=True)
        self.coefficients, begin = np.zeros((len(self.terms), len(surrogates))), 0
        for k, s in enumerate(surrogates):
            self.coefficients[places[begin:begin + len(s.terms)], k] = s.coefficients
            begin += len(s.terms)

    def __call__(self, x):
        """A row a point, a column a surrogate."""
        return basis(x, self.terms) @ self.coefficients
