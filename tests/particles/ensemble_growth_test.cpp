// Growth, condensation and oxidation of an ensemble's particles against closed solutions and the two-equation model.
#include <gtest/gtest.h>

#include <cmath>

#include "particles/ensemble.hpp"
#include "particles/surface_chemistry.hpp"
#include "particles/two_equation.hpp"
#include "soot_fixtures.hpp"
#include "statistics.hpp"

namespace lampblack {
namespace {

constexpr double rho = 1850;

double massOf(double d) {
  return rho * constants::pi / 6 * d * d * d;
}

EnsembleOptions withoutJumps(SootModelOptions soot) {
  EnsembleOptions options;
  options.capacity = 64;
  options.soot = std::move(soot);
  options.soot.coagulation = options.soot.inception = false;
  return options;
}

TEST(EnsembleGrowth, SurfaceGrowthIsLinearInDiameterAndKeepsHydrogen) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 0, 0.08, 0, 0.03, {});
  SootModelOptions soot;
  soot.alpha = 0.7;
  const double flux = 2 * 12.011e-3 * SurfaceChemistry(soot, 1700).rates(gas.state, 0.7).growth * gas.state.C2H2;
  Ensemble e(withoutJumps(soot));
  const std::vector<double> start = {2e-9, 5e-9, 40e-9};
  std::vector<double> masses;
  for (const double d : start) masses.push_back(massOf(d));
  e.initialise(masses, 0.05, 1e15);
  const double dt = 6e-9 * rho / (2 * flux);  // by 6 nm
  e.advance(gas.state, 0, dt);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(e.diameters()[i] / (start[i] + 6e-9), 1, 1e-12);
    EXPECT_NEAR(e.masses()[i] / massOf(start[i] + 6e-9), 1, 1e-11);
    EXPECT_NEAR(e.hydrogenMasses()[i] / (0.05 * masses[i]), 1, 1e-11);
  }
}

TEST(EnsembleGrowth, OxidationIsLinearInDiameterKeepsCompositionAndRemovesWhatFallsBelowANucleus) {
  const test::FlameGas gas(1800, 0, 0, 2e-3, 0.1, 0, 0, {0});
  SootModelOptions soot = test::naphthalene();
  const double carbonFlux = 12.011e-3 * SurfaceChemistry(soot, 1800).rates(gas.state, 0.0).oxidationOH * gas.state.OH;
  const double fraction = 0.05, flux = carbonFlux / (1 - fraction);
  Ensemble e(withoutJumps(soot));
  e.initialise(std::vector<double>{massOf(3e-9), massOf(20e-9)}, fraction, 1e15);
  const double dt = 4e-9 * rho / (2 * flux);  // 4 nm are lost: more than the small one has
  e.advance(gas.state, 0, dt);
  ASSERT_EQ(e.size(), 1u);
  EXPECT_EQ(e.counters().oxidised, 1u);
  EXPECT_NEAR(e.diameters()[0] / 16e-9, 1, 1e-12);
  EXPECT_NEAR(e.hydrogenMasses()[0] / e.masses()[0], fraction, 1e-12);
}

// An O2 takes two carbon atoms (two CO), which OH does not: see surface_chemistry.hpp.
TEST(EnsembleGrowth, OxygenTakesTwoCarbonAtoms) {
  const test::FlameGas gas(1800, 1e-3, 0.03, 0, 0.1, 0.02, 0, {0});
  SootModelOptions soot = test::naphthalene();
  soot.alpha = 0.7;
  const double events = SurfaceChemistry(soot, 1800).rates(gas.state, 0.7).oxidationO2 * gas.state.O2;  // mol/m2/s
  const double fraction = 0.05, flux = 2 * 12.011e-3 * events / (1 - fraction);
  Ensemble e(withoutJumps(soot));
  e.initialise(std::vector<double>{massOf(20e-9)}, fraction, 1e15);
  e.advance(gas.state, 0, 4e-9 * rho / (2 * flux));
  ASSERT_EQ(e.size(), 1u);
  EXPECT_NEAR(e.diameters()[0] / 16e-9, 1, 1e-12);
}

TEST(EnsembleGrowth, MonodisperseGrowthAndCondensationFollowTheTwoEquationModel) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-6, 0.03, {2e-5, 3e-6, 2e-6});
  const SootModelOptions soot = test::threePah();
  EnsembleOptions options = withoutJumps(soot);
  options.splitTolerance = 0.01;
  Ensemble e(options);
  const double N = 1e16, mass = massOf(3e-9);
  e.initialise(std::vector<double>(4, mass), 0.05, N);
  SootModelOptions frozen = options.soot;
  frozen.relativeTolerance = 1e-6;
  const TwoEquationSoot model(frozen);
  TwoEquationSoot::Population p{N, 0.95 * mass * N, 0.05 * mass * N};
  const int steps = 200;
  const double dt = 2e-4;
  for (int k = 0; k < steps; ++k) {  // the gas is put back after every step, as for the ensemble
    std::vector<double> pah = gas.pah;
    const auto& s = gas.state;
    SootCellGas cell{s.H, s.H2, s.OH, s.H2O, s.O2, s.C2H2, 0, pah};
    model.advance(gas.state, dt / steps, p, cell);
  }
  e.advance(gas.state, 0, dt);
  ASSERT_GT(p.carbon, 1.3 * 0.95 * mass * N);
  // Splitting error: second order in the splitting step, (1 %)^2, with a margin of ten; gas depletion per step 1e-4.
  EXPECT_NEAR(e.massDensity() / p.mass(), 1, 1e-3);
  EXPECT_NEAR(e.hydrogenDensity() / p.hydrogen, 1, 1e-3);
}

TEST(EnsembleGrowth, InceptionAndCondensationTakeUpAllThePah) {
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {2e-5, 3e-6, 2e-6});
  EnsembleOptions options;
  options.capacity = 2000;
  options.soot = test::threePah();
  options.soot.surfaceGrowth = options.soot.oxidation = false;
  const TwoEquationSoot model(options.soot);
  const auto s = model.sources(gas.state, {});
  const double dt = 5e-4;
  std::vector<double> mass;
  for (std::uint64_t repeat = 0; repeat < 12; ++repeat) {
    options.owner = repeat;
    Ensemble e(options);
    e.advance(gas.state, 0, dt);
    mass.push_back(e.massDensity());
  }
  // The steady dimers hand on what is produced, however they share it: mass is production times time. The splitting
  // (dimers held over a half step) errs by less than the square of its tolerance, 0.25 %.
  const auto sample = test::summarise(mass);
  EXPECT_LT(std::abs(sample.mean - s.nucleation * dt),
            test::zLimit * sample.standardError + 0.0025 * s.nucleation * dt);
}

}  // namespace
}  // namespace lampblack
