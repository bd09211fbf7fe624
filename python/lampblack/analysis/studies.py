"""`lampblack design`, `sensitivity` and `propagate`: runs of many points and what they say."""

import h5py
import numpy as np
from scipy.stats import qmc

from ..errors import InputError, ResultsError
from . import choice, indices
from .measurements import read_measurements, single_numbers
from .objective import Objective, mean_noise
from .search import jacobian
from .tables import aligned, write_points, write_record, write_table

QUANTILES = (2.5, 16, 50, 84, 97.5)


def design(work):
    """The points of a design and their outputs; with candidates, which experiments tell most of the parameters."""
    problem = work.problem
    rows = read_measurements(problem)
    outputs = [o for o in rows if o.value is not None] or single_numbers(problem)
    candidates = [e for e in problem.experiments if e.use == "candidate"]
    if candidates:
        return _choose(work, rows, candidates)
    points = work.design()
    values, errors = work.asked(points, outputs, "design")
    write_points(work.folder / "points.csv", problem, work.runs, points, outputs, values, errors)
    write_record(work.folder / "analysis.json", "design", problem, work.runs, {"points": len(points), "warnings": work.warnings})
    return None


def _slopes(work, outputs):
    """d(residual)/dx at the start, errors that are shares taken of the run's own value."""
    problem = work.problem
    values, _ = work.runs.values(problem.start[None, :], outputs)
    if not np.all(np.isfinite(values)):
        raise InputError(f"design: a run at the start failed: {work.runs.failure(problem.start, outputs)}")
    for k, o in enumerate(outputs):
        if o.value is None:
            o.value = float(values[0, k])
            o.error = o.error or o.relative * abs(o.value)
            if o.error == 0:
                raise InputError(f"measurements: the error of {o.name} is a share of the run's value, which is 0; give it as a number")
    target = Objective(problem, outputs)

    def residuals(points):
        values, errors = work.runs.values(points, outputs)
        return target.residuals(target.transformed(values), target.transformed_errors(values, errors), np.asarray(points))[:, : len(outputs)]

    return jacobian(residuals, problem.start, work.options["optimise"]["step"], central=True)


def _choose(work, rows, candidates):
    problem, options = work.problem, work.options["design"]
    groups = [[o for o in rows if o.experiment is experiment] for experiment in candidates]
    for experiment, group in zip(candidates, groups):
        if not group:
            raise InputError(f"measurements.files: what the candidate {experiment.name} would measure is missing: rows with its quantity, places and errors, "
                             "the value left empty")
    known = [o for o in rows if o.experiment.use == "fit"]
    slopes = _slopes(work, [o for group in groups for o in group] + known)
    ends = np.cumsum([0, *map(len, groups)])
    parts = [slopes[a:b] for a, b in zip(ends, ends[1:])]
    measured = slopes[ends[-1]:]
    prior = np.diag([0.0 if p.score(0.5) is None else (p.slope(x) / (p.value(x) if p.prior == "lognormal" else 1.0) / p.prior_deviation) ** 2
                     for p, x in zip(problem.parameters, problem.start)])
    known_information = measured.T @ measured + prior
    chosen, loss = choice.choose(parts, options["choose"], options["criterion"], known_information)
    if not np.isfinite(loss):
        raise InputError("design.choose: no choice of so many experiments tells all parameters; choose more, or give priors")
    information = known_information + sum(parts[i].T @ parts[i] for i in chosen)
    deviations = np.sqrt(np.diag(np.linalg.inv(information)))
    table = [[candidates[i].name, chosen.count(i)] for i in range(len(candidates))]
    write_table(work.folder / "choice.csv", ["deck", "times"], table)
    work.say(f"experiments that tell most ({options['criterion']}-optimal):\n" + aligned(["deck", "times"], table))
    errors = [[p.name, float(p.value(x)), float(p.slope(x) * s)] for p, x, s in zip(problem.parameters, problem.start, deviations)]
    work.say("standard errors with them:\n" + aligned(["parameter", "value", "error"], errors))
    write_table(work.folder / "errors_expected.csv", ["parameter", "value", "error"], errors)
    write_record(work.folder / "analysis.json", "design", problem, work.runs, {"chosen": [candidates[i].name for i in chosen], "warnings": work.warnings})


def _transformed(outputs, values):
    return np.stack([o.quantity.transformed(values[:, k]) for k, o in enumerate(outputs)], axis=1)


def sensitivity(work):
    problem, options = work.problem, work.options["sensitivity"]
    outputs, names = single_numbers(problem), [p.name for p in problem.parameters]
    method, rows, r2 = options["method"], [], None
    if method == "surrogate":
        points = work.design()
        values, errors = work.asked(points, outputs, "design")
        made = work.surrogates(points, _transformed(outputs, values), [o.name for o in outputs], mean_noise(outputs, values, errors))
        r2 = min(s.r2 for s in made)
        head = ["output", "parameter", "S", "S_T", "r2"]
        for o, s in zip(outputs, made):
            rows += [[o.name, name, first, total, s.r2] for name, first, total in zip(names, *s.sobol_indices())]
    elif method == "saltelli":
        points = indices.saltelli_points(options["points"], problem.dimensions, work.seed)
        values, errors = work.asked(points, outputs, "Saltelli's points")
        head = ["output", "parameter", "S", "S_low", "S_high", "S_T", "S_T_low", "S_T_high"]
        for o, f in zip(outputs, _transformed(outputs, values).T):
            first, total = indices.saltelli_indices(f, options["points"], work.seed)
            rows += [[o.name, name, *first[i], *total[i]] for i, name in enumerate(names)]
    elif method == "morris":
        points, moves = indices.morris_points(options["trajectories"], problem.dimensions, options["levels"], work.seed)
        values, errors = work.asked(points, outputs, "trajectories")
        head = ["output", "parameter", "mu", "mu_star", "sigma"]
        for o, f in zip(outputs, _transformed(outputs, values).T):
            rows += [[o.name, name, *effect] for name, effect in zip(names, indices.morris_effects(f, moves, options["levels"]))]
    else:
        start = problem.start
        points = indices.local_points(start, options["step"])
        values, errors = work.asked(points, outputs, "differences")
        slopes = np.array([p.value(x) / p.slope(x) for p, x in zip(problem.parameters, start)])
        head = ["output", "parameter", "d_ln_output_d_ln_parameter", "error"]
        for k, o in enumerate(outputs):
            found, error = indices.local_sensitivities(values[:, k], points, slopes, errors[:, k])
            rows += [[o.name, name, s, e] for name, s, e in zip(names, found, error)]
    write_points(work.folder / "points.csv", problem, work.runs, points, outputs, values, errors)
    write_table(work.folder / "sensitivity.csv", head, rows)
    work.say(aligned(head, rows))
    write_record(work.folder / "analysis.json", "sensitivity", problem, work.runs, {"method": method, "least_r2": r2, "warnings": work.warnings})


def _prior_samples(work, count):
    power = max(1, int(np.ceil(np.log2(count))))
    shares = qmc.Sobol(work.problem.dimensions, scramble=True, seed=work.seed + 1).random_base2(power)[:count]
    return np.column_stack([p.drawn(shares[:, i]) for i, p in enumerate(work.problem.parameters)])


def _posterior_samples(work, count):
    path = work.folder / "posterior.h5"
    if not path.is_file():
        raise ResultsError(f"{path}: there is no posterior here; run `lampblack fit` with uncertainty.method: posterior and the same --out first")
    with h5py.File(path) as file:
        for p in work.problem.parameters:
            if p.name not in file:
                raise ResultsError(f"{path}: this posterior knows no parameter {p.name}")
        every = np.column_stack([p.place(file[p.name][()]) for p in work.problem.parameters])
    beyond = np.any((every < -1e-9) | (every > 1 + 1e-9), axis=0)
    if np.any(beyond):
        p = work.problem.parameters[int(np.argmax(beyond))]
        raise InputError(f"{path}: samples of {p.name} lie beyond its bounds {p.low:g} and {p.high:g}; give the bounds of the fit, or fit anew")
    draw = np.random.default_rng(work.seed + 1)
    return np.clip(every[draw.choice(len(every), min(count, len(every)), replace=False)], 0, 1)


def propagate(work):
    """Quantiles of every number as the parameters are unknown."""
    problem, options = work.problem, work.options["propagate"]
    outputs = single_numbers(problem) + [o for o in read_measurements(problem) if o.place is not None and o.experiment.use != "candidate"]
    samples = (_prior_samples if options["from"] == "prior" else _posterior_samples)(work, options["samples"])
    if options["through"] == "surrogate":
        points = work.design()
        values, errors = work.asked(points, outputs, "design")
        made = work.surrogates(points, _transformed(outputs, values), [o.name for o in outputs], mean_noise(outputs, values, errors))
        found = np.stack([o.quantity.back(s(samples)) for o, s in zip(outputs, made)], axis=1)
    else:
        points = samples
        found, errors = values, errors = work.asked(samples, outputs, "samples")
    write_points(work.file("points.csv"), problem, work.runs, points, outputs, values, errors)
    good = found[np.all(np.isfinite(found), axis=1)]
    head = ["deck", "quantity", "abscissa", "mean", "deviation", *(f"q{q:g}" for q in QUANTILES), "measured", "error"]
    rows = [[o.experiment.name, o.quantity.name, "" if o.place is None else o.place, good[:, k].mean(), good[:, k].std(ddof=1),
             *np.percentile(good[:, k], QUANTILES), "" if o.value is None else o.value, "" if o.value is None else o.error] for k, o in enumerate(outputs)]
    write_table(work.folder / "bands.csv", head, rows)
    work.say(aligned(head[:-2], [row[:-2] for row in rows]))
    write_record(work.file("analysis.json"), "propagate", problem, work.runs, {"samples": len(good), "warnings": work.warnings})
