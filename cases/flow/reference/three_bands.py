"""Derivatives of equations in a row of cells, each of which knows its own and the two neighbours' unknowns, by complex steps: exact to round-off."""

import numpy as np

STEP = 1e-30


def derivatives(equations, values):
    """Of the equations that `equations(values)` tells by the unknowns `values`, lists of arrays over the cells:
    [a][b][band, j] is that of equation a in the cell j + band - 1 by unknown b of cell j; zero beyond the ends."""
    cells = np.arange(len(values[0]))
    bands = None
    for b in range(len(values)):
        for colour in range(3):
            moved = [of.astype(complex) for of in values]
            moved[b][colour::3] += 1j * STEP
            found = equations(moved)
            if bands is None:
                bands = [[np.zeros((3, cells.size)) for _ in values] for _ in found]
            by = cells[colour::3]
            for a, of in enumerate(found):
                for band in range(3):
                    rows = by + band - 1
                    inside = (rows >= 0) & (rows < cells.size)
                    bands[a][b][band, by[inside]] = of.imag[rows[inside]] / STEP
    return bands


def entries(bands):
    """Rows, columns and values of the matrix of all of them that are not zero: unknown b of cell j is number j times their count plus b, and
    so are the equations."""
    count = len(bands)
    found = []
    for a, of in enumerate(bands):
        for b, ofUnknown in enumerate(of):
            for band, slopes in enumerate(ofUnknown):
                j = np.flatnonzero(slopes)
                found.append(np.stack([(j + band - 1) * count + a, j * count + b, slopes[j]]))
    rows, columns, slopes = np.concatenate(found, axis=1)
    return rows.astype(int), columns.astype(int), slopes
