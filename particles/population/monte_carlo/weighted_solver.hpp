// makeWeighted(): the solver of mmc, wfmc, samwfmc, sammc and swa for any type of particles.
#pragma once

#include <memory>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo/exact_store.hpp"
#include "particles/population/monte_carlo/make_monte_carlo.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"
#include "particles/population/monte_carlo/weighted_method.hpp"

namespace lampblack::particles {

// Throws InputError for what the method of `options` cannot do.
void checkWeighted(const PopulationModel& model, const MonteCarloOptions& options);

template <class Method, ParticleType Type>
std::unique_ptr<PopulationSolver> makeWeightedWith(const Type& type, const PopulationModel& model,
                                                   const InitialPopulation& initial, const MonteCarloOptions& options) {
  RandomStream random(options.seed, options.repeat, JumpProcess<Method>::streamPurpose);
  Method method(type, model, initial, options, random);
  return std::make_unique<JumpProcess<Method>>(std::move(method), model, options, random);
}

template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeWeighted(const Type& type, const PopulationModel& model,
                                               const InitialPopulation& initial, const MonteCarloOptions& options) {
  checkWeighted(model, options);
  if (defersGrowth(model, options)) {
    using Method = DeferredMethod<WeightedMethod<Deferred<Type>, SortedStore<WeightedRates<Deferred<Type>>>>>;
    return makeWeightedWith<Method>(Deferred<Type>(type, model.growth), model, initial, options);
  }
  if (options.rates == EventRates::exact) {
    return makeWeightedWith<WeightedMethod<Type, ExactStore<WeightedRates<Type>>>>(type, model, initial, options);
  }
  using Method = WeightedMethod<Type, SortedStore<WeightedRates<Type>>>;
  return makeWeightedWith<Method>(type, model, initial, options);
}

}  // namespace lampblack::particles
