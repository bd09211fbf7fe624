"""Which experiments tell most: D- and A-optimal choice by exchange of one for another."""

import itertools

import numpy as np


def _loss(information, criterion):
    values = np.linalg.eigvalsh(information)
    if values[0] <= 1e-14 * max(values[-1], 1e-300):
        return np.inf
    return -np.sum(np.log(values)) if criterion == "D" else np.sum(1 / values)


def choose(jacobians, count, criterion="D", known=None):
    """Places of the `count` experiments (the same one may come twice) whose rows d(residual)/d(parameter), with what is `known` already
    (an information matrix), leave the smallest covariance: its determinant (D) or its trace (A). Also the loss of that choice."""
    dimensions = jacobians[0].shape[1]
    known = np.zeros((dimensions, dimensions)) if known is None else known
    informations = [j.T @ j for j in jacobians]

    def loss(places):
        return _loss(known + sum(informations[i] for i in places), criterion)

    if len(jacobians) ** count <= 20000:
        best = min(itertools.combinations_with_replacement(range(len(jacobians)), count), key=loss)
        return list(best), loss(best)
    # A ridge makes choices comparable while too few experiments are chosen to see all parameters.
    ridge = 1e-9 * np.trace(sum(informations)) * np.eye(dimensions)
    chosen = []
    for _ in range(count):
        chosen.append(min(range(len(jacobians)), key=lambda i: _loss(known + ridge + sum(informations[k] for k in [*chosen, i]), criterion)))
    better = True
    while better:
        better = False
        for place in range(count):
            for i in range(len(jacobians)):
                trial = [*chosen[:place], i, *chosen[place + 1:]]
                if loss(trial) < loss(chosen) - 1e-12:
                    chosen, better = trial, True
    return sorted(chosen), loss(chosen)
