// makeEqualWeight(): the solver of dsmc, constantVolume and both constantNumber methods for any type of particles.
#pragma once

#include <memory>

#include "core/errors.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/deferred_growth.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/population/monte_carlo/exact_store.hpp"
#include "particles/population/monte_carlo/make_monte_carlo.hpp"

namespace lampblack {

template <ParticleType Type, class Store, MonteCarloMethod Method>
std::unique_ptr<PopulationSolver> makeEqualWeightWith(const Type& type, const PopulationModel& model,
                                                      const InitialPopulation& initial,
                                                      const MonteCarloOptions& options) {
  using Jumps = DeferredWhereChanging<Type, EqualWeightMethod<Type, Store, Method>>;
  using Process = JumpProcess<Jumps>;
  RandomStream random(options.seed, options.repeat, Process::streamPurpose);
  Jumps method(type, model, initial, options, random);
  return std::make_unique<Process>(std::move(method), model, options, random);
}

template <ParticleType Type, class Store>
std::unique_ptr<PopulationSolver> makeEqualWeightIn(const Type& type, const PopulationModel& model,
                                                    const InitialPopulation& initial,
                                                    const MonteCarloOptions& options) {
  switch (options.method) {
    case MonteCarloMethod::dsmc:
      return makeEqualWeightWith<Type, Store, MonteCarloMethod::dsmc>(type, model, initial, options);
    case MonteCarloMethod::constantVolume:
      return makeEqualWeightWith<Type, Store, MonteCarloMethod::constantVolume>(type, model, initial, options);
    case MonteCarloMethod::constantNumberByMass:
      return makeEqualWeightWith<Type, Store, MonteCarloMethod::constantNumberByMass>(type, model, initial, options);
    case MonteCarloMethod::constantNumberByNumber:
      return makeEqualWeightWith<Type, Store, MonteCarloMethod::constantNumberByNumber>(type, model, initial, options);
    default:
      throw InputError("not a method with equal weights");
  }
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

}  // namespace lampblack
