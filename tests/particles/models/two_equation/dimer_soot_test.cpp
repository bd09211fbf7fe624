#include "particles/models/two_equation/dimer_soot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"
#include "particles/soot/soot_oxidation.hpp"
#include "tests/particles/models/soot_model_checks.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

TEST(DimerSoot, ConservesCarbonHydrogenAndOxygenToRoundOff) {
  test::expectConserved(DimerSoot(test::naphthalene()), 1);
  test::expectConserved(DimerSoot(test::threePah()), 2);
  SootModelOptions none;  // no PAH at all: only the surface
  test::expectConserved(DimerSoot(none), 3);
}

TEST(DimerSoot, TakesNothingFromZero) {
  test::expectNothingTakenFromZero(DimerSoot(test::threePah()), 4);
}

TEST(DimerSoot, DifferencesAreTheDerivatives) {
  test::expectJacobian(DimerSoot(test::threePah()), 5, 1e-5);
}

// In a state soot can be in, and with particles far larger than nuclei, it is the two-equation model unchanged.
TEST(DimerSoot, IsTheTwoEquationModelWhereSootIsInAPossibleState) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 2e-4, 0.03, {1e-6, 3e-7, 1e-7});
  const DimerSoot soot(test::threePah());
  const TwoEquationSoot::Population population{1e17, 1e-3, 2e-5};
  const auto expected = soot.twoEquation().sources(gas.state, population);
  const std::vector<double> densities{population.number, population.carbon, population.hydrogen};
  std::vector<double> rates(3), exchange(gas.concentrations.size());
  soot.sources(gas.state, densities, rates, exchange);
  EXPECT_EQ(rates[1], expected.carbon);
  EXPECT_EQ(rates[2], expected.hydrogen);
  EXPECT_EQ(exchange[4], expected.gas[SootSpecies::O2]);
  EXPECT_EQ(exchange[7], expected.gas[SootSpecies::fixed]);
  // What oxidation takes from the number: (nucleus / mean)^2 of its share of the mass. A mean particle has 1e-20 kg of
  // carbon, a nucleus of four naphthalenes 40 atoms, 8e-25 kg: 6.4e-9.
  const double share = std::pow(40 * 12.011e-3 / constants::avogadro / 1e-20, 2);
  const double lost = (expected.oxidationO2 + expected.oxidationOH) / population.mass();
  // Only of what is lost on balance.
  const double net =
      netOxidation(-expected.oxidationO2 - expected.oxidationOH, expected.growth + expected.condensation);
  EXPECT_NEAR(soot.processes(gas.state, densities).oxidationNumber / (net * share * lost * population.number), 1,
              1e-12);
  EXPECT_NEAR(rates[0], expected.number, 1e-8 * std::abs(lost) * population.number);
}

TEST(DimerSoot, BurnsNumberInProportionToMassOnceTheMeanParticleIsANucleus) {
  const test::FlameGas gas(1900, 1e-4, 1e-4, 3e-3, 0.1, 0.05, 0, {0});
  const DimerSoot soot(test::naphthalene());
  const double carbon = 1e-10, number = carbon / (40 * 12.011e-3 / constants::avogadro);
  std::vector<double> rates(3), exchange(8);
  // Also where an iterate has more particles than the carbon makes nuclei.
  for (double excess : {1.0, 10.0}) {
    const std::vector<double> densities{excess * number, carbon, 0};
    soot.sources(gas.state, densities, rates, exchange);
    EXPECT_LT(rates[1], 0);
    EXPECT_NEAR(soot.processes(gas.state, densities).oxidationNumber / (excess * number) / (rates[1] / carbon), 1,
                1e-12);
  }
}

// Where growth makes up for oxidation no particle of an ensemble shrinks, so that none vanishes; nor does one here.
// Nuclei burn in the same gas without acetylene.
TEST(DimerSoot, ParticlesThatGrowOnBalanceDoNotVanish) {
  SootModelOptions options = test::naphthalene();
  options.coagulation = options.inception = options.condensation = false;
  options.alpha = 1;
  const DimerSoot soot(options);
  const double nucleus = 40 * 12.011e-3 / constants::avogadro, number = 1e17, carbon = 1.1 * nucleus * number;
  for (const bool acetylene : {true, false}) {
    const test::FlameGas gas(1700, 1e-2, 0.03, 1e-4, 0.08, 1e-4, acetylene ? 1.0 : 0.0, {0});
    const std::vector<double> densities{number, carbon, 0};
    const ParticleProcesses p = soot.processes(gas.state, densities);
    const double burning = -(p.oxidationO2 + p.oxidationOH) / carbon;  // 1/s
    ASSERT_EQ(acetylene, p.growth > -2 * (p.oxidationO2 + p.oxidationOH));
    EnsembleOptions stochastic;
    stochastic.particles = 200;
    stochastic.soot = options;
    const auto particles = makeEnsemble(stochastic);
    particles->initialise(test::equalSpheres(100, carbon / number, 0, number));
    particles->advance(gas.state, 0, 1 / burning);
    EXPECT_EQ(particles->counters().vanished, acetylene ? 0U : 100U);
    const double vanishing = -p.oxidationNumber / number / burning;
    if (acetylene)
      EXPECT_LT(vanishing, 1e-3);
    else
      EXPECT_NEAR(vanishing, 1 / (1.1 * 1.1), 1e-3);  // (nucleus / mean)^2
  }
}

// Two molecules make a dimer; more particles than the carbon makes nuclei meet as often as so many particles do.
TEST(DimerSoot, CountsDimersByTheirMoleculesAndCollisionsByTheirParticles) {
  const test::FlameGas gas(1600, 1e-3, 0.03, 1e-4, 0.08, 2e-4, 0.03, {1e-6, 3e-7, 1e-7});
  const DimerSoot soot(test::threePah());
  const double carbon = 1e-6, nuclei = carbon / (40 * 12.011e-3 / constants::avogadro);
  std::vector<double> rates(3), exchange(gas.concentrations.size());
  soot.sources(gas.state, std::vector<double>{nuclei, carbon, 0}, rates, exchange);
  const ParticleProcesses full = soot.processes(gas.state, std::vector<double>{nuclei, carbon, 0});
  EXPECT_NEAR(full.dimerProduction / (-0.5 * constants::avogadro * (exchange[7] + exchange[8] + exchange[9])), 1,
              1e-14);
  const ParticleProcesses twice = soot.processes(gas.state, std::vector<double>{2 * nuclei, carbon, 0});
  EXPECT_LT(full.coagulationNumber, 0);
  EXPECT_NEAR(twice.coagulationNumber / full.coagulationNumber, 4, 1e-14);
}

TEST(DimerSoot, StaysBoundedInStatesThatNoSootIsIn) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 2e-4, 0.03, {1e-6});
  const DimerSoot soot(test::naphthalene());
  // Surface events over the carbon there is: at most those of nuclei, whose surface over carbon is the largest.
  const double nucleus = 40 * 12.011e-3 / constants::avogadro;
  std::vector<double> rates(3), exchange(8), nuclei(8);
  for (double carbon : {1e-20, 1e-10, 1e-3}) {
    soot.sources(gas.state, std::vector<double>{carbon / nucleus, carbon, 0}, rates, nuclei);
    for (double number : {0.0, 1e-30, 1e10, 1e20, 1e40}) {
      for (double hydrogen : {0.0, 1e-20, 1.0}) {
        soot.sources(gas.state, std::vector<double>{number, carbon, hydrogen}, rates, exchange);
        // Hydrogen up to two atoms a carbon atom widens the sphere by (1 + 2/12)^(2/3) at most.
        EXPECT_LE(std::abs(exchange[5]), 1.11 * 1.0001 * std::abs(nuclei[5]));
      }
    }
  }
}

TEST(DimerSoot, FreeMolecularCoagulationOfEqualSpheresIsExact) {
  DimerSoot model(test::naphthalene());
  model.setAdvanceTolerance(1e-8);
  test::FlameGas gas(1600, 0, 0, 0, 0, 0, 0, {0});
  gas.state.pressure = 1e-6;  // Knudsen number so large that the continuum branch is 1e-9 of the resistance
  const double number = 1e18, mass = number * 1850 * constants::pi / 6 * std::pow(3e-9, 3), t = 1e-3;
  std::vector<double> soot{number, mass, 0}, cell = gas.concentrations;
  model.advance(gas.state, t, soot, cell);
  const double K =
      2.2 * std::sqrt(24 * constants::boltzmann * 1600 / 1850) * std::pow(6 * mass / (constants::pi * 1850), 1.0 / 6);
  const double exact = std::pow(std::pow(number, -5.0 / 6) + 5.0 / 6 * K * t, -6.0 / 5);
  EXPECT_LT(exact / number, 0.5);
  EXPECT_NEAR(soot[0] / exact, 1, 1e-6);
  EXPECT_NEAR(soot[1] / mass, 1, 1e-15);
}

TEST(DimerSoot, NaphthaleneAloneDecaysByItsSecondOrderLaw) {
  SootModelOptions options = test::naphthalene();
  options.surfaceGrowth = options.oxidation = false;
  DimerSoot model(options);
  model.setAdvanceTolerance(1e-8);
  const test::FlameGas gas(1500, 0, 0, 0, 0, 0, 0, {1e-4});
  PahArray loss{};
  model.twoEquation().dimers().lossRates(1500, gas.pah(), loss);
  std::vector<double> soot(3), cell = gas.concentrations;
  const double dt = 0.05;
  model.advance(gas.state, dt, soot, cell);
  ASSERT_GT(loss[0] * dt, 0.1);
  EXPECT_NEAR(cell[SootSpecies::fixed] / (gas.pah()[0] / (1 + loss[0] * dt)), 1, 1e-6);
  const double taken = (gas.pah()[0] - cell[SootSpecies::fixed]) * (10 * 12.011e-3 + 8 * 1.008e-3);
  EXPECT_NEAR((soot[1] + soot[2]) / taken, 1, 1e-9);
}

}  // namespace
}  // namespace lampblack::particles
