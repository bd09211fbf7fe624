// Nuclei of two molecules of a PAH, their condensation, and growth in whole events.
#include <gtest/gtest.h>

#include <cmath>

#include "../statistics.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/soot/soot_medium.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

SootModelOptions pyrene() {
  SootModelOptions soot;
  soot.pah = {{"A4", 16, 10, 0}};
  soot.sootDensity = 1800;
  soot.inceptionBy = InceptionBy::monomers;
  soot.monomerMass = 3.2e-25;
  soot.monomerDiameter = 7.11e-10;
  soot.slip = SlipLaw::air;
  return soot;
}

SootModelOptions only(bool inception, bool condensation) {
  SootModelOptions soot = pyrene();
  soot.coagulation = soot.surfaceGrowth = soot.oxidation = false;
  soot.inception = inception;
  soot.condensation = condensation;
  return soot;
}

constexpr double T = 1700;

test::FlameGas gasOf(double pah) {
  return {T, 5e-4, 0.05, 4e-6, 0.1, 1e-5, 0.04, {pah}};
}

// Half the collisions of the gas with itself: the harmonic mean of the two regimes, worked out here from the constants.
double inceptionRate(const test::FlameGas& gas, double pah) {
  const double k = constants::boltzmann, m = 3.2e-25, d = 7.11e-10, p = constants::oneAtmosphere;
  const double free = 2.2 * std::sqrt(constants::pi * k * T / 2) * std::sqrt(2 / m) * 4 * d * d;
  const double knudsen = 4.74e-5 * T / (p * d);
  const double slip = 2 * k * T / (3 * gas.state.viscosity) * (1 + 1.257 * knudsen) * (2 / d) * (2 * d);
  const double n = pah * p / (k * T);
  return 0.5 * free * slip / (free + slip) * n * n;
}

TEST(Monomers, InceptionIsHalfOfTheirCollisions) {
  const test::FlameGas gas = gasOf(2e-7);
  const SootModelOptions soot = pyrene();
  const DimerModel dimers(soot);
  const SootMedium medium(soot, dimers, gas.state, true);
  EXPECT_NEAR(medium.inception(0) / inceptionRate(gas, 2e-7), 1, 1e-12);
  EXPECT_EQ(medium.inception(1e9), medium.inception(0));  // what condenses takes nothing away from it
  EXPECT_EQ(dimers.smallestNucleus(), 32);
}

TEST(Monomers, CondenseByTheirOwnMassOrTheReducedOne) {
  const test::FlameGas gas = gasOf(2e-7);
  SootModelOptions soot = pyrene();
  const double m = 3.2e-25, d = 7.11e-10, M = 64 * 12.011e-3 / constants::avogadro;
  const SootAggregate type(1800, true);
  const SootAggregate::Particle p = type.make(M, 0, 1);
  const double reach = d + std::cbrt(6 * M / (constants::pi * 1800));
  const double prefactor = 2.2 * std::sqrt(constants::pi * constants::boltzmann * T / 2) * reach * reach;
  for (const bool heavy : {false, true}) {
    soot.heavyParticles = heavy;
    const SootMedium medium(soot, DimerModel(soot), gas.state, true);
    const double expected = prefactor * std::sqrt(1 / m + (heavy ? 0 : 1 / M)), rate = medium.collision(p);
    EXPECT_NEAR(rate / expected, 1, 1e-12);
    const SootAggregate::Particle larger = type.make(M * 1.0001, 0, 1), smaller = type.make(M / 1.0001, 0, 1);
    const double slope = (medium.collision(larger) - medium.collision(smaller)) / (2 * std::log(1.0001) / 3);
    EXPECT_NEAR(medium.collisionSlope(p, rate) / slope, 1, 1e-6);
  }
}

class MonomersBy : public testing::TestWithParam<EnsembleMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, MonomersBy, testing::Values(EnsembleMethod::dsmc, EnsembleMethod::sammc));

// Both ways of growth: numbers as born, two molecules each, and all atoms from the gas.
TEST_P(MonomersBy, NucleiAreOfTwoAndAtomsAreKept) {
  const test::FlameGas gas = gasOf(2e-7);
  for (const bool events : {false, true})
    for (const bool keepsHydrogen : {false, true}) {
      EnsembleOptions options;
      options.method = GetParam();
      options.particles = 500;
      options.growthByEvents = events;
      options.keepsHydrogen = keepsHydrogen;
      options.soot = pyrene();
      const auto soot = makeEnsemble(options);
      soot->advance(gas.state, 0, 2e-3);
      const EnsembleExchange x = soot->takeExchange();
      const auto totals = soot->totals();
      EXPECT_NEAR((totals.carbon - x.resampledCarbon) / x.carbon, 1, 1e-10);
      EXPECT_NEAR(totals.hydrogen - x.resampledHydrogen, x.hydrogen, 1e-10 * totals.carbon);
      const double W = options.soot.carbonWeight, WH = options.soot.hydrogenWeight;
      using S = SootSpecies;
      const double carbon = 2 * x.gas[S::C2H2] + x.gas[S::CO] + 16 * x.gas[S::fixed];
      const double hydrogen = 2 * x.gas[S::C2H2] + x.gas[S::H] + 2 * x.gas[S::H2] + x.gas[S::OH] + 10 * x.gas[S::fixed];
      EXPECT_NEAR(-carbon * W / x.carbon, 1, 1e-10);
      EXPECT_NEAR(-hydrogen * WH, x.hydrogen, 1e-10 * x.carbon);
      EXPECT_NEAR(x.gas[S::CO] + x.gas[S::OH] + 2 * x.gas[S::O2], 0, 1e-10 * std::abs(x.gas[S::C2H2]));
      const double nucleus = 2 * (16 * W + (keepsHydrogen ? 10 * WH : 0)) / constants::avogadro;
      EXPECT_NEAR(x.nucleated / (x.nucleatedNumber * nucleus), 1, 1e-12);
      EXPECT_NEAR(x.nucleatedNumber / (2e-3 * inceptionRate(gas, 2e-7)), 1,
                  0.01);  // one numerical particle of some hundred
      EXPECT_GT(x.condensed, 0);
      EXPECT_GT(x.oxidisedOH, 0);
    }
}

// Molecules that condense on large particles: as many as a Poisson number of the mean that the rate says, variance and
// all.
TEST_P(MonomersBy, EventsOfGrowthArePoissonNumbersOfTheRatesMean) {
  const test::FlameGas gas = gasOf(1e-7);
  EnsembleOptions options;
  options.method = GetParam();
  options.particles = 4000;
  options.growthByEvents = true;
  options.keepsHydrogen = false;
  options.soot = only(false, true);
  options.soot.heavyParticles = true;
  const auto soot = makeEnsemble(options);
  const double atom = options.soot.carbonWeight / constants::avogadro, start = 1e8 * atom;
  soot->initialise(test::equalSpheres(4000, start, 0, 1e12));
  const SootMedium medium(options.soot, DimerModel(options.soot), gas.state, false);
  const SootAggregate type(1800, true);
  const double rate = medium.collision(type.make(start, 0, 1)) * medium.dimers(0);
  const std::vector<double> packed = soot->pack();
  for (const double expected : {0.4, 3.0, 12.0, 300.0}) {  // one by one, and drawn as a number
    soot->unpack(packed);
    soot->advance(gas.state, 0, expected / rate);
    double sum = 0, squares = 0;
    const auto particles = soot->particles();
    ASSERT_EQ(particles.size(), 4000u);
    for (const GivenParticle& p : particles) {
      const double molecules = (p.carbon - start) / (16 * atom);
      EXPECT_NEAR(molecules, std::round(molecules), 1e-4);
      sum += molecules;
      squares += molecules * molecules;
    }
    const double mean = sum / 4000, variance = squares / 4000 - mean * mean;
    // Standard errors: sqrt(m/4000) of the mean m, sqrt((m + 2 m^2)/4000) of the variance; 4.5 of them.
    EXPECT_NEAR(mean, expected, 4.5 * std::sqrt(expected / 4000));
    EXPECT_NEAR(variance, expected, 4.5 * std::sqrt(expected * (1 + 2 * expected) / 4000));
  }
}

// All four kinds at once, of small particles over a short time: means as growth by the mean has them.
TEST(GrowthByEvents, HasTheMeansOfGrowthByTheMean) {
  const test::FlameGas gas = gasOf(5e-7);
  double moved[2][4] = {};
  for (const bool events : {false, true}) {
    EnsembleOptions options;
    options.particles = 20000;
    options.growthByEvents = events;
    options.soot = pyrene();
    options.soot.coagulation = options.soot.inception = false;
    options.shape = SootShape::aggregates;
    const auto soot = makeEnsemble(options);
    const double mass = 2000 * options.soot.carbonWeight / constants::avogadro;
    std::vector<GivenParticle> given = test::equalSpheres(20000, mass, 0.01, 1e15);
    for (GivenParticle& p : given) p.primaries = 3;
    soot->initialise(given);
    soot->advance(gas.state, 0, 2e-4);
    const EnsembleExchange x = soot->takeExchange();
    const double values[4] = {x.condensed, x.grown, x.oxidisedO2, x.oxidisedOH};
    for (std::size_t k = 0; k < 4; ++k) moved[events ? 1 : 0][k] = values[k];
  }
  const double atom = 12.011e-3 / constants::avogadro, weight = 1e15 / 20000;
  const double each[4] = {16.84 * atom, 2 * atom, 2 * atom, atom};  // kg an event
  for (std::size_t k = 0; k < 4; ++k) {
    const double events = moved[0][k] / (weight * each[k]);
    ASSERT_GT(events, 20) << k;
    EXPECT_NEAR(moved[1][k] / moved[0][k], 1, 4.5 / std::sqrt(events) + 2e-3) << k;
  }
}

// A particle of the smallest nucleus that loses an atom is gone, with all its atoms; nothing is left below it.
TEST_P(MonomersBy, WhatFallsBelowTheNucleusIsGoneWithItsAtoms) {
  const test::FlameGas gas(T, 0, 0.05, 1e-4, 0.1, 0, 0, {0});
  EnsembleOptions options;
  options.method = GetParam();
  options.particles = 3000;
  options.growthByEvents = true;
  options.soot = pyrene();
  options.soot.coagulation = false;
  const auto soot = makeEnsemble(options);
  const double nucleus = 32 * options.soot.carbonWeight / constants::avogadro;
  soot->initialise(test::equalSpheres(3000, nucleus, 0, 1e15));
  const SurfaceRates rates = SurfaceChemistry(options.soot, T).rates(gas.concentrations, 1);
  const double d = std::cbrt(6 * nucleus / (constants::pi * 1800));
  const double rate = rates.oxidationOH * gas[SootSpecies::OH] * constants::avogadro * constants::pi * d * d;
  soot->advance(gas.state, 0, 0.5 / rate);
  const EnsembleExchange x = soot->takeExchange();
  const double gone = 1 - std::exp(-0.5);
  EXPECT_NEAR(x.oxidisedNumber / 1e15, gone, 4.5 * std::sqrt(gone * (1 - gone) / 3000));
  EXPECT_NEAR(x.oxidisedOH / (x.oxidisedNumber * nucleus), 1, 1e-10);
  // Who is gone counts no more for the length of the next step: of the volume each may change a part 3e-4, and they
  // lose a 32nd in the time 1/rate.
  options.splitTolerance = 1e-4;
  const auto stepwise = makeEnsemble(options);
  stepwise->initialise(test::equalSpheres(3000, nucleus, 0, 1e15));
  stepwise->advance(gas.state, 0, 0.5 / rate);
  EXPECT_GT(stepwise->counters().splitSteps, 40u);
  EXPECT_LT(stepwise->counters().splitSteps, 70u);
}

TEST(Monomers, NeedOnePah) {
  EnsembleOptions options;
  options.soot = test::threePah();
  options.soot.inceptionBy = InceptionBy::monomers;
  EXPECT_THROW(static_cast<void>(makeEnsemble(options)), InputError);
}

}  // namespace
}  // namespace lampblack::particles
