"""What is unknown of fitted parameters: their covariance, and samples of the posterior by walkers that stretch towards each other
(Goodman and Weare 2010), or by emcee."""

import numpy as np

from ..errors import InputError, NumericsError


def covariance(jacobian, phi, freedom):
    """(J^T J)^-1 of residuals in units of their errors, and what it is times Phi/dof where that is above 1: what the residuals show that
    the errors do not. NumericsError where a direction is not seen at all."""
    information = jacobian.T @ jacobian
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    values, vectors = np.linalg.eigh(information / np.outer(scale, scale))
    if values[0] < 1e-12 * max(values[-1], 1e-300) or np.min(scale) < 1e-12:
        raise NumericsError("uncertainty: the measurements say nothing of one combination of the parameters; fit fewer of them, or give priors")
    inverse = (vectors / values) @ vectors.T / np.outer(scale, scale)
    return inverse * max(1.0, phi / freedom if freedom > 0 else 1.0)


def correlation(matrix):
    deviation = np.sqrt(np.diag(matrix))
    return matrix / np.outer(deviation, deviation)


def autocorrelation_time(chain):
    """Steps between independent values of a chain (steps, walkers): Sokal's window of five times the result."""
    steps = len(chain)
    x = chain - chain.mean()
    power = np.abs(np.fft.rfft(x, 2 * steps, axis=0)) ** 2
    rho = np.fft.irfft(power, axis=0)[:steps].mean(axis=1)
    if rho[0] <= 0:
        return 1.0
    tau = 2 * np.cumsum(rho / rho[0]) - 1
    inside = np.arange(steps) < 5 * tau
    return float(max(1.0, tau[np.argmin(inside)] if not inside.all() else tau[-1]))


def _own(log_density, start, steps, draw):
    walkers, dimensions = start.shape
    x, value = start.copy(), log_density(start)
    chain, taken = np.empty((steps, walkers, dimensions)), 0
    halves = (np.arange(walkers) < walkers // 2, np.arange(walkers) >= walkers // 2)
    for step in range(steps):
        for half in halves:
            count = int(half.sum())
            z = (1 + draw.random(count)) ** 2 / 2  # density 1/sqrt(z) from 1/2 to 2
            others = x[~half][draw.integers(0, walkers - count, count)]
            moved = others + z[:, None] * (x[half] - others)
            new = log_density(moved)
            with np.errstate(invalid="ignore"):
                accept = np.log(draw.random(count)) < (dimensions - 1) * np.log(z) + new - value[half]
            places = np.flatnonzero(half)[accept]
            x[places], value[places] = moved[accept], new[accept]
            taken += int(accept.sum())
        chain[step] = x
    return chain, taken / (steps * walkers)


def _emcee(log_density, start, steps, draw):
    try:
        import emcee
    except ImportError as error:
        raise InputError("uncertainty.sampler: the package emcee is not installed (Debian: python3-emcee); expected own, or that package") from error
    walkers, dimensions = start.shape
    sampler = emcee.EnsembleSampler(walkers, dimensions, log_density, vectorize=True)
    sampler.random_state = np.random.RandomState(int(draw.integers(2**31))).get_state()
    sampler.run_mcmc(start, steps)
    return sampler.get_chain(), float(np.mean(sampler.acceptance_fraction))


def sample(log_density, best, deviations, samples, seed, sampler="own"):
    """At least so many samples of a density of the unit cube, which takes points as rows, and how well they are known: the
    autocorrelation time in steps, the number of independent ones of each parameter, the share of moves that were taken. Walkers start
    around the best point; a fifth of the chain, in which they spread, is thrown away."""
    draw = np.random.default_rng(seed)
    dimensions = len(best)
    walkers = max(32, 4 * dimensions)
    steps = -(-samples // walkers) * 5 // 4 + 1
    start = np.clip(best + np.minimum(deviations, 0.2) * draw.standard_normal((walkers, dimensions)), 1e-6, 1 - 1e-6)
    start += 1e-7 * draw.standard_normal(start.shape)
    chain, accepted = (_own if sampler == "own" else _emcee)(log_density, start, steps, draw)
    chain = chain[steps // 5:]
    tau = np.array([autocorrelation_time(chain[:, :, i]) for i in range(dimensions)])
    kept = chain.reshape(-1, dimensions)
    return kept, {"autocorrelation_time": tau, "independent_samples": len(kept) / tau, "accepted": accepted, "steps": len(chain), "walkers": walkers}
