"""`lampblack fit`: parameters from measurements. A design finds where the objective is low, local searches go on from its best points, and
the shape of the objective at the best one, or the posterior on surrogates, says how well the parameters are known."""

import h5py
import numpy as np

from ..errors import InputError, NumericsError
from . import posterior
from .measurements import read_measurements
from .objective import Objective, mean_noise
from .search import jacobian, objective, search
from .surrogate import Together
from .tables import aligned, write_best, write_points, write_record, write_table

AT_BOUND = 1e-3  # of the range
OF_ERROR, OF_NOISE = 0.3, 1.5  # what a surrogate may miss at points held out, whatever its R2: of the error, of the runs' own noise
ALIKE = 0.95  # correlation from which two parameters cannot be told apart


class Model:
    """Residuals at points, by true runs or by surrogates of the transformed values."""

    def __init__(self, work, target):
        self.work, self.target, self.surrogates, self.together, self.noise = work, target, None, None, None

    def by_runs(self, points):
        values, errors = self.work.runs.values(points, self.target.outputs)
        return self.target.residuals(self.target.transformed(values), self.target.transformed_errors(values, errors), np.asarray(points))

    def by_surrogates(self, points):
        points = np.atleast_2d(points)
        return self.target.residuals(self.together(points), self.noise, points)

    def make_surrogates(self, points, values, errors):
        transformed = self.target.transformed(values)
        own = mean_noise(self.target.outputs, values, errors)
        enough = np.hypot(OF_ERROR * self.target.deviations(0.0), OF_NOISE * own)
        self.surrogates = self.work.surrogates(points, transformed, [o.name for o in self.target.outputs], own, enough)
        self.together = Together(self.surrogates)
        # What a surrogate misses counts as an error too; where runs are stochastic their scatter is in it.
        self.noise = np.maximum(own, [s.deviation for s in self.surrogates])


def _different(points, phi, count, apart=0.1):
    """Places of the best points, which are not all in one corner."""
    chosen = []
    for i in np.argsort(phi, kind="stable"):
        if not np.isfinite(phi[i]) or len(chosen) == count:
            break
        if all(np.max(np.abs(points[i] - points[k])) > apart for k in chosen):
            chosen.append(int(i))
    return chosen


def _searches(work, model, residuals, points, phi):
    """The best point of all searches, and whether the best one ended by itself."""
    options = work.options["optimise"]
    on_runs = options["on"] == "runs"
    best, best_phi, rows = None, np.inf, []
    for start in _different(points, phi, options["starts"]):
        x, found, count, ended = search(residuals, points[start], options["method"], options["step"], options["tolerance"],
                                        options["most_points"] if on_runs else None)
        rows.append([start, phi[start], found, count, "ended" if ended else "cut short", *work.problem.values(x).values()])
        work.say(f"search from point {start + 1}: objective {phi[start]:.4g} to {found:.4g} with {count} points"
                 + ("" if ended else "; it did not end by itself"))
        if found < best_phi:
            best, best_phi = x, found
    write_table(work.folder / "searches.csv", ["point", "phi_start", "phi_end", "points", "end", *(p.name for p in work.problem.parameters)], rows)
    if best is None:
        raise NumericsError("optimise: no search has found a point at which all runs end")
    return best


def _posterior(work, model, best, deviations):
    options = work.options["uncertainty"]
    parameters = work.problem.parameters

    def log_density(points):
        inside = np.all((points >= 0) & (points <= 1), axis=1)
        safe = np.clip(points, 0, 1)
        rest = model.by_surrogates(safe)[:, : len(model.target.outputs)]
        prior = sum(p.log_prior(safe[:, i]) for i, p in enumerate(parameters))
        return np.where(inside, -0.5 * np.sum(rest**2, axis=1) + prior, -np.inf)

    samples, known = posterior.sample(log_density, best, deviations, options["samples"], work.seed, options["sampler"])
    with h5py.File(work.folder / "posterior.h5", "w") as file:
        for i, p in enumerate(parameters):
            file[p.name] = p.value(samples[:, i])
            file[p.name].attrs["autocorrelation_time"] = known["autocorrelation_time"][i]
            file[p.name].attrs["independent_samples"] = known["independent_samples"][i]
        file.attrs["accepted"], file.attrs["steps"], file.attrs["walkers"] = known["accepted"], known["steps"], known["walkers"]
    work.say(f"posterior: {len(samples)} samples, autocorrelation time {max(known['autocorrelation_time']):.0f} steps, "
             f"{min(known['independent_samples']):.0f} independent ones, {100 * known['accepted']:.0f} % of the moves taken")
    if min(known["independent_samples"]) < 200 or known["steps"] < 50 * max(known["autocorrelation_time"]):
        work.warn("the chain of the posterior is short for its autocorrelation time: increase uncertainty.samples")
    return samples


def _profiles(work, model, best):
    """The objective along each parameter, the others at their best for it, on the surrogates."""
    rows = []
    for i, p in enumerate(work.problem.parameters):
        x = best.copy()
        for place in np.linspace(0, 1, 31):
            def rest(points, i=i, place=place):
                points = np.array(points)
                points[:, i] = place
                return model.by_surrogates(points)

            x[i] = place
            x, phi, _, _ = search(rest, x, "least_squares", 1e-4, 1e-6)
            rows.append([p.name, float(p.value(place)), phi])
    write_table(work.folder / "objective.csv", ["parameter", "value", "phi"], rows)


def _warn(work, model, best, phi, freedom, matrix, slopes):
    parameters = work.problem.parameters
    for p, x in zip(parameters, best):
        if min(x, 1 - x) < AT_BOUND:
            work.warn(f"{p.name} is at its bound {p.low if x < 0.5 else p.high:g}: widen the range, or the measurements ask for what the model cannot give")
    alike = posterior.correlation(matrix)
    for i in range(len(best)):
        for k in range(i):
            if abs(alike[i, k]) > ALIKE:
                work.warn(f"{parameters[k].name} and {parameters[i].name} have a correlation of {alike[i, k]:.3f}: these measurements cannot tell them "
                          "apart; fit one of them, or measure what only one changes")
    if freedom > 0 and phi / freedom > 3:
        work.warn(f"objective over degrees of freedom is {phi / freedom:.3g}: it is the model, not its constants, that misses these measurements, or their "
                  "errors are larger than said")
    # How much of what tells the parameters is of each experiment: the sum of its leverages over the number of parameters.
    leverage = np.einsum("ki,ij,kj->k", slopes, np.linalg.pinv(slopes.T @ slopes), slopes)
    shares = {}
    for o, share in zip(model.target.outputs, leverage):
        shares[o.experiment.name] = shares.get(o.experiment.name, 0.0) + share / len(best)
    name = max(shares, key=shares.get)
    if len(shares) > 1 and shares[name] > 0.9:
        work.warn(f"{100 * shares[name]:.0f} % of what tells the parameters is of {name} alone: its errors are small, or the others say little")


def _residual_table(work, best, start):
    """All measurements, also those kept out of the fit, before and after."""
    outputs = [o for o in read_measurements(work.problem) if o.experiment.use != "candidate"]
    target = Objective(work.problem, outputs)
    target.weight = np.ones(len(outputs))  # differences in units of their errors alone
    values, errors = work.runs.values(np.array([start, best]), outputs)
    rest = target.residuals(target.transformed(values), target.transformed_errors(values, errors), np.array([start, best]))
    deviations = target.deviations(np.nan_to_num(target.transformed_errors(values, errors)[1]))
    rows = [[o.experiment.name, o.quantity.name, "" if o.place is None else o.place, o.value, o.error, values[0, k], values[1, k], errors[1, k], deviations[k],
             rest[0, k], rest[1, k], o.experiment.use, o.source] for k, o in enumerate(outputs)]
    write_table(work.folder / "residuals.csv", ["deck", "quantity", "abscissa", "measured", "error", "start", "best", "best_noise", "deviation", "residual_start",
                                                "residual_best", "use", "source"], rows)
    lines = []
    for experiment in work.problem.experiments:
        for quantity in work.problem.quantities.values():
            k = [k for k, o in enumerate(outputs) if o.experiment is experiment and o.quantity is quantity]
            if not k:
                continue
            measured = np.array([outputs[i].value for i in k])
            ratio = np.abs(np.log(values[:, k] / measured)) if np.all(values[:, k] > 0) and np.all(measured > 0) else np.full((2, len(k)), np.nan)
            lines.append([experiment.name, quantity.name, experiment.use, len(k), *np.sqrt(np.mean(rest[:, k] ** 2, axis=1)), *np.exp(np.mean(ratio, axis=1))])
    head = ["deck", "quantity", "use", "n", "rms_residual_start", "rms_residual_best", "factor_start", "factor_best"]
    work.say("\nresiduals in units of their errors, and the mean factor between run and measurement:\n" + aligned(head, lines) + "\n")
    write_table(work.folder / "errors.csv", head, lines)


def fit(work):
    problem = work.problem
    fitted = [o for o in read_measurements(problem) if o.experiment.use == "fit"]
    priors = sum(p.prior != "uniform" for p in problem.parameters)
    if not fitted or len(fitted) + priors < problem.dimensions:
        raise InputError(f"measurements.files: a fit of {problem.dimensions} parameters needs as many measurements of decks of use fit, or priors; found "
                         f"{len(fitted)} measurements and {priors} priors")
    model = Model(work, Objective(problem, fitted))
    target, options = model.target, work.options
    points = np.concatenate([[problem.start], work.design()])
    values, errors = work.asked(points, fitted, "design")
    rest = target.residuals(target.transformed(values), target.transformed_errors(values, errors), points)
    phi = np.array([objective(r) for r in rest])
    write_points(work.folder / "points.csv", problem, work.runs, points, fitted, values, errors, phi)
    on_runs, wants_posterior = options["optimise"]["on"] == "runs", options["uncertainty"]["method"] == "posterior"
    if not on_runs or wants_posterior:
        model.make_surrogates(points, values, errors)
    residuals = model.by_runs if on_runs else model.by_surrogates
    start_phi = phi if on_runs else np.array([objective(r) for r in model.by_surrogates(points)])
    best = _searches(work, model, residuals, points, np.where(np.isfinite(phi), start_phi, np.inf))

    slopes = jacobian(residuals, best, options["optimise"]["step"], central=True)
    if not np.all(np.isfinite(slopes)):
        raise NumericsError("uncertainty: a run beside the best point failed, so that the derivatives are not known there")
    at_best = residuals(best[None, :])[0]
    freedom = len(slopes) - problem.dimensions  # priors count as measurements
    matrix = posterior.covariance(slopes, objective(at_best), freedom)
    deviations = np.sqrt(np.diag(matrix))
    true = model.by_runs(best[None, :])[0]
    true_phi, start_value = target.phi_of_data(true), target.phi_of_data(rest[0])
    samples = _posterior(work, model, best, deviations) if wants_posterior else None
    if model.surrogates is not None:
        _profiles(work, model, best)

    head, rows = ["parameter", "value", "error", "low", "high", "at_bound"], []
    head += [f"correlation_{p.name}" for p in problem.parameters] + (["posterior_median", "posterior_low", "posterior_high"] if wants_posterior else [])
    alike = posterior.correlation(matrix)
    for i, p in enumerate(problem.parameters):
        ends = p.value(np.clip(best[i] + np.array([-1.96, 1.96]) * deviations[i], 0, 1))
        rows.append([p.name, float(p.value(best[i])), float(p.slope(best[i]) * deviations[i]), *ends, "yes" if min(best[i], 1 - best[i]) < AT_BOUND else "no",
                     *alike[i]])
        if wants_posterior:
            rows[-1] += [float(p.value(x)) for x in np.percentile(samples[:, i], [50, 2.5, 97.5])]
    write_table(work.folder / "fit.csv", head, rows)
    work.say("\nvalues, standard errors and intervals of 95 %:\n" + aligned(head, rows))
    work.say(f"\nobjective {start_value:.4g} at the start, {true_phi:.4g} at the best point (true runs), {freedom} degrees of freedom")
    _residual_table(work, best, problem.start)
    if not np.isfinite(true_phi):
        why = work.runs.failure(best, fitted) or "a number has no logarithm, or lies beyond the run"
        work.warn(f"the true run at the best point of the surrogates failed ({why}): use optimise.on: runs, or smaller ranges")
    elif objective(true) > phi[0]:
        work.warn(f"the true runs have a larger objective at the best point of the surrogates than at the start ({objective(true):.4g}, {phi[0]:.4g}): the "
                  "surrogates are too poor; increase design.points, or use optimise.on: runs")
    _warn(work, model, best, objective(true), freedom, matrix, slopes)
    work.runs.run(best[None, :], [e for e in problem.experiments if e.use != "candidate"])
    write_best(work.folder / "best", work, best,
               [f"fitted to {', '.join(sorted({o.source for o in fitted if o.source})) or 'the measurements of the analysis'}, objective {true_phi:.5g} with "
                f"{freedom} degrees of freedom"])
    write_record(work.folder / "analysis.json", "fit", problem, work.runs, {
        "phi_start": start_value, "phi_best": true_phi, "degrees_of_freedom": freedom, "best": problem.values(best), "warnings": work.warnings,
        "least_r2": min((s.r2 for s in model.surrogates), default=None) if model.surrogates else None,
        "sources": sorted({o.source for o in fitted if o.source})})
    return best
