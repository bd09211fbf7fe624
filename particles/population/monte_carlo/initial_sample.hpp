// The numerical particles that a Monte Carlo method starts from.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/monte_carlo/monte_carlo_options.hpp"

namespace lampblack::particles {

// Volumes (m3) of `count` particles of equal weight, in increasing order; empty where there are
// none. The quantile
// function is taken at one uniform random number in each of `count` intervals of equal probability: unbiased in every
// linear functional of the distribution, with far less noise than independent draws. All volumes are then scaled by one
// factor so that their mean is exactly the distribution's, M_1 hence exact from the start; the factor differs from one
// by O(1/count), and the bias it leaves in other moments is O(log(count)/count^2) for the exponential distribution, far
// below the noise. (Where the mean hangs on a few particles, a log-normal distribution with sigma_v^2 > log(count),
// say, neither is small.)
[[nodiscard]] std::vector<double> initialVolumes(const InitialPopulation& initial, std::size_t count,
                                                 RandomStream& random);

// Mean volume (m3) of the distribution by number; zero for Distribution::none.
[[nodiscard]] double meanInitialVolume(const InitialPopulation& initial);

// Number (1/m3) that each of options.particles equal particles stands for: of the initial population, or, where there
// is none, of the expected number. Throws InputError where neither is above zero.
[[nodiscard]] double initialWeight(const InitialPopulation& initial, const MonteCarloOptions& options);

// Quantile of the standard normal distribution, to 1e-15 (Wichura 1988, algorithm AS 241); probability in (0, 1).
[[nodiscard]] double normalQuantile(double probability);

}  // namespace lampblack::particles
