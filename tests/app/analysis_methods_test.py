"""Methods of the analyses on functions whose answers are known: designs, surrogates, indices, searches, errors of parameters, samplers,
choices of experiments.

Usage: analysis_methods_test.py [EXECUTABLE] [--all]
"""

import importlib.util
import sys
import types

import running

np = running.package("numpy")
running.needs("scipy")
sys.path.insert(0, str(running.SOURCE / "python"))

from lampblack.analysis import choice, designs, front, indices, posterior, problem, search, surrogate  # noqa: E402
from lampblack.errors import InputError, NumericsError  # noqa: E402

ALL = "--all" in sys.argv
ISHIGAMI = np.array([[0.313905, 0.442411, 0.0], [0.557589, 0.442411, 0.243684]])
G = np.array([[0.716192, 0.179048, 0.023676, 0.007162] + 4 * [7.2e-5], [0.787144, 0.242198, 0.034317, 0.010460] + 4 * [1.05e-4]])


def ishigami(x):
    x = np.pi * (2 * x - 1)
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def g_function(x):
    a = np.array([0, 1, 4.5, 9, 99, 99, 99, 99])
    return np.prod((np.abs(4 * x - 2) + a) / (1 + a), axis=1)


def check_designs():
    """In the unit cube; each Sobol point and each row of a hypercube in an interval of its own; again with the same seed."""
    for points in (designs.sobol(16, 3, 5), designs.latin_hypercube(16, 3, 5)):
        assert points.shape == (16, 3) and all(sorted(np.floor(16 * points[:, i]).astype(int)) == list(range(16)) for i in range(3))
    assert np.array_equal(designs.sobol(16, 3, 5), designs.sobol(16, 3, 5)) and not np.array_equal(designs.sobol(16, 3, 5), designs.sobol(16, 3, 6))
    running.refused(InputError, "such as 32 or 64", designs.sobol, 48, 2, 1)
    assert designs.factorial(3, 2).tolist()[:4] == [[0, 0], [0, 0.5], [0, 1], [0.5, 0]] and len(designs.factorial(3, 2)) == 9
    one = designs.one_at_a_time(np.array([0.5, 0.25]), 3)
    assert one.tolist() == [[0.5, 0.25], [0, 0.25], [1, 0.25], [0.5, 0], [0.5, 0.5], [0.5, 1]], one


def sparse_of(x):
    return surrogate.Surrogate(x, np.exp(x[:, 1]), 5)


def check_surrogates():
    """Polynomials are found exactly; Ishigami's and the g function's indices from the coefficients; noise is no structure."""
    x = designs.sobol(64, 3, 3)
    made = surrogate.Surrogate(x, 1 + 2 * x[:, 0] - x[:, 1] ** 3 + 4 * x[:, 0] * x[:, 2] ** 3, 4)
    y = np.random.default_rng(1).random((20, 3))
    assert np.allclose(made(y), 1 + 2 * y[:, 0] - y[:, 1] ** 3 + 4 * y[:, 0] * y[:, 2] ** 3, atol=1e-10) and made.r2 > 1 - 1e-12
    values = surrogate.legendre(np.polynomial.legendre.leggauss(12)[0] / 2 + 0.5, 6)
    weights = np.polynomial.legendre.leggauss(12)[1] / 2
    assert np.allclose(values.T @ (weights[:, None] * values), np.eye(7), atol=1e-12), "they are not orthonormal"
    few = designs.sobol(32, 8, 3)  # fewer points than terms: those that matter are found
    sparse = surrogate.Surrogate(few, 3 * few[:, 1] + few[:, 4] * few[:, 6], 3)
    assert sparse.r2 > 0.99, sparse.r2
    noise = surrogate.Surrogate(x, np.random.default_rng(2).standard_normal(64), 4)
    assert noise.r2 < 0.3, noise.r2
    alone = surrogate.Surrogate(x, x[:, 0] * x[:, 1] + x[:, 2], 3, pairs=False)
    assert (alone.terms > 0).sum(axis=1).max() == 1
    few_terms, f = surrogate.basis(x[:12], alone.terms[:4]), np.exp(x[:12, 0])
    rest = surrogate.left_out(few_terms, f)[1]
    without = np.arange(12) != 7
    assert abs(rest[7] - (f[7] - few_terms[7] @ np.linalg.lstsq(few_terms[without], f[without], rcond=None)[0])) < 1e-10
    both = surrogate.Together([made, alone, sparse_of(x)])(y)
    assert np.allclose(both, np.stack([made(y), alone(y), sparse_of(x)(y)], axis=1), atol=1e-12)
    exact = np.array([[3 / 7, 3 / 7], [4 / 7, 4 / 7]])
    product = surrogate.Surrogate(x[:, :2], x[:, 0] * x[:, 1], 3)  # variance 7/144, of each alone 1/48
    assert np.allclose(product.sobol_indices(), exact, atol=1e-10) and abs(product.variance - 7 / 144) < 1e-12 and abs(product.mean - 0.25) < 1e-12
    for order, count, most in ((8, 512, 1e-3), (10, 1024, 1e-4)):
        points = designs.sobol(count, 3, 1)
        made = surrogate.Surrogate(points, ishigami(points), order)
        off = np.abs(np.array(made.sobol_indices()) - ISHIGAMI).max()
        print(f"Ishigami, degree {order}, {count} points: indices within {off:.1e}, R2 {made.r2:.6f}, variance {made.variance:.5f}")
        assert off < most and made.r2 > 0.999 and abs(made.variance - 13.844588) < 2e-3
    if ALL:
        points = designs.sobol(2048, 8, 1)
        made = surrogate.Surrogate(points, g_function(points), 6)
        off = np.abs(np.array(made.sobol_indices()) - G).max()
        print(f"g function, degree 6, 2048 points: indices within {off:.1e}, R2 {made.r2:.4f}, variance {made.variance:.5f}")
        assert off < 3e-3 and made.r2 > 0.98


def check_saltelli():
    worst, outside, intervals = 0.0, 0, 0
    for seed in range(20 if ALL else 3):
        points = indices.saltelli_points(4096, 3, seed)
        first, total = indices.saltelli_indices(ishigami(points), 4096, seed, 10)
        worst = max(worst, np.abs([first[:, 0], total[:, 0]] - ISHIGAMI).max())
    assert worst < 0.01, worst
    few = 0.0
    for seed in range(20):
        points = indices.saltelli_points(256, 3, seed)
        found = np.array(indices.saltelli_indices(ishigami(points), 256, seed, 200))
        few = max(few, np.abs(found[:, :, 0] - ISHIGAMI).max())
        outside += int(np.sum((found[:, :, 1] > ISHIGAMI) | (found[:, :, 2] < ISHIGAMI)))
        intervals += 6
    print(f"Saltelli, Ishigami: N = 4096 within {worst:.4f}; 256 within {few:.2f}, {outside} of {intervals} intervals of 95 % miss")
    assert few < 0.2 and outside <= 0.1 * intervals
    if ALL:
        points = indices.saltelli_points(4096, 8, 1)
        first, total = indices.saltelli_indices(g_function(points), 4096, 1, 10)
        off = max(np.abs(first[:3, 0] - G[0, :3]).max(), np.abs(total[:3, 0] - G[1, :3]).max())
        print(f"Saltelli, g function: N = 4096 within {off:.4f}")
        assert off < 0.01
    holes = ishigami(indices.saltelli_points(256, 3, 1))
    holes[[5, 300, 700]] = np.nan
    assert np.all(np.isfinite(indices.saltelli_indices(holes, 256, 1, 10)))


def check_morris_and_local():
    """A linear function's slopes exactly; the powers of an Arrhenius law."""
    c = np.array([1.0, -2.0, 0.5, 3.0])
    points, moves = indices.morris_points(6, 4, 4, 1)
    assert points.min() >= 0 and points.max() <= 1 and np.all((np.diff(points.reshape(6, 5, 4), axis=1) != 0).sum(axis=2) == 1)
    effects = indices.morris_effects(points @ c, moves, 4)
    assert np.allclose(effects, np.stack([c, np.abs(c), 0 * c], axis=1), atol=1e-12), effects
    bent = indices.morris_effects((points[:, 0] - 0.5) ** 2, moves, 4)
    assert bent[0, 1] >= abs(bent[0, 0]) and bent[0, 2] > 0
    running.refused(InputError, "even number", indices.morris_points, 2, 2, 5, 1)

    T, R = 1500.0, 8.314
    triple = [problem.Parameter({"name": name, "from": low, "to": high, "scale": scale, "set": ["k={%s}" % name], "shift": [], "start": start}, "")
              for name, low, high, scale, start in (("A", 1e7, 1e9, "log", 8e7), ("n", 1.0, 2.0, "linear", 1.56), ("E", 1e4, 3e4, "linear", 1.6e4))]
    start = np.array([p.place(p.start) for p in triple])
    points = indices.local_points(start, 0.02)
    values = [p.value(points[:, i]) for i, p in enumerate(triple)]
    slopes = np.array([p.value(x) / p.slope(x) for p, x in zip(triple, start)])
    k = values[0] * T ** values[1] * np.exp(-values[2] / (R * T))
    found, error = indices.local_sensitivities(k, points, slopes, 0.01 * k)
    assert np.allclose(found, [1, 1.56 * np.log(T), -1.6e4 / (R * T)], rtol=1e-11), found
    assert abs(error[0] - 0.01 * np.sqrt(2) / (0.04 * np.log(100))) < 1e-12, error


def check_searches():
    """Rosenbrock's valley on logarithmic scales by every method; failed points; as many points as allowed."""
    def valley(points):
        a, b = 10 ** (2 * np.asarray(points).T - 1)
        return np.stack([10 * (b - a * a), 1 - a], axis=1)

    for method in search.METHODS:
        x, phi, count, ended = search.search(valley, np.array([0.2, 0.7]), method, 1e-4, 1e-8)
        assert ended and np.allclose(x, 0.5, atol=1e-4) and phi < 1e-6, (method, x, phi, count)
    x, phi, count, ended = search.search(valley, np.array([0.2, 0.7]), "nelder_mead", 1e-4, 1e-8, most=20)
    assert not ended and count <= 20 and np.isfinite(phi)

    def broken(points):  # nothing runs above 0.6
        return np.where(np.asarray(points)[:, :1] > 0.6, np.nan, valley(points))

    x, phi, *_ = search.search(broken, np.array([0.3, 0.2]), "hooke_jeeves", 0.01, 1e-6)
    assert phi < 1e-3 and np.allclose(x, 0.5, atol=0.02), (x, phi)
    x, *_ = search.search(lambda p: np.asarray(p) - 1.3, np.array([0.5, 0.5]), "least_squares", 0.01, 1e-6)
    assert np.allclose(x, 1, atol=1e-3), x
    j = search.jacobian(lambda p: np.stack([p[:, 0] ** 2, p[:, 0] * p[:, 1]], axis=1), np.array([0.5, 0.25]), 0.01, central=True)
    assert np.allclose(j, [[1.0, 0.0], [0.25, 0.5]], atol=1e-12), j


def check_two_wells():
    """The lower of two wells is found from a design, the higher alone from a start in it."""
    from lampblack.analysis.fit import _different

    def wells(points):
        x = np.asarray(points)[:, 0]
        return np.stack([np.minimum((x - 0.15) / 0.05, 10) * np.minimum(np.abs(x - 0.8) / 0.05, 10) / 5, np.where(x < 0.5, 1.0, 0.0)], axis=1)

    points = designs.sobol(32, 1, 1)
    phi = np.array([search.objective(r) for r in wells(points)])
    found = [search.search(wells, points[i], "least_squares", 1e-3, 1e-8)[:2] for i in _different(points, phi, 3)]
    best = min(found, key=lambda one: one[1])
    assert abs(best[0][0] - 0.8) < 1e-3 and best[1] < 1e-6, found
    assert abs(search.search(wells, np.array([0.2]), "least_squares", 1e-3, 1e-8)[0][0] - 0.15) < 1e-2


def check_coverage():
    """A linear model: the covariance, how often intervals have the truth in them, and the same ellipse from samples."""
    draw = np.random.default_rng(4)
    model, sigma, truth = draw.standard_normal((12, 2)), 0.05, np.array([0.45, 0.55])
    exact = np.linalg.inv(model.T @ model) * sigma**2
    assert np.allclose(posterior.covariance(-model / sigma, 0.0, 10), exact, rtol=1e-10)
    assert np.allclose(posterior.covariance(-model / sigma, 30.0, 10), 3 * exact, rtol=1e-10), "Phi/dof above 1 widens"
    count = 500 if ALL else 200
    inside = np.zeros(2)
    for _ in range(count):
        data = model @ truth + sigma * draw.standard_normal(12)
        x, phi, *_ = search.search(lambda p: (data - np.atleast_2d(p) @ model.T) / sigma, np.array([0.3, 0.3]), "least_squares", 1e-3, 1e-9)
        matrix = posterior.covariance(search.jacobian(lambda p: (data - p @ model.T) / sigma, x, 1e-3, central=True), 0.0, 10)
        off = np.abs(x - truth) / np.sqrt(np.diag(matrix))
        inside += [np.mean(off < 1.0), np.mean(off < 1.96)]
    share = inside / count
    print(f"coverage of {count} data sets: {share[0]:.3f} of 0.683, {share[1]:.3f} of 0.950")
    for found, expected in zip(share, (0.6827, 0.95)):
        assert abs(found - expected) < 3 * np.sqrt(expected * (1 - expected) / count), share
    running.refused(NumericsError, "say nothing", posterior.covariance, np.array([[1.0, 1.0], [2.0, 2.0]]), 1.0, 1)
    assert np.allclose(posterior.correlation(np.array([[4.0, 3.0], [3.0, 9.0]])), [[1, 0.5], [0.5, 1]])

    data = model @ truth

    def log_density(points):
        inside = np.all((points >= 0) & (points <= 1), axis=1)
        return np.where(inside, -0.5 * np.sum(((data - points @ model.T) / sigma) ** 2, axis=1), -np.inf)

    for sampler in ("own", *(("emcee",) if importlib.util.find_spec("emcee") else ())):
        samples, known = posterior.sample(log_density, truth, np.sqrt(np.diag(exact)), 40000, 3, sampler)
        error = np.sqrt(np.diag(exact)) / np.sqrt(known["independent_samples"])
        assert len(samples) >= 40000 and np.all(np.abs(samples.mean(axis=0) - truth) < 4 * error), (sampler, samples.mean(axis=0), error)
        assert np.allclose(np.cov(samples.T), exact, atol=0.1 * np.diag(exact).max()), (sampler, np.cov(samples.T), exact)
        assert 0.3 < known["accepted"] < 0.9 and np.all(known["independent_samples"] > 500), known
    if not importlib.util.find_spec("emcee"):
        running.refused(InputError, "python3-emcee", posterior.sample, log_density, truth, np.sqrt(np.diag(exact)), 100, 3, "emcee")
    # A chain whose time is known: x' = a x + noise has (1 + a)/(1 - a).
    chain = np.zeros((20000, 8))
    for i in range(1, len(chain)):
        chain[i] = 0.8 * chain[i - 1] + draw.standard_normal(8)
    assert abs(posterior.autocorrelation_time(chain) / 9 - 1) < 0.1, posterior.autocorrelation_time(chain)


def check_choice():
    """D-optimal for a line on [-1, 1]: the two ends; A-optimal too; what is known counts."""
    for places in (11, 201):
        line = [np.array([[1.0, x]]) for x in np.linspace(-1, 1, places)]
        for criterion in "DA":
            assert choice.choose(line, 2, criterion)[0] == [0, places - 1]
        assert choice.choose(line, 4)[0] == [0, 0, places - 1, places - 1]
    assert choice.choose([np.array([[1.0, 0.0]]), np.array([[0.0, 1.0]])], 1, "D", np.diag([100.0, 1.0]))[0] == [1]


def check_front():
    """Two parabolas: all between their ends is the front; with a constraint only a part of it."""
    def apart(x, place):
        return (x[:, 0] - place) ** 2 + (x[:, 1] - 0.5) ** 2

    for least in (0.2, 0.5):
        points = front.pareto_front(lambda x: apart(x, 0.2), lambda x: apart(x, 0.8), lambda x, least=least: np.maximum(least - x[:, 0], 0), 2, 5, 1)
        assert np.allclose(points[:, 1], 0.5, atol=0.01) and len(points) == 5, points
        assert abs(points[:, 0].min() - least) < 0.01 and abs(points[:, 0].max() - 0.8) < 0.01, points


def check_noise():
    """Terms that follow the noise of runs are not taken where it is known: a plane in noise stays one, a curve keeps its terms."""
    draw = np.random.default_rng(5)
    most, kept, off = 0, 0, []
    for _ in range(20):
        x = designs.sobol(32, 2, int(draw.integers(10**6)))
        noise = 0.3 * draw.standard_normal(32)
        plane = surrogate.Surrogate(x, x[:, 0] + noise, 6, noise=0.3)
        most = max(most, len(plane.terms))
        curve = surrogate.Surrogate(x, 20 * (x[:, 0] - 0.5) ** 3 + noise / 6, 6, noise=0.05)
        kept += bool(np.any(curve.terms[:, 0] == 3))
        at = designs.sobol(256, 2, 1)
        off.append(np.sqrt(np.mean((plane(at) - at[:, 0]) ** 2)))
    print(f"planes in noise: {most} terms at most, off by {np.mean(off):.3f} in the mean, of a noise of 0.3")
    assert most <= 6 and np.mean(off) < 0.15 and kept == 20, (most, np.mean(off), kept)


def check_openturns():
    """Another program's chaos of the same points, where it is installed."""
    if not importlib.util.find_spec("openturns"):
        print("openturns is not installed: no cross-check")
        return
    import openturns as ot

    points = designs.sobol(512, 3, 1)
    box = ot.ComposedDistribution([ot.Uniform(0, 1)] * 3)
    basis = ot.OrthogonalProductPolynomialFactory([ot.LegendreFactory()] * 3, ot.LinearEnumerateFunction(3))
    least_squares = ot.LeastSquaresStrategy(ot.Sample(points.tolist()), ot.Sample(ishigami(points)[:, None].tolist()))
    chaos = ot.FunctionalChaosAlgorithm(ot.Sample(points.tolist()), ot.Sample(ishigami(points)[:, None].tolist()), box, ot.FixedStrategy(basis, 165), least_squares)
    chaos.run()
    theirs = ot.FunctionalChaosSobolIndices(chaos.getResult())
    ours = surrogate.Surrogate(points, ishigami(points), 8).sobol_indices()
    off = max(max(abs(ours[0][i] - theirs.getSobolIndex(i)), abs(ours[1][i] - theirs.getSobolTotalIndex(i))) for i in range(3))
    print(f"OpenTURNS {ot.__version__}, chaos of degree 8 of the same points: indices differ by {off:.1e}")
    assert off < 1e-3, off


def main():
    checks = [one for name, one in globals().items() if name.startswith("check_") and isinstance(one, types.FunctionType)]
    for check in checks:
        check()
    print(f"{len(checks)} groups of methods")


if __name__ == "__main__":
    main()
