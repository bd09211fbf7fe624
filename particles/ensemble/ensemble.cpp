#include "particles/ensemble/ensemble.hpp"

#include "particles/ensemble/stochastic_process.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/population/monte_carlo/pair_method.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"
#include "particles/population/monte_carlo/two_level_store.hpp"
#include "particles/population/monte_carlo/weighted_method.hpp"

namespace lampblack::particles {
namespace {

template <class Method>
std::unique_ptr<Ensemble> make(EnsembleOptions options, const PopulationModel& model,
                               const MonteCarloOptions& monteCarlo) {
  RandomStream random(options.seed, options.owner, ensembleStream);
  const SootAggregate type = sootAggregate(options);
  Method method(type, model, InitialPopulation{}, monteCarlo, random);
  return std::make_unique<StochasticProcess<Method>>(std::move(options), type, std::move(method), random);
}

}  // namespace

std::unique_ptr<Ensemble> makeEnsemble(EnsembleOptions options) {
  if (options.particles < 8) throw InputError("stochastic soot: at least 8 numerical particles are needed");
  if (!(options.bundledGrowth >= 0) || !(options.bundledGrowth < 1))
    throw InputError("stochastic soot: the share of a particle that is taken up at once has to be in [0, 1)");
  if (!(options.startNumberDensity > 0) || !(options.splitTolerance > 0) || !(options.splitTolerance <= 1)) {
    throw InputError("stochastic soot: the start number density and the split tolerance need to be positive");
  }
  if (options.soot.inceptionBy == InceptionBy::monomers && options.soot.pah.size() != 1)
    throw InputError("stochastic soot: nuclei of monomers need one PAH");
  PopulationModel model;
  if (options.soot.coagulation) {
    // Of some gas, until there is the right one.
    CollisionKernelOptions kernel = options.kernel;
    kernel.gas = {1500, constants::oneAtmosphere, 0.2, 5e-5, 0.028};
    kernel.enhancement = options.soot.vanDerWaals;
    kernel.slip = options.soot.slip;
    model.coagulation = kernel;
  }
  model.growth.oxidation = 1;  // particles may vanish
  MonteCarloOptions monteCarlo;
  monteCarlo.particles = options.particles;
  monteCarlo.expectedNumber = options.startNumberDensity;
  monteCarlo.nucleusWeight = 1;
  monteCarlo.bundledGrowth = options.bundledGrowth;
  // Fewer candidates cost less and scatter no more (docs/verification.md); their error is of order p/n.
  monteCarlo.pairProbability = 0.5;
  switch (options.method) {
    case EnsembleMethod::dsmc:
      monteCarlo.method = MonteCarloMethod::dsmc;
      return make<EqualWeightMethod<SootAggregate, ClassStore<EqualRates<SootAggregate>>>>(std::move(options), model,
                                                                                           monteCarlo);
    case EnsembleMethod::sammc:
      monteCarlo.method = MonteCarloMethod::sammc;
      break;
    case EnsembleMethod::pairs:
      monteCarlo.method = MonteCarloMethod::pairs;
      return make<PairMethod<SootAggregate>>(std::move(options), model, monteCarlo);
    case EnsembleMethod::swa:
      monteCarlo.method = MonteCarloMethod::swa;
      break;
  }
  // Without order a sooting gas takes a fifth less up to here, beyond it no less (tests/bench/particles_bench,
  // sootingGas).
  constexpr std::size_t mostWithoutOrder = 8192;
  if (options.particles > mostWithoutOrder)
    return make<WeightedMethod<SootAggregate, SortedStore<WeightedRates<SootAggregate>>>>(std::move(options), model,
                                                                                          monteCarlo);
  return make<WeightedMethod<SootAggregate, TwoLevelStore<WeightedRates<SootAggregate>>>>(std::move(options), model,
                                                                                          monteCarlo);
}

}  // namespace lampblack::particles
