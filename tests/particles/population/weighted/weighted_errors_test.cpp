#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {
namespace {

PopulationModel coagulating(CollisionKernelType type = CollisionKernelType::constant) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = 1e-6;
  return model;
}

InitialPopulation monodisperse() {
  InitialPopulation initial;
  initial.distribution = InitialPopulation::Distribution::monodisperse;
  initial.number = 1e6;
  return initial;
}

MonteCarloOptions with(MonteCarloMethod method) {
  MonteCarloOptions options;
  options.method = method;
  options.particles = 100;
  return options;
}

TEST(WeightedErrors, SayWhatAMethodCannotDo) {
  PopulationModel nucleating = coagulating();
  nucleating.nucleation.emplace();
  nucleating.nucleation->rate = 1;
  PopulationModel breaking = coagulating();
  breaking.breakage = BreakageOptions{1, 0, 2, BreakageOptions::Daughters::equal};
  for (const auto method : {MonteCarloMethod::wfmc, MonteCarloMethod::samwfmc}) {
    EXPECT_THROW((void)makeMonteCarlo(nucleating, monodisperse(), with(method)), InputError);
    EXPECT_THROW((void)makeMonteCarlo(breaking, monodisperse(), with(method)), InputError);
  }
  for (const auto method : {MonteCarloMethod::mmc, MonteCarloMethod::swa}) {
    auto options = with(method);
    options.fraction = FractionFunction::hyperbolic;
    EXPECT_THROW((void)makeMonteCarlo(coagulating(), monodisperse(), options), InputError);
  }
}

TEST(WeightedErrors, WeightsAndConstantsHaveARange) {
  auto options = with(MonteCarloMethod::sammc);
  options.nucleusWeight = -1;
  EXPECT_THROW((void)makeMonteCarlo(coagulating(), monodisperse(), options), InputError);
  options = with(MonteCarloMethod::samwfmc);
  options.fraction = FractionFunction::constant;
  for (const double c : {0.0, -1.0, 1.01}) {
    options.fractionConstant = c;
    EXPECT_THROW((void)makeMonteCarlo(coagulating(), monodisperse(), options), InputError);
  }
  options = with(MonteCarloMethod::sammc);
  options.particles = 1;
  EXPECT_THROW((void)makeMonteCarlo(coagulating(), monodisperse(), options), InputError);
  // Nothing to take the weight of a nucleus from.
  EXPECT_THROW((void)makeMonteCarlo(coagulating(), {}, with(MonteCarloMethod::sammc)), InputError);
}

// The multiplicative kernel gels at tau = A N0 v0^2 t = 1. M_2/M_1 = 1 / (1 - tau) reaches the bound of the criterion,
// 4 N^(1/3), at 1 - tau = N^(-1/3) / 4: 0.025 for 1000 particles; noise of the largest particles, O(N^(-1/3)), in both
// directions.
TEST(WeightedErrors, GelationIsReportedWithItsTime) {
  for (const auto method :
       {MonteCarloMethod::mmc, MonteCarloMethod::sammc, MonteCarloMethod::swa, MonteCarloMethod::pairs}) {
    auto options = with(method);
    options.particles = 1000;
    const auto solver = makeMonteCarlo(coagulating(CollisionKernelType::multiplicative), monodisperse(), options);
    solver->advance(0.6);
    try {
      solver->advance(3);
      FAIL() << "no gelation";
    } catch (const GelationError& error) {
      EXPECT_NEAR(error.time(), 1, 0.2);
    }
  }
}

}  // namespace
}  // namespace lampblack::particles
