// makeEqualWeight(): the solver of dsmc, constantVolume and both constantNumber methods for any type of particles.
#pragma once

#include <memory>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/deferred_growth.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/population/monte_carlo/exact_store.hpp"
#include "particles/population/monte_carlo/make_monte_carlo.hpp"

namespace lampblack::particles {

template <ParticleType Type, class Store>
std::unique_ptr<PopulationSolver> makeEqualWeightIn(const Type& type, const PopulationModel& model,
                                                    const InitialPopulation& initial,
                                                    const MonteCarloOptions& options) {
  using Jumps = DeferredWhereChanging<Type, EqualWeightMethod<Type, Store>>;
  using Process = JumpProcess<Jumps>;
  RandomStream random(options.seed, options.repeat, Process::streamPurpose);
  Jumps method(type, model, initial, options, random);
  return std::make_unique<Process>(std::move(method), model, options, random);
}

template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeEqualWeight(const Type& type, const PopulationModel& model,
                                                  const InitialPopulation& initial, const MonteCarloOptions& options) {
  if (defersGrowth(model, options)) {
    const Deferred<Type> deferred(type, model.growth);
    return makeEqualWeightIn<Deferred<Type>, ClassStore<EqualRates<Deferred<Type>>>>(deferred, model, initial, options);
  }
  if (options.rates == EventRates::exact) {
    return makeEqualWeightIn<Type, ExactStore<EqualRates<Type>>>(type, model, initial, options);
  }
  return makeEqualWeightIn<Type, ClassStore<EqualRates<Type>>>(type, model, initial, options);
}

}  // namespace lampblack::particles
