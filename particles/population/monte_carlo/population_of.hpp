// populationOf(): the Monte Carlo solver of any method for any type of particles. Including this compiles all methods
// for the type; the shipped ones are compiled in the library, see shipped_types.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/equal_weight_solver.hpp"
#include "particles/population/monte_carlo/hybrid_solver.hpp"
#include "particles/population/monte_carlo/pair_solver.hpp"
#include "particles/population/monte_carlo/weighted_solver.hpp"

namespace lampblack::particles {

// Throws InputError.
template <ParticleType Type>
std::unique_ptr<PopulationSolver> populationOf(const Type& type, const PopulationModel& model,
                                               const InitialPopulation& initial, const MonteCarloOptions& options) {
  check(model, initial);
  switch (options.method) {
    case MonteCarloMethod::dsmc:
    case MonteCarloMethod::constantVolume:
    case MonteCarloMethod::constantNumberByMass:
    case MonteCarloMethod::constantNumberByNumber:
      return makeEqualWeight(type, model, initial, options);
    case MonteCarloMethod::mmc:
    case MonteCarloMethod::wfmc:
    case MonteCarloMethod::samwfmc:
    case MonteCarloMethod::sammc:
    case MonteCarloMethod::swa:
      return makeWeighted(type, model, initial, options);
    case MonteCarloMethod::pairs:
      return makePairs(type, model, initial, options);
    case MonteCarloMethod::hybrid:
      return makeHybrid(type, model, initial, options);
  }
  throw InputError("there is no such method");
}

}  // namespace lampblack::particles
