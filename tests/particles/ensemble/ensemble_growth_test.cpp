// Condensation, growth and oxidation of stochastic soot against closed solutions and the two-equation model.
#include <gtest/gtest.h>

#include <cmath>

#include "../statistics.hpp"
#include "core/modules.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "particles/soot/surface_chemistry.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

constexpr double rho = 1850;

double massOf(double d) {
  return rho * constants::pi / 6 * d * d * d;
}

EnsembleOptions withoutJumps(SootModelOptions soot) {
  EnsembleOptions options;
  options.particles = 64;
  options.soot = std::move(soot);
  options.soot.coagulation = options.soot.inception = false;
  return options;
}

// An O2 takes two carbon atoms (two CO), which OH does not: see surface_chemistry.hpp.
TEST(StochasticGrowth, OxygenTakesTwoCarbonAtoms) {
  const test::FlameGas gas(1800, 1e-3, 0.03, 0, 0.1, 0.02, 0, {0});
  SootModelOptions soot = test::naphthalene();
  soot.alpha = 0.7;
  const double events =
      SurfaceChemistry(soot, 1800).rates(gas.concentrations, 0.7).oxidationO2 * gas[SootSpecies::O2];  // mol/m2/s
  const double fraction = 0.05, flux = 2 * 12.011e-3 * events / (1 - fraction);
  const auto population = makeEnsemble(withoutJumps(soot));
  population->initialise(test::equalSpheres(1, massOf(20e-9), fraction, 1e15));
  population->advance(gas.state, 0, 4e-9 * rho / (2 * flux));
  EXPECT_NEAR(population->totals().meanDiameter() / 16e-9, 1, 1e-11);
}

TEST(StochasticGrowth, OfEqualSpheresFollowsTheTwoEquationModel) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-6, 0.03, {2e-5, 3e-6, 2e-6});
  const EnsembleOptions options = withoutJumps(test::threePah());
  const auto population = makeEnsemble(options);
  const double N = 1e16, mass = massOf(3e-9);
  population->initialise(test::equalSpheres(4, mass, 0.05, N));
  DimerSoot model(options.soot);
  model.setAdvanceTolerance(1e-6);
  std::vector<double> soot{N, 0.95 * mass * N, 0.05 * mass * N};
  const int steps = 200;
  const double dt = 2e-4;
  for (int k = 0; k < steps; ++k) {  // the gas is put back after every step, as for the population
    std::vector<double> cell = gas.concentrations;
    model.advance(gas.state, dt / steps, soot, cell);
  }
  population->advance(gas.state, 0, dt);
  ASSERT_GT(soot[DimerSoot::carbon], 1.3 * 0.95 * mass * N);
  // Splitting error: second order in the splitting step, (1 %)^2, with a margin of ten; gas depletion per step 1e-4.
  const auto totals = population->totals();
  EXPECT_NEAR(totals.mass() / (soot[DimerSoot::carbon] + soot[DimerSoot::hydrogen]), 1, 1e-3);
  EXPECT_NEAR(totals.hydrogen / soot[DimerSoot::hydrogen], 1, 1e-3);
}

// Mass of an ensemble that grows, and may be born, while the gas expands, in splitting steps of a tolerance.
double massInSteps(double tolerance, bool inception) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-6, 0.03, {2e-5, 3e-6, 2e-6});
  EnsembleOptions options = withoutJumps(test::threePah());
  options.soot.inception = inception;
  options.particles = 1024;
  options.splitTolerance = tolerance;
  const auto population = makeEnsemble(options);
  if (!inception) population->initialise(test::equalSpheres(4, massOf(3e-9), 0.05, 1e16));
  population->advance(gas.state, 2e3, 5e-4);
  return population->totals().mass();
}

// What a step knows of the population is that of the moment: else long steps would be off by their length, not its
// square.
TEST(StochasticGrowth, LongStepsUnderDilutionFindTheSame) {
  // 4.7e-4 and 1.9e-3: of second order.
  EXPECT_NEAR(massInSteps(0.04, false) / massInSteps(0.002, false), 1, 1e-3);
  EXPECT_NEAR(massInSteps(0.08, false) / massInSteps(0.002, false), 1, 4e-3);
  EXPECT_NEAR(massInSteps(0.04, true) / massInSteps(0.002, true), 1, 6e-3);
}

TEST(StochasticGrowth, InceptionAndCondensationTakeUpAllThePah) {
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {2e-5, 3e-6, 2e-6});
  EnsembleOptions options;
  options.soot = test::threePah();
  options.soot.surfaceGrowth = options.soot.oxidation = false;
  const auto s = TwoEquationSoot(options.soot).sources(gas.state, {});
  const double dt = 5e-4;
  std::vector<double> mass;
  for (std::uint64_t repeat = 0; repeat < 12; ++repeat) {
    options.owner = repeat;
    const auto population = makeEnsemble(options);
    population->advance(gas.state, 0, dt);
    mass.push_back(population->totals().mass());
  }
  // The steady dimers hand on what is produced, however they share it: mass is production times time. The splitting
  // (dimers held over a half step) errs by less than the square of ten times its tolerance.
  const auto sample = test::summarise(mass);
  EXPECT_LT(std::abs(sample.mean - s.nucleation * dt),
            test::zLimit * sample.standardError + 0.0025 * s.nucleation * dt);
}

}  // namespace
}  // namespace lampblack::particles
