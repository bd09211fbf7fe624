"""Largest values of profiles, their places and the lopsidedness of profiles; the shape of particles."""

import numpy as np

from ..arrays import trapezoid


def peak(z, values):
    """The largest magnitude and its place, by the parabola through the three highest points."""
    values = np.abs(np.asarray(values, dtype=float))
    i = int(np.argmax(values))
    if values[i] <= 0 or i in (0, len(z) - 1):
        return float(values[i]), float(z[i])
    x, y = z[i - 1:i + 2] - z[i], values[i - 1:i + 2] / values[i]
    a, b, c = np.polyfit(x, y, 2)
    place = np.clip(-b / (2 * a), x[0], x[2]) if a < 0 else 0.0
    return float(values[i] * (c + b * place + a * place**2)), float(z[i] + place)


def half_widths(z, values):
    """Distances from the peak to half its height, to smaller and to larger z."""
    values = np.abs(np.asarray(values, dtype=float))
    height, place = peak(z, values)
    i, half = int(np.argmax(values)), 0.5 * height
    if height <= 0:
        return 0.0, 0.0
    low = next((j for j in range(i, -1, -1) if values[j] < half), None)
    high = next((j for j in range(i, len(z)) if values[j] < half), None)
    left = z[0] if low is None else np.interp(half, values[[low, low + 1]], z[[low, low + 1]])
    right = z[-1] if high is None else np.interp(half, values[[high, high - 1]], z[[high, high - 1]])
    return float(place - left), float(right - place)


def lopsidedness(z, values):
    """Half width towards larger z over that towards smaller z: 1 for a symmetrical profile."""
    left, right = half_widths(z, values)
    return right / left if left > 0 else np.nan


def is_unimodal(values, noise=1e-3):
    """Whether the profile rises to one peak and falls, apart from changes below `noise` of the peak."""
    values = np.asarray(values, dtype=float)
    i, allowed = int(np.argmax(values)), noise * np.max(values)
    rising, falling = values[:i + 1], values[i:]
    return bool(np.all(np.maximum.accumulate(rising) - rising <= allowed)
                and np.all(falling - np.minimum.accumulate(falling) <= allowed))


def shape(flame, soot_density):
    """Primaries in an aggregate, mobility and gyration diameter in nm, and whether they are the model's own.

    A model of spheres has none: there the primaries are the nuclei, by Wang (2025), eqs. 7-26 to 7-28, with the
    nucleus for the primary's diameter."""
    soot = flame.soot
    number = soot.get("primaries_per_aggregate")
    if number is not None and np.any(number > 1 + 1e-9):
        return number, soot["mobility_diameter"] * 1e9, soot["gyration_diameter"] * 1e9, True
    created, mass = flame.processes.get("nucleation_number"), flame.processes.get("nucleation")
    if created is None or mass is None or np.max(created) <= 0 or np.max(mass) <= 0:
        return None
    nucleus = np.trapezoid(mass, flame.z) / np.trapezoid(created, flame.z) if hasattr(np, "trapezoid") else (
        trapezoid(mass, flame.z) / trapezoid(created, flame.z))
    diameter = (6 * nucleus / (np.pi * soot_density)) ** (1 / 3)
    number = np.maximum((soot["mean_diameter"] / diameter) ** 3, 1)
    mobility = diameter * number**0.45
    gyration = np.where(number > 1.8, mobility / (number**-0.2 + 0.4), mobility / np.sqrt(5 / 3))
    return number, mobility * 1e9, gyration * 1e9, False
