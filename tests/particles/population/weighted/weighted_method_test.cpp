// Methods with different weights against exact solutions: means over repeats within the noise, mass to rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "particles/population/monte_carlo/weighted_solver.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using enum MonteCarloMethod;

struct Variant {
  std::string name;
  MonteCarloMethod method;
  FractionFunction fraction = FractionFunction::one;
  FractionOf of = FractionOf::volumes;
  WeightTransfer transfer = WeightTransfer::mass;
  MergingDifference merging = MergingDifference::relative;
  double constant = 1;
  bool keepsMass = true;
};
void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"mmc", mmc},
      {"sammc", sammc},
      {"sammcHyperbolic", sammc, FractionFunction::hyperbolic, FractionOf::weights},
      {"sammcHyperbolicAbsolute", sammc, FractionFunction::hyperbolic, FractionOf::weights, WeightTransfer::mass,
       MergingDifference::absolute},
      {"sammcExponential", sammc, FractionFunction::exponential, FractionOf::weights},
      {"samwfmcHyperbolic", samwfmc, FractionFunction::hyperbolic},
      {"samwfmcStepwise", samwfmc, FractionFunction::stepwise},
      {"samwfmcConstant", samwfmc, FractionFunction::constant, FractionOf::volumes, WeightTransfer::mass,
       MergingDifference::relative, 0.6},
      {"wfmcHyperbolic", wfmc, FractionFunction::hyperbolic},
      {"wfmcExponential", wfmc, FractionFunction::exponential},
      {"swaMass", swa},
      {"swaHalf", swa, FractionFunction::one, FractionOf::volumes, WeightTransfer::half, MergingDifference::relative, 1,
       false},
      {"swaHarmonic", swa, FractionFunction::one, FractionOf::volumes, WeightTransfer::harmonic,
       MergingDifference::relative, 1, false}};
  return all;
}

MonteCarloOptions optionsOf(const Variant& v, std::size_t particles, std::uint64_t repeat) {
  MonteCarloOptions options;
  options.method = v.method;
  options.particles = particles;
  options.seed = 20;
  options.repeat = repeat;
  options.fraction = v.fraction;
  options.fractionOf = v.of;
  options.fractionConstant = v.constant;
  options.transfer = v.transfer;
  options.merging = v.merging;
  return options;
}

PopulationModel coagulation(CollisionKernelType type, double rate) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = rate;
  return model;
}

InitialPopulation start(InitialPopulation::Distribution distribution, double number = 1e6, double volume = 1) {
  InitialPopulation initial;
  initial.distribution = distribution;
  initial.number = number;
  initial.volume = volume;
  return initial;
}

// M_k over N0 v0^k at the end, all repeats.
std::array<std::vector<double>, 4> endMoments(const PopulationModel& model, const InitialPopulation& initial,
                                              const Variant& v, double end, std::size_t particles,
                                              std::uint64_t repeats) {
  std::array<std::vector<double>, 4> result;
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    const auto solver = makeMonteCarlo(model, initial, optionsOf(v, particles, repeat));
    solver->advance(end);
    const auto m = solver->moments();
    double scale = initial.number;
    for (std::size_t k = 0; k < 4; ++k, scale *= initial.volume) result[k].push_back(m[k] / scale);
    EXPECT_LE(solver->particles(), particles);
  }
  return result;
}

// Some 80 z-scores are looked at: one of them beyond 4 has a probability of 0.5 %, beyond 3.3 of 8 %.
constexpr double manyLimit = 4;

void expectUnbiased(const std::array<std::vector<double>, 4>& moments, const std::array<double, 4>& exact) {
  for (const std::size_t k : {0u, 2u, 3u}) {
    const Sample sample = summarise(moments[k]);
    EXPECT_LT(std::abs(sample.z(exact[k])), manyLimit) << "M" << k << " " << sample.mean << " exact " << exact[k];
  }
}

class EveryWeightedMethod : public ::testing::TestWithParam<Variant> {};

// From an exponential distribution; tau = A N0 t = 4: M0 = 1/3, m2 = 2 + tau, m3 = 6 + 6 tau + 3 tau^2 / 2.
TEST_P(EveryWeightedMethod, IsRightForTheConstantKernel) {
  const auto m = endMoments(coagulation(CollisionKernelType::constant, 1e-6),
                            start(InitialPopulation::Distribution::exponential), GetParam(), 4, 500, 100);
  expectUnbiased(m, {1.0 / 3, 1, 6, 54});
  for (const double m1 : m[1]) {
    if (GetParam().keepsMass) {
      EXPECT_NEAR(m1, 1, 1e-11);
    }
  }
  const Sample mass = summarise(m[1]);
  EXPECT_LT(std::abs(mass.mean - 1), zLimit * mass.standardError + 1e-11);
}

// tau = B N0 v0 t = 0.8: M0 = exp(-tau), m2 = exp(2 tau), m3 = 3 exp(4 tau) - 2 exp(3 tau).
TEST_P(EveryWeightedMethod, IsRightForTheAdditiveKernel) {
  const double tau = 0.8;
  const auto m = endMoments(coagulation(CollisionKernelType::additive, 1e-6),
                            start(InitialPopulation::Distribution::monodisperse), GetParam(), tau, 500, 100);
  expectUnbiased(m, {std::exp(-tau), 1, std::exp(2 * tau), 3 * std::exp(4 * tau) - 2 * std::exp(3 * tau)});
}

// Deposition at a constant rate thins the population: M_k = k! exp(-D t), halved particles and all.
TEST_P(EveryWeightedMethod, IsRightForDeposition) {
  PopulationModel model;
  model.deposition = DepositionOptions{1, 0};
  const auto m = endMoments(model, start(InitialPopulation::Distribution::exponential), GetParam(), 1.5, 500, 100);
  for (const std::size_t k : {0u, 1u}) EXPECT_LT(std::abs(summarise(m[k]).z(std::exp(-1.5))), zLimit) << "M" << k;
}

// dv/dt = v in split steps and jumps of a small monomer; and dilution, which is exact.
TEST_P(EveryWeightedMethod, GrowsAndDilutes) {
  PopulationModel model;
  model.growth.condensation = 1;
  model.dilution = 0.5;
  const auto initial = start(InitialPopulation::Distribution::monodisperse);
  const auto m = endMoments(model, initial, GetParam(), 1, 200, 2);
  for (std::size_t k = 0; k < 4; ++k) {
    const double exact = std::exp(static_cast<double>(k) - 0.5);
    EXPECT_NEAR(m[k][0], exact, 1e-11 * exact);
  }
  model.dilution = 0;
  model.growth.treatment = GrowthOptions::Treatment::jumps;
  model.growth.monomer = 0.1;
  const auto jumped = endMoments(model, initial, GetParam(), 1, 200, 40);
  EXPECT_NEAR(jumped[0][0], 1, 1e-12);
  EXPECT_LT(std::abs(summarise(jumped[1]).z(std::exp(1))), zLimit);
}

INSTANTIATE_TEST_SUITE_P(All, EveryWeightedMethod, ::testing::ValuesIn(variants()),
                         [](const auto& v) { return v.param.name; });

// Both stores, bounds with fictitious jumps and exact sums, have the same law: they agree with each other where there
// is no exact solution at hand.
TEST(WeightedMethod, ExactRatesGiveTheSameMeans) {
  const Variant v{"sammc", sammc, FractionFunction::hyperbolic, FractionOf::weights};
  PopulationModel model = coagulation(CollisionKernelType::additive, 1e-6);
  model.breakage = BreakageOptions{0.3, 0.5, 3, BreakageOptions::Daughters::equal};
  std::array<std::array<std::vector<double>, 4>, 2> m;
  for (const EventRates rates : {EventRates::majorant, EventRates::exact}) {
    for (std::uint64_t repeat = 0; repeat < 60; ++repeat) {
      MonteCarloOptions options = optionsOf(v, 100, repeat);
      options.rates = rates;
      options.seed = rates == EventRates::exact ? 5 : 6;
      const auto solver = makeMonteCarlo(model, start(InitialPopulation::Distribution::exponential), options);
      solver->advance(1);
      if (rates == EventRates::exact) {
        EXPECT_EQ(solver->counters().fictitious, 0u);
      }
      for (std::size_t k = 0; k < 4; ++k) m[static_cast<std::size_t>(rates)][k].push_back(solver->moments()[k]);
    }
  }
  for (const std::size_t k : {0u, 2u, 3u}) {
    const Sample a = summarise(m[0][k]), b = summarise(m[1][k]);
    EXPECT_LT(std::abs(a.mean - b.mean), zLimit * std::hypot(a.standardError, b.standardError)) << "M" << k;
  }
}

// Binary breakage into uniform fragments at the rate v: M0/N0 = 1 + t.
TEST(WeightedMethod, SammcBreaksWithoutBiasAndMmcDoesNot) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::uniform};
  const auto initial = start(InitialPopulation::Distribution::monodisperse);
  const auto right = endMoments(model, initial, {"sammc", sammc}, 8, 500, 100);
  EXPECT_LT(std::abs(summarise(right[0]).z(9)), zLimit);
  for (const double m1 : right[1]) EXPECT_NEAR(m1, 1, 1e-11);
  // Weights that are added to particles of another volume do not conserve mass.
  const auto biased = endMoments(model, initial, {"mmc", mmc}, 8, 500, 100);
  EXPECT_GT(std::abs(summarise(biased[1]).z(1)), 2 * zLimit);
}

// Each breakage at the rate v adds its weight to the number, and merging keeps the number: M0 - M1 t is a martingale
// whose variance is the integral of the mean of sum w^2 v. That holds however unequal merging has made the weights.
TEST(WeightedMethod, TheNoiseOfBreakageIsThatOfTheWeights) {
  using Method = WeightedMethod<Sphere, SortedStore<WeightedRates<Sphere>>>;
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::uniform};
  const auto initial = start(InitialPopulation::Distribution::monodisperse, 1);
  std::vector<double> difference;
  double sum = 0;
  for (std::uint64_t repeat = 0; repeat < 400; ++repeat) {
    const MonteCarloOptions options = optionsOf({"", sammc}, 100, repeat);
    RandomStream random(options.seed, repeat, JumpProcess<Method>::streamPurpose);
    const Sphere type(model.density);
    Method method(type, model, initial, options, random);
    JumpProcess<Method> process(std::move(method), model, options, random);
    double integral = 0;
    constexpr double step = 0.01, end = 2;
    for (int k = 0; k < 200; ++k) {  // in the middles of the steps
      process.advance((k + 0.5) * step);
      process.method().forEachParticle(
          [&](const auto& particle, double weight) { integral += step * weight * weight * type.volume(particle); });
    }
    process.advance(end);
    const double deviation = process.moments()[0] - (1 + end);
    difference.push_back(deviation * deviation - integral);
    sum += integral / 400;
  }
  EXPECT_LT(std::abs(summarise(difference).z(0)), zLimit);
  EXPECT_GT(sum, 5 * 0.01 * 2);  // far above that of equal weights: the start particles have become few and heavy
}

// Twelve equal fragments at the rate v^1.8 conserve mass; nuclei of the volume of all particles are exact in number up
// to the one that is on its way.
TEST(WeightedMethod, ManyFragmentsAndNuclei) {
  PopulationModel breakage;
  breakage.breakage = BreakageOptions{1, 1.8, 12, BreakageOptions::Daughters::equal};
  const auto broken =
      endMoments(breakage, start(InitialPopulation::Distribution::monodisperse), {"sammc", sammc}, 3, 200, 5);
  for (const double m1 : broken[1]) EXPECT_NEAR(m1, 1, 1e-11);
  PopulationModel nucleation;
  nucleation.nucleation.emplace();
  nucleation.nucleation->rate = 2e6;
  for (const MonteCarloMethod method : {mmc, sammc, swa}) {
    // A nucleus stands for N0/N: half of it is the most that may be missing in either direction.
    const auto m =
        endMoments(nucleation, start(InitialPopulation::Distribution::monodisperse), {"", method}, 3, 200, 5);
    for (const double m0 : m[0]) EXPECT_NEAR(m0, 7, 1.0 / 200);
    // From nothing: the weight is that of the expected number.
    MonteCarloOptions options = optionsOf({"", method}, 200, 0);
    options.expectedNumber = 6e6;
    const auto solver = makeMonteCarlo(nucleation, {}, options);
    solver->advance(3);
    EXPECT_NEAR(solver->moments()[0], 6e6, 6e6 / 200);
    EXPECT_LE(solver->particles(), 200u);
    EXPECT_GE(solver->particles(), 199u);
  }
}

// Distribution against the exact one: clusters of k after tau = 4 of the constant kernel, (tau/2)^(k-1) / (1 +
// tau/2)^(k+1).
TEST(WeightedMethod, CountsInBins) {
  std::array<std::vector<double>, 4> number;
  for (std::uint64_t repeat = 0; repeat < 100; ++repeat) {
    const auto solver = makeMonteCarlo(
        coagulation(CollisionKernelType::constant, 1e-6), start(InitialPopulation::Distribution::monodisperse),
        optionsOf({"", sammc, FractionFunction::hyperbolic, FractionOf::weights}, 300, repeat));
    solver->advance(4);
    const std::vector<double> edges = {0.5, 1.5, 2.5, 3.5, 4.5};
    const auto bins = solver->numberInBins(edges);
    ASSERT_EQ(bins.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) number[k].push_back(bins[k] / 1e6);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT(std::abs(summarise(number[k]).z(std::pow(2, k) / std::pow(3, k + 2))), zLimit) << k + 1;
  }
}

}  // namespace
}  // namespace lampblack::test
