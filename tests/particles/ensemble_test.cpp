#include "particles/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "particles/two_equation.hpp"
#include "soot_fixtures.hpp"
#include "statistics.hpp"

namespace lampblack {
namespace {

using test::summarise;
using test::zLimit;

SootModelOptions only(bool coagulation, bool inception) {
  SootModelOptions soot = test::threePah();
  soot.coagulation = coagulation;
  soot.inception = inception;
  soot.condensation = soot.surfaceGrowth = soot.oxidation = false;
  return soot;
}

const test::FlameGas& flame() {
  static const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  return gas;
}

Ensemble monodisperse(CoagulationKernel kernel, std::uint64_t owner, std::size_t particles, double scale = 1) {
  EnsembleOptions options;
  options.capacity = particles;
  options.owner = owner;
  options.soot = only(true, false);
  options.kernel = kernel;
  options.verificationScale = scale;
  Ensemble ensemble(options);
  ensemble.initialise(std::vector<double>(particles, 1e-23), 0.04, 1e18);
  return ensemble;
}

TEST(Ensemble, ConstantKernelGivesTheExactMoments) {
  // tau = K N0 t = 4: M0 = N0/3 and m2 = 1 + tau (spec of exact solutions), past one doubling.
  const double tau = 4, K = 1e-15;
  std::vector<double> zeroth, second;
  for (std::uint64_t repeat = 0; repeat < 60; ++repeat) {
    Ensemble e = monodisperse(CoagulationKernel::constant, repeat, 2000, K);
    const double m2 = e.moment(2), m1 = e.moment(1);
    e.advance(flame().state, 0, tau / (K * 1e18));
    zeroth.push_back(e.numberDensity() / 1e18);
    second.push_back(e.moment(2) / m2);
    ASSERT_NEAR(e.moment(1) / m1, 1, 1e-11);
    ASSERT_GE(e.counters().doublings, 1u);
  }
  // The finite ensemble's own bias is of order 1/2000, a tenth of the standard error.
  EXPECT_LT(std::abs(summarise(zeroth).z(2 / (2 + tau))), zLimit);
  EXPECT_LT(std::abs(summarise(second).z(1 + tau)), zLimit);
}

TEST(Ensemble, AdditiveKernelGivesTheExactMoments) {
  const double tau = 0.8, N0 = 1e18, m0 = 1e-23, B = 1e-15 / m0;
  std::vector<double> zeroth, second;
  for (std::uint64_t repeat = 0; repeat < 60; ++repeat) {
    Ensemble e = monodisperse(CoagulationKernel::additive, repeat, 4000, B);
    const double m2 = e.moment(2);
    e.advance(flame().state, 0, tau / (B * m0 * N0));
    zeroth.push_back(e.numberDensity() / N0);
    second.push_back(e.moment(2) / m2);
  }
  EXPECT_LT(std::abs(summarise(zeroth).z(std::exp(-tau))), zLimit);
  EXPECT_LT(std::abs(summarise(second).z(std::exp(2 * tau))), zLimit);
}

TEST(Ensemble, FreeMolecularCoagulationReachesTheSelfPreservingSpread) {
  std::vector<double> spread;
  for (std::uint64_t repeat = 0; repeat < 8; ++repeat) {
    Ensemble e = monodisperse(CoagulationKernel::freeMolecular, repeat, 8000);
    e.advance(flame().state, 0, 0.04);
    spread.push_back(e.geometricStandardDeviation());
  }
  // Friedlander's 1.46 is rounded to two decimals.
  const auto s = summarise(spread);
  EXPECT_LT(std::abs(s.mean - 1.46), 0.005 + zLimit * s.standardError);
}

TEST(Ensemble, EarlyCoagulationIsThatOfTheTwoEquationModel) {
  const TwoEquationSoot model(only(true, false));
  const double mass = 1e-23, N0 = 1e18;
  const auto s = model.sources(flame().state, {N0, 0.96 * mass * N0, 0.04 * mass * N0});
  const double dt = 0.01 * N0 / -s.coagulationNumber;
  std::vector<double> loss;
  for (std::uint64_t repeat = 0; repeat < 60; ++repeat) {
    Ensemble e = monodisperse(CoagulationKernel::transition, repeat, 4000);
    e.advance(flame().state, 0, dt);
    loss.push_back(1 - e.numberDensity() / N0);
  }
  // dN/dt = -k N^2 from N0 over k N0 dt = 0.01; unequal pairs appear in one event of a hundred and change its rate by
  // a few per cent: below 0.1 % of the loss, a tenth of its standard error.
  EXPECT_LT(std::abs(summarise(loss).z(1 - 1 / 1.01)), zLimit);
}

TEST(Ensemble, InceptionAloneIsPoisson) {
  const SootModelOptions soot = only(false, true);
  const double J = TwoEquationSoot(soot).sources(flame().state, {}).nucleationNumber;
  EnsembleOptions options;
  options.capacity = 1000;
  options.soot = soot;
  options.expectedNumberDensity = 1e14;
  const double volume = 1000 / 1e14, expected = 40, dt = expected / (J * volume);
  const int repeats = 500;
  double sum = 0, chiSquared = 0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    options.owner = static_cast<std::uint64_t>(repeat);
    Ensemble e(options);
    e.advance(flame().state, 0, dt);
    const double n = static_cast<double>(e.size());
    sum += n;
    chiSquared += (n - expected) * (n - expected) / expected;
  }
  EXPECT_LT(std::abs(sum - repeats * expected) / std::sqrt(repeats * expected), zLimit);
  EXPECT_LT(std::abs(chiSquared - repeats) / std::sqrt(2.0 * repeats + repeats / expected), zLimit);
}

// A population that starts from nothing is made of particles born during the step: one long call is as good as many.
TEST(Ensemble, OneCallFromNothingIsAsGoodAsMany) {
  const test::FlameGas gas(1650, 1e-3, 0.03, 1e-5, 0.08, 0, 0.03, {1e-6, 4e-7, 3e-7});
  const double time = 5e-3;
  std::vector<double> one[3], many[3];
  for (std::uint64_t repeat = 0; repeat < 12; ++repeat) {
    for (const bool whole : {true, false}) {
      EnsembleOptions options;
      options.capacity = 500;
      options.owner = repeat;
      options.seed = whole ? 1 : 2;
      options.soot = test::threePah();
      options.expectedNumberDensity = 1e6;
      Ensemble e(options);
      const int calls = whole ? 1 : 250;
      for (int k = 0; k < calls; ++k) e.advance(gas.state, 0, time / calls);
      for (int m = 0; m < 3; ++m) (whole ? one : many)[m].push_back(e.moment(m));
    }
  }
  // The splitting is of second order in steps of 5 %: some 0.25 % of a diameter, six times that of the second moment.
  for (int m = 0; m < 3; ++m) {
    const auto a = summarise(one[m]), b = summarise(many[m]);
    const double noise = zLimit * std::hypot(a.standardError, b.standardError);
    EXPECT_NEAR(a.mean, b.mean, 0.0025 * std::max(1, 3 * m) * b.mean + noise) << "moment " << m;
    EXPECT_LT(noise, 0.1 * b.mean);
  }
}

TEST(Ensemble, ContractionConservesNumberAndMassInExpectation) {
  const SootModelOptions soot = only(false, true);
  const auto s = TwoEquationSoot(soot).sources(flame().state, {});
  EnsembleOptions options;
  options.capacity = 200;
  options.soot = soot;
  const double N0 = 1e16, dt = 2 * N0 / s.nucleationNumber;
  std::vector<double> initial;
  for (int i = 0; i < 200; ++i) initial.push_back(1e-24 * (1 + i % 7));
  const double mass0 = N0 * std::accumulate(initial.begin(), initial.end(), 0.0) / 200;
  std::vector<double> number, mass;
  for (std::uint64_t repeat = 0; repeat < 400; ++repeat) {
    options.owner = repeat;
    Ensemble e(options);
    e.initialise(initial, 0.05, N0);
    e.advance(flame().state, 0, dt);
    ASSERT_EQ(e.size(), 200u);
    ASSERT_EQ(e.counters().contractions, e.counters().inceptions);
    number.push_back(e.numberDensity());
    mass.push_back(e.massDensity());
  }
  EXPECT_LT(std::abs(summarise(number).z(3 * N0)), zLimit);
  EXPECT_LT(std::abs(summarise(mass).z(mass0 + s.nucleation * dt)), zLimit);
}

TEST(Ensemble, DoublingKeepsEveryDensity) {
  Ensemble e = monodisperse(CoagulationKernel::freeMolecular, 3, 500);
  double mass = e.massDensity(), hydrogen = e.hydrogenDensity();
  e.advance(flame().state, 0, 0.02);
  EXPECT_GE(e.counters().doublings, 4u);
  EXPECT_GT(e.size(), 250u - 1);
  EXPECT_NEAR(e.massDensity() / mass, 1, 1e-12);
  EXPECT_NEAR(e.hydrogenDensity() / hydrogen, 1, 1e-12);
}

TEST(Ensemble, DilutionThinsExponentially) {
  EnsembleOptions options;
  options.soot = only(false, false);
  Ensemble e(options);
  e.initialise(std::vector<double>(100, 1e-23), 0, 1e15);
  e.advance(flame().state, 30, 0.01);
  EXPECT_NEAR(e.numberDensity() / (1e15 * std::exp(-0.3)), 1, 1e-13);
}

EnsembleOptions everything(std::uint64_t owner) {
  EnsembleOptions options;
  options.capacity = 300;
  options.seed = 42;
  options.owner = owner;
  options.soot = test::threePah();
  return options;
}

TEST(Ensemble, ResultsDependOnOwnerAndSeedOnlyNotOnTheOrderOfProcessing) {
  std::vector<std::vector<double>> alone;
  for (std::uint64_t owner = 0; owner < 3; ++owner) {
    Ensemble e(everything(owner));
    for (int k = 0; k < 3; ++k) e.advance(flame().state, 5, 2e-4);
    alone.push_back(e.save());
  }
  std::vector<Ensemble> mixed;
  for (const std::uint64_t owner : {2u, 0u, 1u}) mixed.emplace_back(everything(owner));
  for (int k = 0; k < 3; ++k) {
    for (Ensemble& e : mixed) e.advance(flame().state, 5, 2e-4);
  }
  EXPECT_EQ(mixed[0].save(), alone[2]);
  EXPECT_EQ(mixed[1].save(), alone[0]);
  EXPECT_EQ(mixed[2].save(), alone[1]);
  EXPECT_NE(alone[0], alone[1]);
}

TEST(Ensemble, RestoredEnsembleContinuesBitForBit) {
  Ensemble one(everything(7));
  for (int k = 0; k < 3; ++k) one.advance(flame().state, 0, 3e-4);
  const std::vector<double> state = one.save();
  Ensemble other(everything(7));
  other.restore(state);
  for (int k = 0; k < 3; ++k) {
    one.advance(flame().state, 2, 3e-4);
    other.advance(flame().state, 2, 3e-4);
  }
  EXPECT_GT(one.counters().coagulations, 100u);
  EXPECT_EQ(one.save(), other.save());

  EnsembleOptions smaller = everything(7);
  smaller.capacity = 100;
  EXPECT_THROW(Ensemble(smaller).restore(state), InputError);
}

TEST(Ensemble, DistributionIntegratesToTheNumberDensity) {
  Ensemble e = monodisperse(CoagulationKernel::freeMolecular, 1, 2000);
  e.advance(flame().state, 0, 0.005);
  const auto density = e.sizeDistribution(-9.5, -6.5, 60);
  EXPECT_NEAR(std::accumulate(density.begin(), density.end(), 0.0) * 3.0 / 60 / e.numberDensity(), 1, 1e-12);
  EXPECT_NEAR(e.moment(1) / e.volumeFraction(), 1, 1e-12);
  EXPECT_NEAR(e.moment(0) / e.numberDensity(), 1, 1e-12);
}

TEST(Ensemble, MeaninglessOptionsAndPopulationsAreRefused) {
  EnsembleOptions options;
  options.capacity = 1;
  EXPECT_THROW(Ensemble{options}, InputError);
  options.capacity = 4;
  Ensemble e(options);
  EXPECT_THROW(e.initialise(std::vector<double>(5, 1e-24), 0, 1e15), InputError);
  EXPECT_THROW(e.initialise(std::vector<double>{-1.0}, 0, 1e15), InputError);
  EXPECT_THROW(e.advance(SootGasState{}, 0, 1e-3), NumericsError);
}

}  // namespace
}  // namespace lampblack
