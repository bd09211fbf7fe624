// makePairs(): the solver that draws pairs in time steps, for any type of particles.
#pragma once

#include <memory>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/make_monte_carlo.hpp"
#include "particles/population/monte_carlo/pair_process.hpp"

namespace lampblack::particles {

// Throws InputError for what the method cannot do.
void checkPairs(const PopulationModel& model, const MonteCarloOptions& options);

template <ParticleType Type>
std::unique_ptr<PopulationSolver> makePairs(const Type& type, const PopulationModel& model,
                                            const InitialPopulation& initial, const MonteCarloOptions& options) {
  checkPairs(model, options);
  return std::make_unique<PairProcess<Type>>(type, model, initial, options);
}

}  // namespace lampblack::particles
