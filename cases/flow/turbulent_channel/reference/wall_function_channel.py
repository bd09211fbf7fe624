#!/usr/bin/python3
"""Standard k-epsilon with wall functions in a developed channel, by finite volumes in one dimension and Newton's method.

Usage: wall_function_channel.py RE_TAU CELLS [--held YPLUS | --exact [--local]]

Half a channel of even cells, in units of half height and friction velocity. As flow solvers have it: friction, production and dissipation of
the cell beside the wall by the logarithmic law at its centre, linear interpolation of diffusivities to faces, central slopes. With --held:
the cells begin at that y+, where velocity, k and epsilon have the law's values. With --exact slopes of velocity and fluxes of epsilon are
those of a logarithm and of one over the distance, which they are in the logarithmic layer; with --local the k of the cell beside the wall
does not diffuse. Prints the mean velocity U_b+, in the first cell (or below the
held place) by the law.
"""

import argparse

import numpy as np

CMU, C1, C2, SIGMA_K, SIGMA_E, KAPPA, E = 0.09, 1.44, 1.92, 1.0, 1.3, 0.41, 9.8


def residual(values, nu, faces, held, exact=False, local=False):
    """Of u, k, epsilon in each cell."""
    y = 0.5 * (faces[1:] + faces[:-1])
    h = np.diff(faces)
    if held:
        first = faces[0]
        law = (np.log(E * first / nu) / KAPPA, CMU**-0.5, 1 / (KAPPA * first))
        u, k, e = (np.r_[at, of] for at, of in zip(law, values))
        places, inner = np.r_[first, y], faces[:-1]
    else:
        u, k, e = values
        places, inner = y, faces[1:-1]
    nut = CMU * k * k / e
    gap = np.diff(places)
    w = (places[1:] - inner) / gap
    mean = w * nut[:-1] + (1 - w) * nut[1:]
    fluxes = [(nu + mean / sigma) * np.diff(of) / gap for of, sigma in ((u, 1), (k, SIGMA_K), (e, SIGMA_E))]
    if exact:  # of the logarithmic layer
        logarithm = gap / (inner * np.log(places[1:] / places[:-1]))
        fluxes[0] *= logarithm
        fluxes[2] = -(nu + mean / SIGMA_E) * np.diff(1 / e) / gap / (w / e[:-1] + (1 - w) / e[1:]) ** 2
    # Slopes of second order, the wall and the mirrored last cell beyond the ends.
    if held:
        ends, velocity = np.r_[places, 2 - y[-1]], np.r_[u, u[-1]]
    else:
        ends, velocity = np.r_[0, places, 2 - y[-1]], np.r_[0, u, u[-1]]
    low, high = ends[1:-1] - ends[:-2], ends[2:] - ends[1:-1]
    slope = (np.diff(velocity)[1:] / high * low + np.diff(velocity)[:-1] / low * high) / (low + high)
    if exact:
        at_faces = np.r_[0, logarithm * np.diff(u) / gap * inner, 0]
        slope[:-1] = (0.5 * (at_faces[1:] + at_faces[:-1]) / y)[:-1]
    if held:
        u, k, e, nut = u[1:], k[1:], e[1:], nut[1:]
        spread = [(np.r_[flux[1:], 0] - flux) / h for flux in fluxes]
        production = nut * slope**2
        return np.array([spread[0] + 1, production - e + spread[1], (C1 * production - C2 * e) * e / k + spread[2]])
    star = CMU**0.25 * np.sqrt(k[0])
    friction = star * u[0] / (np.log(E * star * y[0] / nu) / KAPPA)
    spread = [(np.r_[flux, 0] - np.r_[wall, flux]) / h for flux, wall in zip(fluxes, (friction, 0, 0))]
    production = nut * slope**2
    found = np.array([spread[0] + 1, production - e + spread[1], (C1 * production - C2 * e) * e / k + spread[2]])
    dissipation = star**3 / (KAPPA * y[0])
    found[1, 0] = friction * star / (KAPPA * y[0]) - dissipation + (0 if local else spread[1][0])
    found[2, 0] = 1e3 * (dissipation - e[0])
    return found


def solve(re, cells, held=None, exact=False, local=False):
    """U_b+ of the channel."""
    nu, first = 1 / re, held / re if held else 0.0
    faces = np.linspace(first, 1, cells + 1)
    y = 0.5 * (faces[1:] + faces[:-1])
    k = CMU**-0.5 * (1 - 0.8 * y)
    values = np.array([np.log(E * re * y) / KAPPA, k, k**1.5 * CMU**0.75 / (KAPPA * y * (1 - 0.6 * y))])
    step = 1e-3
    for _ in range(400):
        left = residual(values, nu, faces, held, exact, local).ravel()
        flat = values.ravel()
        slopes = np.empty((flat.size, flat.size))
        for j in range(flat.size):
            moved = flat.copy()
            moved[j] += 1e-7 * abs(flat[j])
            slopes[:, j] = (residual(moved.reshape(3, cells), nu, faces, held, exact, local).ravel() - left) / (1e-7 * abs(flat[j]))
        change = np.linalg.solve(np.eye(flat.size) / step - slopes, left).reshape(3, cells)
        share = min(1.0, 0.5 / np.max(np.abs(change[1:]) / values[1:]))
        values = values + share * change
        step *= 1.5 if share == 1.0 else 0.7
        if share == 1.0 and np.max(np.abs(change / values)) < 1e-9:
            break
    bulk = float(np.sum(values[0] * np.diff(faces)))
    if held:
        return bulk + first / KAPPA * (np.log(E * held) - 1)
    return bulk - faces[1] * (1 - np.log(2)) / KAPPA


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("re_tau", type=float)
    parser.add_argument("cells", type=int)
    parser.add_argument("--held", type=float, help="y+ at which the cells begin, with the law's values there")
    parser.add_argument("--exact", action="store_true", help="slopes as in the logarithmic layer")
    parser.add_argument("--local", action="store_true", help="no diffusion of k in the cell beside the wall")
    arguments = parser.parse_args()
    print(f"U_b+ {solve(arguments.re_tau, arguments.cells, arguments.held, arguments.exact, arguments.local):.4f}")
