#include "particles/population/monte_carlo/weighted_solver.hpp"

#include <string>

namespace lampblack::particles {

void checkWeighted(const PopulationModel& model, const MonteCarloOptions& options) {
  const bool fractions = options.method == MonteCarloMethod::wfmc || options.method == MonteCarloMethod::samwfmc;
  const std::size_t least = options.method == MonteCarloMethod::samwfmc ? 3 : 2;
  if (options.particles < least) {
    throw InputError("at least " + std::to_string(least) + " numerical particles are needed");
  }
  if (options.nucleusWeight < 0) throw InputError("the weight of a nucleus cannot be negative");
  if (!fractions && options.method != MonteCarloMethod::sammc && options.fraction != FractionFunction::one) {
    throw InputError("fraction functions belong to the methods wfmc, samwfmc and sammc; this method needs `one`");
  }
  if (fractions && (model.nucleation || model.breakage)) {
    throw InputError(
        "the methods wfmc and samwfmc cannot add the particles that nucleation or breakage makes; use sammc");
  }
}

}  // namespace lampblack::particles
