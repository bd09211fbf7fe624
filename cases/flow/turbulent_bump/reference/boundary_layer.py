#!/usr/bin/python3
"""The boundary layer over the bump by the model of Spalart and Allmaras, marched along the wall, at any Mach number.

Usage: boundary_layer.py [--mach M] [--results DIR] [--scale FACTOR] [--cells N] [--step M]

Boundary-layer equations with the pressure given: that of CFL3D (bump_cp_x.csv, Mach number 0.2), or of a run of the case. The wall takes no
heat, total enthalpy is the stream's with a recovery factor of Pr^(1/3), viscosity is Sutherland's. Curvature of the wall and the pressure's
change across the layer are left out, so that c_f by itself is good to 2 %; it is meant for ratios: what a Mach number does to c_f. Second
order along and across; Newton's method with exact derivatives (complex steps). Prints c_f at 0.632, 0.75 and 0.868 m.
"""

import argparse
import csv
import pathlib
import sys

import numpy as np
from scipy.interpolate import UnivariateSpline
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "reference"))
from three_bands import derivatives, entries  # noqa: E402

REYNOLDS, GAMMA, RECOVERY, HEIGHT, KAPPA = 3e6, 1.4, 0.71 ** (1 / 3), 0.1, 0.41  # per m; m
PLACES = (0.6321975, 0.75, 0.8678025)


class Across:
    """Cells from the wall to HEIGHT, and slopes of what is `wall` there and, beyond the last cell, `end`."""

    def __init__(self, n):
        def place(s):
            return HEIGHT * (1 + np.tanh(5.5 * (s - 1)) / np.tanh(5.5))

        faces = place(np.arange(n + 1) / n)
        self.y, self.size = place((np.arange(n) + 0.5) / n), np.diff(faces)
        self.below = np.diff(np.r_[0, self.y])
        self.above = np.r_[self.below[1:], 2 * (HEIGHT - self.y[-1])]

    def slope(self, f, wall, end=None):
        e, a, b = np.concatenate([[wall], f, [f[-1] if end is None else end]]), self.below, self.above
        return (a * a * e[2:] + (b * b - a * a) * e[1:-1] - b * b * e[:-2]) / (a * b * (a + b))

    def spread(self, D, f, D_wall, wall, end=None):
        e, of = np.concatenate([[wall], f, [f[-1] if end is None else end]]), np.concatenate([[D_wall], D, D[-1:]])
        flux = 0.5 * (of[1:] + of[:-1]) * np.diff(e) / np.append(self.below, self.above[-1])
        return np.diff(flux) / self.size


def sa(across, nu, nu_wall, strain, n):
    """nu_t and the model's rate (Allmaras, Johnson and Spalart 2012)."""
    y, c_b1, sigma, c_b2 = across.y, 0.1355, 2 / 3, 0.622
    c_w1, X = c_b1 / KAPPA**2 + (1 + c_b2) / sigma, n / nu
    f_v1 = X**3 / (X**3 + 7.1**3)
    f_t2 = 1.2 * np.exp(-0.5 * np.where(X.real < 9, X * X, 81))
    more = n / (KAPPA * y) ** 2 * (1 - X / (1 + X * f_v1))
    S = np.where(more.real >= -0.7 * strain.real, strain + more, strain + strain * (0.49 * strain + 0.9 * more) / (-0.5 * strain - more))
    r = n / (S * (KAPPA * y) ** 2)
    r = np.where(r.real < 10, r, 10)
    g = r + 0.3 * (r**6 - r)
    f_w = g * (65 / (g**6 + 64)) ** (1 / 6)
    spread = (across.spread(nu + n, n, nu_wall, 0.0) + c_b2 * across.slope(n, 0.0) ** 2) / sigma
    return n * f_v1, c_b1 * (1 - f_t2) * S * n - (c_w1 * f_w - c_b1 / KAPPA**2 * f_t2) * (n / y) ** 2 + spread


class Stream:
    """Velocity, temperature and pressure (of those far away) at the layer's edge; the gas in the layer."""

    def __init__(self, mach, pressure):
        self.mach, self.pressure = mach, pressure

    def at(self, x):
        c_p, square = float(self.pressure(x)), 0.2 * self.mach**2
        if square == 0:
            return np.sqrt(1 - c_p), 1.0, 1.0
        p = 1 + 0.5 * GAMMA * self.mach**2 * c_p
        T = p ** (1 - 1 / GAMMA)
        return np.sqrt((1 + square - T) / square), T, p

    def gas(self, u, edge):
        """Density and kinematic viscosity."""
        speed, T_edge, p = edge
        T = T_edge + RECOVERY * 0.2 * self.mach**2 * (speed * speed - u * u)
        constant = 110.5 / 300
        return p / T, T**1.5 * (1 + constant) / (T + constant) / REYNOLDS * T / p


def newton(residual, values, n):
    """Unknowns are known by their own and the neighbours' cells."""
    count = len(values)
    for _ in range(40):
        rows, columns, slopes = entries(derivatives(residual, values))
        J = csc_matrix((slopes, (rows, columns)), shape=(count * n,) * 2)
        change = splu(J).solve(-np.stack([np.real(of) for of in residual(values)], 1).ravel()).reshape(n, count)
        error = max(np.abs(change[:, 0]).max(), np.abs(change[:, 2]).max() / np.abs(values[2]).max())
        values = [v + d for v, d in zip(values, change.T)]
        values[2] = np.maximum(values[2], 1e-3 / REYNOLDS)
        if error < 1e-8:
            return values
    raise RuntimeError("Newton's method has not ended")


def march(stream, n, longest, end=0.9):
    across, x0 = Across(n), 5e-4
    thickness = 5 * np.sqrt(x0 / REYNOLDS)
    wall_x = np.linspace(0, 1.5, 30001)
    height = np.where((wall_x > 0.3) & (wall_x < 1.2), 0.05 * np.sin(np.pi * wall_x / 0.9 - np.pi / 3) ** 4, 0)
    along = np.r_[0, np.cumsum(np.hypot(np.diff(wall_x), np.diff(height)))]
    s, edge = x0, stream.at(x0)
    u = edge[0] * np.tanh(2 * across.y / thickness)
    old = older = (s, u, 3 / REYNOLDS * np.maximum(u / edge[0], 1e-3), edge)
    values, found = [u, 0 * u, old[2]], []
    while True:
        step = min(longest, 0.02 * s)
        s += step
        x = float(np.interp(s, along, wall_x))
        if x > end:
            return np.array(found)
        edge, before = stream.at(x), old[0] - older[0]
        weights = (1 / step, -1 / step, 0.0)
        if before > 0:
            weights = ((2 * step + before) / (step * (step + before)), -(step + before) / (step * before), step / (before * (step + before)))
        flux = [stream.gas(of[1], of[3])[0] * of[1] for of in (old, older)]
        # The wall's gas, and rho_e u_e du_e/ds, which is -dp/ds.
        nu_wall = stream.gas(np.zeros(1), edge)[1][0]
        mu_wall = nu_wall * stream.gas(np.zeros(1), edge)[0][0]
        push = edge[2] / edge[1] * edge[0] * np.dot(weights, (edge[0], old[3][0], older[3][0]))

        def residual(of):
            u, w, n_t = of
            density, nu = stream.gas(u, edge)
            shear = across.slope(u, 0.0, edge[0])
            nu_t, rate = sa(across, nu, nu_wall, np.sqrt(shear * shear + 1e-4), n_t)
            change = [weights[0] * now + weights[1] * a + weights[2] * b
                      for now, a, b in ((u, old[1], older[1]), (n_t, old[2], older[2]), (density * u, *flux))]
            momentum = (across.spread(density * (nu + nu_t), u, mu_wall, 0.0, edge[0]) + push - w * shear) / density - u * change[0]
            mass = (w - np.r_[0, w[:-1]]) / across.below + 0.5 * (change[2] + np.r_[0, change[2][:-1]])
            return [momentum, mass, rate - u * change[1] - w / density * across.slope(n_t, 0.0)]

        values = newton(residual, values, n)
        older, old = old, (s, values[0], values[2], edge)
        found.append((x, 2 * mu_wall * values[0][0] / across.y[0]))


def pressure_of(results, scale):
    """c_p along the wall over x, beyond the first millimetres, relative to the gas that comes in."""
    if results:
        sys.path.insert(0, str(HERE.parents[3] / "python"))
        from lampblack.results import Results

        of = Results(results)
        centres, p = np.asarray(of.centres), np.asarray(of.field("pressure"))
        entrance = of.record()["deck"]["boundaries"]
        start, speed = entrance["wall"]["from"], entrance["entrance"]["velocity"]
        coefficient = (p - p[np.argmin(centres[:, 0] + centres[:, 1])]) / (0.5 * np.asarray(of.field("density")).mean() * speed**2)
        lowest = np.arange(int(np.argmax(np.diff(centres[:, 0]) < 0)) + 1)
        x, c_p, rough = centres[lowest, 0] - start, coefficient[lowest], 0.0
    else:
        with open(HERE / "bump_cp_x.csv", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["model"] == "SA" and row["code"] == "CFL3D"]
        x, c_p = np.array(sorted((float(row["x_over_L"]), float(row["cp"])) for row in rows)).T
        rough = 2e-4
    inside = (x > 0.004) & (x < 1.5) & np.r_[True, np.diff(x) > 1e-7]
    x, c_p = x[inside], scale * c_p[inside]
    spline = UnivariateSpline(x, c_p, s=len(x) * rough**2, k=4 if rough else 3)
    return lambda place: spline(max(place, x[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mach", type=float, default=0.0, help="Mach number far away")
    parser.add_argument("--results", help="folder of a run of the case, whose pressure is taken")
    parser.add_argument("--scale", type=float, default=1.0, help="of the pressure coefficients")
    parser.add_argument("--cells", type=int, default=400, help="across the layer")
    parser.add_argument("--step", type=float, default=2e-3, help="along the wall, m")
    arguments = parser.parse_args()
    found = march(Stream(arguments.mach, pressure_of(arguments.results, arguments.scale)), arguments.cells, arguments.step)
    print("c_f at " + ", ".join(f"{x:.4g}" for x in PLACES) + " m: " + "  ".join(f"{np.interp(x, *found.T):.6f}" for x in PLACES))


if __name__ == "__main__":
    main()
