#!/usr/bin/python3
"""Standard k-epsilon that resolves the layer beside the wall by algebraic lengths, in a developed channel, by Newton's method.

Usage: two_layer_channel.py RE_TAU CELLS [TABLE.csv]

Half a channel in units of half height and friction velocity, cells that grow away from the wall, where k is zero. Momentum is taken once
integrated, (nu + nu_t) dU/dy = 1 - y. Where k^(1/2) y/nu is below 200 epsilon and nu_t are those of algebraic lengths, beyond those of the
model; the shares pass from one to the other as in docs/theory/turbulence.md, "Wall functions". Prints the mean velocity U_b+ and writes the
velocity over the distance from the wall.
"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
from three_bands import derivatives, entries  # noqa: E402

CMU, C1, C2, SIGMA_E, KAPPA = 0.09, 1.44, 1.92, 1.3, 0.41
LENGTH = KAPPA * CMU**-0.75


def residual(values, nu, y, size, below):
    """Of S = dU/dy, k and epsilon in each cell."""
    S, k, e = values
    speed = np.sqrt(np.where(k.real > 1e-14, k, 1e-14))
    reynolds = speed * y / nu
    width = 40 / np.arctanh(0.98)
    outer = 0.5 * (1 + np.tanh((np.where(reynolds.real < 2000, reynolds, 2000) - 200) / width))
    inner_e = speed**3 / (LENGTH * y * (1 - np.exp(-reynolds / (2 * LENGTH))))
    inner_nu = CMU * speed * LENGTH * y * (1 - np.exp(-reynolds / 70))
    nu_t = outer * CMU * k * k / e + (1 - outer) * inner_nu

    def spread(D, f, wall, ends):
        D, f = np.concatenate([[nu if ends else D[0]], D]), np.concatenate([[wall], f])
        flux = np.append(0.5 * (D[1:] + D[:-1]) * np.diff(f) / below, 0.0)
        return np.diff(flux) / size

    of_k = nu_t * S * S - outer * e - (1 - outer) * inner_e + spread(nu + nu_t, k, 0.0, True)
    model = C1 * CMU * k * S * S - C2 * e * e / k + spread(nu + nu_t / SIGMA_E, e, e[0], False)
    return [(nu + nu_t) * S - (1 - y), of_k, outer * model + 30 * (1 - outer) * (inner_e - e)]


def solve(reynolds, n):
    nu, stretch = 1 / reynolds, max(2.6, 0.5 * np.log(reynolds) + 0.35)
    place = lambda s: 1 + np.tanh(stretch * (s - 1)) / np.tanh(stretch)
    faces, y = place(np.arange(n + 1) / n), place((np.arange(n) + 0.5) / n)
    size, below = np.diff(faces), np.diff(np.r_[0, y])
    mixing = KAPPA * y * (1 - 0.55 * y) * (1 - np.exp(-y * reynolds / 26)) ** 2
    k = np.maximum(3.3 * (1 - 0.8 * y) * np.minimum(1, (y * reynolds / 15) ** 2), 1e-10)
    e = np.maximum(k**1.5 / (LENGTH * y * (1 - np.exp(-np.sqrt(k) * y * reynolds / (2 * LENGTH)))), 1e-8)
    values, step = [(1 - y) / (nu + mixing), k, e], 1e-3
    for _ in range(400):
        now = [np.real(of) for of in residual(values, nu, y, size, below)]
        J = np.zeros((3 * n, 3 * n))
        rows, columns, slopes = entries(derivatives(lambda moved: residual(moved, nu, y, size, below), values))
        J[rows, columns] = slopes
        J[np.r_[1:3 * n:3, 2:3 * n:3], np.r_[1:3 * n:3, 2:3 * n:3]] -= 1 / step
        change = np.linalg.solve(J, -np.stack(now, 1).ravel()).reshape(n, 3).T
        values = [np.maximum(v + d, 0.1 * v) for v, d in zip(values, change)]
        step *= 2
        if max(np.abs(d / v).max() for v, d in zip(values, change)) < 1e-10:
            break
    else:
        raise RuntimeError("Newton's method has not ended")
    at, slopes = np.r_[0, y], np.r_[reynolds, values[0]]
    u = np.cumsum(0.5 * (slopes[1:] + slopes[:-1]) * np.diff(at))
    return y, u, float(np.sum(u * size))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    reynolds = float(sys.argv[1])
    y, u, mean = solve(reynolds, int(sys.argv[2]))
    print(f"U_b+ {mean:.4f}")
    if len(sys.argv) == 4:
        np.savetxt(sys.argv[3], np.stack([y, y * reynolds, u], 1), delimiter=",", header="y_over_h,yplus,uplus", comments="", fmt="%.8g")


if __name__ == "__main__":
    main()
