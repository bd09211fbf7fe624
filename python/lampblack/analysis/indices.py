"""Which parameters matter, from values at points of the unit cube: Sobol indices (Sobol 2001; Saltelli et al. 2010; Jansen's total
index), elementary effects (Morris 1991; Campolongo et al. 2007), normalised derivatives."""

import numpy as np
from scipy.stats import qmc

from ..errors import InputError


def saltelli_points(count, dimensions, seed):
    """N (d + 2) points: A, B, and A with one column of B for each parameter."""
    if count & (count - 1):
        raise InputError(f"sensitivity.points: a power of two is expected, found {count}")
    both = qmc.Sobol(2 * dimensions, scramble=True, seed=seed).random_base2(count.bit_length() - 1)
    a, b = both[:, :dimensions], both[:, dimensions:]
    mixed = []
    for i in range(dimensions):
        mixed.append(a.copy())
        mixed[-1][:, i] = b[:, i]
    return np.concatenate([a, b, *mixed])


def _saltelli(blocks):
    a, b, mixed = blocks[0], blocks[1], blocks[2:]
    both = np.concatenate([a, b])
    variance = np.var(both)
    if variance == 0:
        return np.zeros(len(mixed)), np.zeros(len(mixed))
    first = np.mean((b - both.mean()) * (mixed - a), axis=1) / variance
    return first, np.mean((a - mixed) ** 2, axis=1) / (2 * variance)


def saltelli_indices(values, count, seed, repeats=500):
    """First and total indices, and of each the interval of 95 % by bootstrap: two arrays (d, 3) of value, low, high. Points of which one
    run failed (nan) are left out."""
    blocks = np.asarray(values).reshape(-1, count)
    blocks = blocks[:, np.all(np.isfinite(blocks), axis=0)]
    if blocks.shape[1] < 4:
        raise InputError("sensitivity: fewer than four points have all their runs")
    draw = np.random.default_rng(seed)
    drawn = np.array([_saltelli(blocks[:, draw.integers(0, blocks.shape[1], blocks.shape[1])]) for _ in range(repeats)])
    low, high = np.percentile(drawn, [2.5, 97.5], axis=0)
    first, total = _saltelli(blocks)
    return np.stack([first, low[0], high[0]], axis=1), np.stack([total, low[1], high[1]], axis=1)


def morris_points(trajectories, dimensions, levels, seed):
    """Trajectories of d + 1 points on levels, one below the other, and the parameters in the order in which each moves them, with the sign of the step."""
    if levels % 2:
        raise InputError(f"sensitivity.levels: an even number is expected, found {levels}")
    draw = np.random.default_rng(seed)
    step = levels / (2 * (levels - 1))
    points, moves = [], []
    for _ in range(trajectories):
        x = draw.integers(0, levels // 2, dimensions) / (levels - 1)
        signs = draw.choice([-1, 1], dimensions)
        x = np.where(signs > 0, x, x + step)
        order = draw.permutation(dimensions)
        points.append(x.copy())
        for i in order:
            x[i] += signs[i] * step
            points.append(x.copy())
        moves.append([(int(i), int(signs[i])) for i in order])
    return np.clip(points, 0, 1), moves


def morris_effects(values, moves, levels):
    """mu, mu*, sigma of each parameter: the change of the value over its whole range."""
    dimensions = len(moves[0])
    step = levels / (2 * (levels - 1))
    rows = np.asarray(values).reshape(len(moves), dimensions + 1)
    effects = [[] for _ in range(dimensions)]
    for row, move in zip(rows, moves):
        for place, (i, sign) in enumerate(move):
            effect = sign * (row[place + 1] - row[place]) / step
            if np.isfinite(effect):
                effects[i].append(effect)
    if min(map(len, effects)) < 2:
        raise InputError("sensitivity: fewer than two elementary effects of a parameter have both their runs")
    return np.array([[np.mean(e), np.mean(np.abs(e)), np.std(e, ddof=1)] for e in effects])


def local_points(start, step):
    """Two points for each parameter, one step of the range to both sides of the start, or as far as the bounds let."""
    points = []
    for i in range(len(start)):
        for sign in (1, -1):
            x = np.array(start, float)
            x[i] = np.clip(x[i] + sign * step, 0, 1)
            points.append(x)
    return np.array(points)


def local_sensitivities(values, points, slopes, errors=None):
    """d ln f / d ln theta of each parameter from values at `local_points`, and its standard error where the values have some. `slopes` is
    d x / d ln theta at the start."""
    f = np.asarray(values).reshape(-1, 2)
    width = np.array([points[2 * i, i] - points[2 * i + 1, i] for i in range(len(f))])
    with np.errstate(divide="ignore", invalid="ignore"):
        positive = np.all(f > 0, axis=1) | np.all(f < 0, axis=1)
        change = np.where(positive, np.log(np.abs(f[:, 0])) - np.log(np.abs(f[:, 1])), np.nan)
        relative = np.zeros_like(f) if errors is None else np.asarray(errors).reshape(-1, 2) / np.abs(f)
    return change / width * slopes, np.abs(np.hypot(relative[:, 0], relative[:, 1]) / width * slopes)
