"""What a fit makes small: squares of the differences between measurements and runs in units of their errors."""

import numpy as np


def mean_noise(outputs, values, errors):
    """Of each output, the standard error of its runs after the transform, in the mean over those that ran."""
    every = [o.quantity.transformed_error(values[:, k], errors[:, k]) for k, o in enumerate(outputs)]
    return np.array([np.mean(one[np.isfinite(one)]) if np.any(np.isfinite(one)) else 0.0 for one in every])


class Objective:
    """`outputs` are measurements. With T the transform of their quantity, r = (T(y) - T(f)) / s, where s^2 has the error of the measurement,
    the standard error of the run and what the model is allowed; priors that are not uniform count as measurements of their parameters."""

    def __init__(self, problem, outputs):
        self.problem, self.outputs = problem, outputs
        self.allowed = problem.options["measurements"]["model_error"]
        self.measured = np.array([float(o.quantity.transformed(o.value)) for o in outputs])
        self.sigma = np.array([float(o.quantity.transformed_error(o.value, o.error)) for o in outputs])
        self.weight = np.sqrt([o.experiment.weight for o in outputs])

    def transformed(self, values):
        """Runs' numbers as they are compared: (points, outputs)."""
        return np.stack([o.quantity.transformed(values[:, k]) for k, o in enumerate(self.outputs)], axis=1)

    def transformed_errors(self, values, errors):
        return np.stack([o.quantity.transformed_error(values[:, k], errors[:, k]) for k, o in enumerate(self.outputs)], axis=1)

    def deviations(self, noise):
        """s of each output, for standard errors of runs after the transform."""
        return np.sqrt(self.sigma**2 + np.asarray(noise) ** 2 + self.allowed**2)

    def residuals(self, transformed, noise, points):
        """(points, outputs and priors)."""
        rest = (self.measured - transformed) / self.deviations(noise) * self.weight
        scores = [p.score(points[:, i]) for i, p in enumerate(self.problem.parameters)]
        return np.column_stack([rest, *(score for score in scores if score is not None)])

    def phi_of_data(self, residuals):
        """Of one point, without the priors; infinite where a run failed."""
        phi = float(np.sum(residuals[: len(self.outputs)] ** 2))
        return phi if np.isfinite(phi) else np.inf
