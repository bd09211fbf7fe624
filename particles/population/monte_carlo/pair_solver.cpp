#include "particles/population/monte_carlo/pair_solver.hpp"

#include <limits>

#include "core/errors.hpp"

namespace lampblack::particles {

void checkPairs(const PopulationModel& model, const MonteCarloOptions& options) {
  if (options.particles < 2) throw InputError("at least 2 numerical particles are needed");
  if (options.particles > std::numeric_limits<std::uint32_t>::max())
    throw InputError("the method pairs has room for 4294967295 numerical particles at most");
  if (options.nucleusWeight < 0) throw InputError("the weight of a nucleus cannot be negative");
  if (!(options.pairProbability > 0 && options.pairProbability <= 1))
    throw InputError("the probability of a pair needs to be in (0, 1]");
  if (!(options.splitChange > 0)) throw InputError("the change in a step of splitting needs to be above zero");
  if (options.rates == EventRates::exact)
    throw InputError("the method pairs draws pairs without sums of rates: it has no exact ones");
  if (options.fraction != FractionFunction::one)
    throw InputError("fraction functions belong to the methods wfmc, samwfmc and sammc; this method needs `one`");
  if (model.growth.active() && model.growth.treatment != GrowthOptions::Treatment::split)
    throw InputError("the method pairs splits growth from coagulation: use treatment: split");
}

}  // namespace lampblack::particles
