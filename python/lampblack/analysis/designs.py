"""Points of the unit cube to run."""

import itertools

import numpy as np
from scipy.stats import qmc

from ..errors import InputError


def sobol(points, dimensions, seed):
    """Scrambled Sobol points; their number is a power of two, without which they lose their balance."""
    if points & (points - 1):
        raise InputError(f"design.points: Sobol points come in powers of two, such as {1 << (points.bit_length() - 1)} or "
                         f"{1 << points.bit_length()}; found {points}")
    return qmc.Sobol(dimensions, scramble=True, seed=seed).random_base2(points.bit_length() - 1)


def latin_hypercube(points, dimensions, seed):
    return qmc.LatinHypercube(dimensions, seed=seed).random(points)


def factorial(levels, dimensions):
    """All combinations of so many levels from bound to bound, the last parameter fastest."""
    if levels**dimensions > 100000:
        raise InputError(f"design.levels: {levels} levels of {dimensions} parameters are {levels**dimensions} points; at most 100000 are possible")
    return np.array(list(itertools.product(np.linspace(0, 1, levels), repeat=dimensions)))


def one_at_a_time(start, levels):
    """The start, then each parameter at its levels with all others at the start."""
    points = [np.array(start)]
    for i in range(len(start)):
        for level in np.linspace(0, 1, levels):
            if abs(level - start[i]) > 1e-12:
                points.append(np.array(start))
                points[-1][i] = level
    return np.array(points)
