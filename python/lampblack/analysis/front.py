"""`lampblack trade_off`: the best compromises between two numbers, on surrogates, each then made by true runs."""

import numpy as np
from scipy.optimize import differential_evolution

from ..errors import InputError
from .measurements import Output
from .objective import mean_noise
from .tables import aligned, write_best, write_points, write_record, write_table


def pareto_front(first, second, allowed, dimensions, count, seed):
    """Points of the unit cube between the least of `first` and the least of `second` (functions of rows of points), where `allowed` (the sum
    of what constraints are missed by, 0 where they hold) is 0: the least of the first for each limit of the second. Points that others
    are better than in both are left out."""

    def least(function, limit=np.inf):
        def loss(columns):
            x = np.atleast_2d(columns.T)
            missed = allowed(x) + np.maximum(second(x) - limit, 0.0) / scale
            return np.where(missed > 0, worst + 1e3 * spread * (1 + missed), function(x))

        every = function(probe)
        worst, spread = float(every.max()), float(np.ptp(every)) or 1.0
        result = differential_evolution(loss, [(0, 1)] * dimensions, seed=seed, vectorized=True, updating="deferred", tol=1e-8, popsize=20, maxiter=300)
        return result.x

    probe = np.random.default_rng(seed).random((256, dimensions))
    scale = float(np.ptp(second(probe))) or 1.0
    ends = [least(first), least(second)]
    high, low = (float(second(np.atleast_2d(x))[0]) for x in ends)
    points = [ends[1], *(least(first, limit) for limit in np.linspace(low, high, count)[1:-1]), ends[0]]
    values = np.array([[function(np.atleast_2d(x))[0] for function in (first, second)] for x in points])
    kept = [i for i in range(len(points)) if not any(np.all(values[k] <= values[i]) and np.any(values[k] < values[i] - 1e-9 * np.ptp(values, axis=0))
                                                     for k in range(len(points)))]
    return np.array([points[i] for i in kept])


def trade_off(work):
    problem, options = work.problem, work.options["trade_off"]
    decks = {e.name: e for e in problem.experiments}

    def output(one, where):
        if one["deck"] not in decks:
            raise InputError(f"{where}.deck: there is no deck of the name {one['deck']}; expected one of {', '.join(decks)}")
        if one["quantity"] not in problem.quantities:
            raise InputError(f"{where}.quantity: there is no quantity {one['quantity']}; expected one of {', '.join(problem.quantities)}")
        return Output(decks[one["deck"]], problem.quantities[one["quantity"]])

    objectives = options.get("objectives", [])
    if len(objectives) != 2:
        raise InputError(f"trade_off.objectives: two are expected, found {len(objectives)}; what else matters may be a constraint")
    constraints = options.get("constraints", [])
    outputs = [output(one, f"trade_off.objectives[{i}]") for i, one in enumerate(objectives)]
    outputs += [output(one, f"trade_off.constraints[{i}]") for i, one in enumerate(constraints)]
    for i, (one, of) in enumerate(zip(constraints, outputs[2:])):
        where, limits = f"trade_off.constraints[{i}]", [one[key] for key in ("at_least", "at_most") if key in one]
        if not limits:
            raise InputError(f"{where}: at_least or at_most is expected, or nothing is asked for")
        if of.quantity.is_log and min(limits) <= 0:
            raise InputError(f"{where}: a limit above 0 is expected, as the logarithm of {of.quantity.name} is taken; found {min(limits):g}")
    points = work.design()
    values, errors = work.asked(points, outputs, "design")
    transformed = np.stack([o.quantity.transformed(values[:, k]) for k, o in enumerate(outputs)], axis=1)
    made = work.surrogates(points, transformed, [o.name for o in outputs], mean_noise(outputs, values, errors))
    signs = [1 if one["sense"] == "minimise" else -1 for one in objectives]

    def missed_by(numbers):
        """Of numbers after their transform, a column an output."""
        missed = np.zeros(len(numbers))
        for k, one in enumerate(constraints, 2):
            value, quantity, scale = numbers[:, k], outputs[k].quantity, np.sqrt(made[k].variance) or 1.0
            if "at_least" in one:
                missed += np.maximum(quantity.transformed(one["at_least"]) - value, 0) / scale
            if "at_most" in one:
                missed += np.maximum(value - quantity.transformed(one["at_most"]), 0) / scale
        return missed

    def allowed(x):
        return missed_by(np.stack([s(x) for s in made], axis=1)) if constraints else np.zeros(len(x))

    front = pareto_front(lambda x: signs[0] * made[0](x), lambda x: signs[1] * made[1](x), allowed, problem.dimensions, options["points"], work.seed)
    holds = allowed(front) <= 1e-6
    if not np.any(holds):
        raise InputError("trade_off.constraints: no point within the bounds holds them all")
    if not np.all(holds):
        work.warn(f"{int(np.sum(~holds))} points of the front miss a constraint and are left out")
    front = front[holds]
    found, noise = work.asked(front, outputs, "the front by true runs")
    failed = ~np.all(np.isfinite(found), axis=1)
    if np.any(failed):
        work.warn(f"the true runs of {int(np.sum(failed))} points of the front failed: their numbers are empty in front.csv")
    true = np.stack([o.quantity.transformed(found[:, k]) for k, o in enumerate(outputs)], axis=1)
    late = int(np.sum(missed_by(true)[~failed] > 0))
    if late:
        work.warn(f"by true runs {late} points of the front miss a constraint, which they hold by surrogates: increase design.points, or "
                  "ask for more than is needed")
    predicted = np.stack([o.quantity.back(s(front)) for o, s in zip(outputs, made)], axis=1)
    head = [*(p.name for p in problem.parameters)] + [name for o in outputs for name in (o.name, o.name + "_surrogate", o.name + "_noise")]
    rows = [[*problem.values(x).values(), *(n for k in range(len(outputs)) for n in (found[i, k], predicted[i, k], noise[i, k]))] for i, x in enumerate(front)]
    write_points(work.folder / "points.csv", problem, work.runs, points, outputs, values, errors)
    write_table(work.folder / "front.csv", head, rows)
    work.say(aligned(head, rows))
    for place, x in enumerate(front):
        (work.folder / "best").mkdir(exist_ok=True)
        write_best(work.folder / "best" / f"{place + 1}", work, x, [f"point {place + 1} of the front"])
    write_record(work.folder / "analysis.json", "trade_off", problem, work.runs,
                 {"objectives": [o.name for o in outputs[:2]], "least_r2": min(s.r2 for s in made), "warnings": work.warnings})
