"""Places of the primaries of an aggregate, of which a run knows neighbours and sintering levels only: reconstructed, one of many
that are possible. Sub-trees are joined in the order of their collisions, in random directions."""

import numpy as np

TOUCHING = 2.0 ** (-1.0 / 3.0)  # sphere's surface over theirs, of two equal spheres in point contact
MOST_TRIES = 60
ALLOWED = 0.05  # overlap of spheres that are no neighbours, over the smaller radius


def surface_over_sphere(r, s, distance):
    """Surface of two overlapping spheres over that of the sphere of their volume."""
    x = np.clip((distance**2 + r**2 - s**2) / (2 * distance), -r, r)  # of the plane of the neck, from the first centre
    h, k = r - x, np.clip(s - (distance - x), 0, 2 * s)  # heights of the caps that are cut off
    surface = np.pi * (4 * r**2 - 2 * r * h + 4 * s**2 - 2 * s * k)
    volume = np.pi / 3 * (4 * r**3 - h**2 * (3 * r - h) + 4 * s**3 - k**2 * (3 * s - k))
    return surface / (np.pi ** (1 / 3) * (6 * volume) ** (2 / 3))


def neck_distance(r, s, level):
    """Between the centres of two primaries of these radii at a sintering level (0: point contact; 1: a sphere)."""
    r, s, level = (np.asarray(a, dtype=float) for a in (r, s, level))
    wanted = 1.0 / (level * (1.0 - TOUCHING) + TOUCHING)
    low, high = np.abs(r - s) + 1e-6 * (r + s), r + s
    for _ in range(50):
        middle = 0.5 * (low + high)
        above = surface_over_sphere(r, s, middle) > wanted
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return 0.5 * (low + high)


def _rotation(random):
    """Uniformly distributed: from a unit quaternion."""
    w, x, y, z = (q := random.normal(size=4)) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def reconstructed(diameters, necks, random):
    """Centres (n x 3, in the unit of the diameters). `necks`: of each place k the columns left, right, first, last and level; it
    joined the primaries first..k with k+1..last."""
    radii = 0.5 * np.asarray(diameters, dtype=float)
    places = np.zeros((len(radii), 3))
    distances = neck_distance(radii[necks["left"]], radii[necks["right"]], necks["level"])
    for k in np.argsort(necks["last"] - necks["first"], kind="stable"):
        one, other = np.arange(necks["first"][k], k + 1), np.arange(k + 1, necks["last"][k] + 1)
        left, right = necks["left"][k], necks["right"][k]
        best, least = None, np.inf
        for _ in range(MOST_TRIES):
            direction = random.normal(size=3)
            direction *= distances[k] / np.linalg.norm(direction)
            moved = (places[other] - places[right]) @ _rotation(random).T + places[left] + direction
            apart = np.linalg.norm(places[one][:, None] - moved[None], axis=2)
            overlap = (radii[one][:, None] + radii[other] - apart) / np.minimum(radii[one][:, None], radii[other])
            overlap[left - one[0], right - other[0]] = 0.0
            overlap = np.sum(overlap[overlap > ALLOWED])
            if overlap < least:
                best, least = moved, overlap
            if least == 0:
                break
        places[other] = best
    return places - places.mean(axis=0)
