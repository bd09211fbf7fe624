#!/usr/bin/python3
"""Wang's equation beside a wall where gas is nearly at rest, by finite volumes in one dimension and Newton's method.

Usage: still_layer.py

With F_1 = 1, beta nu~ S + gamma nu~ (ln S)' nu~' + ((nu + alpha nu~) nu~')' = 0 between a wall (nu~ = 0) and a held nu~ of 200 nu 5 mm
away, S = 100/s (s + (y/5 mm)^n), by three ways to take the cross term: by the parabola through a cell's neighbours and the wall; the
same, by no more than twice what the slopes towards the neighbours above and below say; and as factors (S_face/S_cell)^(gamma/alpha) - 1
of the differences between neighbours, with which no cell exceeds all its neighbours but by beta nu~ S. Prints in these three columns the
largest nu~/nu of the steady state. Where none is found: "grows" where it has passed 1e6; "stops" where no time step is short enough, with
the value by then, which if small is no proof that it grows; "swings" where 800 iterations do not settle to 1e-7, with the last value.
"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
from three_bands import derivatives  # noqa: E402

ALPHA, BETA, GAMMA = 1.2, 0.084, 1.7  # beside walls (Wang 2025, equations 8-16 to 8-21)
NU, LENGTH, OUTSIDE = 1.5e-5, 5e-3, 200 * 1.5e-5  # m^2/s, m, m^2/s
LEAST_STRAIN = 1e-16  # 1/s


def slope(values, gaps):
    """Of the parabola through three values."""
    before, after = gaps[:-1], gaps[1:]
    low, own, high = values[:-2], values[1:-1], values[2:]
    return (before**2 * (high - own) + after**2 * (own - low)) / (before * after * (before + after))


def between(low, value, high):
    """`value` within limits, by real parts (derivatives are taken in the imaginary direction)."""
    value = np.where(value.real < low.real, low, value)
    return np.where(value.real > high.real, high, value)


def rates(n, faces, strain, way):
    """m^2/s^2, in each cell."""
    y, h = 0.5 * (faces[1:] + faces[:-1]), np.diff(faces)
    gaps = np.diff(np.r_[0.0, y, LENGTH])
    own, atFace = (np.log(np.maximum(strain(x), LEAST_STRAIN)) for x in (y, faces))
    values = np.r_[0.0, n, OUTSIDE]
    ofFace = np.r_[0.0, 0.5 * (n[1:] + n[:-1]), OUTSIDE]
    rises = np.diff(values) / gaps
    result = np.diff((NU + ALPHA * ofFace) * rises) / h + BETA * n * strain(y)
    if way == "factors":
        p = GAMMA / ALPHA
        after = ofFace[1:] * np.expm1(p * (atFace[1:] - own)) * rises[1:]
        before = ofFace[:-1] * np.expm1(p * (atFace[:-1] - own)) * rises[:-1]
        return result + ALPHA * (after - before) / h
    ofStrain = slope(np.r_[atFace[0], own, atFace[-1]], gaps)
    product = ofStrain * slope(values, gaps)
    if way == "limited":
        rising = [between(np.zeros_like(n), side, np.full_like(n, np.inf)) for side in (rises[1:], -rises[:-1])]
        falling = [between(np.full_like(n, -np.inf), side, np.zeros_like(n)) for side in (rises[1:], -rises[:-1])]
        above = np.where(rising[0].real > rising[1].real, *rising)
        below = np.where(falling[0].real < falling[1].real, *falling)
        product = between(2 * abs(ofStrain) * below, product, 2 * abs(ofStrain) * above)
    return result + GAMMA * n * product


def solve(bands, right):
    """Thomas's algorithm; bands[i, j]: of the equation j + i - 1 by the unknown j."""
    diagonal, right = bands[1].copy(), right.copy()
    for i in range(1, right.size):
        share = bands[2, i - 1] / diagonal[i - 1]
        diagonal[i] -= share * bands[0, i]
        right[i] -= share * right[i - 1]
    for i in range(right.size - 1, -1, -1):
        if i + 1 < right.size:
            right[i] -= bands[0, i + 1] * right[i + 1]
        right[i] /= diagonal[i]
    return right


def steady(cells, ratio, strain, way, steps=800):
    """The largest nu~/nu, as told."""
    sizes = ratio ** (np.arange(cells) / (cells - 1))
    faces = np.r_[0.0, np.cumsum(sizes)] * LENGTH / sizes.sum()
    n, dt = np.full(cells, 3 * NU), 1e-5
    for _ in range(steps):
        bands = -derivatives(lambda of: [rates(of[0], faces, strain, way)], [n])[0][0]
        bands[1] += 1 / dt
        change = solve(bands, rates(n, faces, strain, way))
        share = np.abs(change / n).max()
        if not share < 1 or np.any(n + change <= 0):
            dt *= 0.5
            if dt < 1e-13:
                return f"stops ({n.max() / NU:.3g})"
            continue
        n = n + change
        if n.max() > 1e6 * NU:
            return "grows (1e6)"
        if share < 1e-7 and dt > 1:
            return f"{n.max() / NU:.2f}"
        if share < 0.2:
            dt *= 1.5
    return f"swings ({n.max() / NU:.2f})"


def main():
    ways = ("parabola", "limited", "factors")
    print("n    s      cells  ratio  " + "  ".join(f"{way:>15}" for way in ways))
    for power, atWall in ((0.5, 0.0), (1, 0.0), (1, 1e-2), (1, 1e-4), (2, 0.0), (2, 1e-4)):
        for cells, ratio in ((8, 1), (32, 1), (64, 50), (128, 1e4)):
            found = [steady(cells, ratio, lambda y: 100 * (atWall + (y / LENGTH) ** power), way) for way in ways]
            print(f"{power:<4} {atWall:<6g} {cells:<6} {ratio:<6g} " + "  ".join(f"{of:>15}" for of in found), flush=True)


if __name__ == "__main__":
    with np.errstate(all="ignore"):
        main()
