// The numerical particles that a Monte Carlo method starts from.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

// A particle of a sample: its volume (m3), and which of modesOf() it is of.
struct InitialMember {
  double volume;
  std::size_t mode;
};

// `count` particles of equal weight, those of one mode after those of another; none where there are none. The quantile
// function is taken at one uniform random number in each of `count` intervals of equal probability: unbiased in every
// linear functional of the distribution, with far less noise than independent draws. All volumes are then scaled by one
// factor so that their mean is exactly the distribution's, M_1 hence exact from the start, but where all modes are
// monodisperse, whose volumes stay. What this costs, and where a sample of equal weights misses M_2 and M_3:
// docs/theory/population_balance/equal_weights.md.
[[nodiscard]] std::vector<InitialMember> initialMembers(const InitialPopulation& initial, std::size_t count,
                                                        RandomStream& random);
// The volumes of such members in increasing order.
[[nodiscard]] std::vector<double> initialVolumes(const InitialPopulation& initial, std::size_t count,
                                                 RandomStream& random);

struct InitialParticle {
  double volume, weight;  // m3, 1/m3
};

// `count` particles with weights, in increasing order of volume. InitialWeights::moments draws them with the density
// n(v) (1/M_0 + v/M_1 + v^2/M_2 + v^3/M_3) / 4, one in each of `count` intervals of equal probability of the parts (of
// a mode and a moment) that it is the sum of, and weighs them by one over that bracket (importance sampling by a
// mixture; Hesterberg 1995, Veach and Guibas 1995). No particle then holds more than about 4/count of any of M_0 to
// M_3, whatever the distribution. Factors near one make the moments those of the distribution (calibration; Deville and
// Särndal 1992): number and volume to round-off. Equal particles have the number of their mode.
[[nodiscard]] std::vector<InitialParticle> initialParticles(const InitialPopulation& initial, std::size_t count,
                                                            InitialWeights weights, RandomStream& random);

// Mean volume (m3) of the distribution by number; zero for Distribution::none.
[[nodiscard]] double meanInitialVolume(const InitialPopulation& initial);

// Number (1/m3) that each of options.particles equal particles stands for: of the initial population, or, where there
// is none, of the expected number. Throws InputError where neither is above zero.
[[nodiscard]] double initialWeight(const InitialPopulation& initial, const MonteCarloOptions& options);

// Quantile of the standard normal distribution, to 1e-15 (Wichura 1988, algorithm AS 241); probability in (0, 1).
[[nodiscard]] double normalQuantile(double probability);

}  // namespace lampblack::particles
