#include "particles/models/two_equation/two_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "core/random.hpp"
#include "core/rooms.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

using Population = TwoEquationSoot::Population;
using S = SootSpecies;

constexpr double carbonWeight = 12.011e-3, hydrogenWeight = 1.008e-3;

Population sootOf(double number, double diameter, double hydrogenFraction = 0.03) {
  const double mass = number * 1850 * constants::pi / 6 * std::pow(diameter, 3);
  return {number, mass * (1 - hydrogenFraction), mass * hydrogenFraction};
}

struct Elements {
  double C = 0, H = 0, O = 0;
};

Elements elements(const SootModelOptions& options, std::span<const double> g, const Population& p) {
  Elements e;
  e.C = 2 * g[S::C2H2] + g[S::CO] + p.carbon / carbonWeight;
  e.H = 2 * g[S::C2H2] + g[S::H] + 2 * g[S::H2] + g[S::OH] + 2 * g[S::H2O] + p.hydrogen / hydrogenWeight;
  e.O = g[S::OH] + g[S::H2O] + 2 * g[S::O2] + g[S::CO];
  for (std::size_t i = 0; i < options.pah.size(); ++i) {
    e.C += options.pah[i].carbon * g[S::fixed + i];
    e.H += options.pah[i].hydrogen * g[S::fixed + i];
  }
  return e;
}

// The gas of a cell, with some CO.
std::vector<double> cellOf(const test::FlameGas& gas) {
  std::vector<double> cell = gas.concentrations;
  cell[S::CO] = 0.1;
  return cell;
}

TEST(TwoEquationSoot, SourcesConserveElementsAndPahMassBecomesSootMass) {
  const SootModelOptions options = test::threePah();
  const TwoEquationSoot model(options);
  const test::FlameGas gas(1700, 1e-3, 0.03, 2e-4, 0.08, 1e-3, 0.03, {2e-5, 3e-6, 2e-6});
  const Population soot = sootOf(1e17, 12e-9);
  const auto s = model.sources(gas.state, soot);
  double pahC = 0, pahH = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    pahC += options.pah[i].carbon * s.gas[S::fixed + i];
    pahH += options.pah[i].hydrogen * s.gas[S::fixed + i];
  }
  const double scaleC = 2 * std::abs(s.gas[S::C2H2]) + s.gas[S::CO] + std::abs(pahC);
  EXPECT_NEAR(pahC + 2 * s.gas[S::C2H2] + s.gas[S::CO] + s.carbon / carbonWeight, 0, 4e-16 * scaleC);
  const double scaleH = 2 * std::abs(s.gas[S::C2H2]) + 2 * s.gas[S::H2] + std::abs(s.gas[S::H]) + std::abs(pahH);
  EXPECT_NEAR(pahH + 2 * s.gas[S::C2H2] + s.gas[S::H] + 2 * s.gas[S::H2] + s.gas[S::OH] + s.hydrogen / hydrogenWeight,
              0, 4e-16 * scaleH);
  EXPECT_NEAR(2 * s.gas[S::O2] + s.gas[S::OH] + s.gas[S::CO], 0, 4e-16 * s.gas[S::CO]);
  EXPECT_NEAR((s.nucleation + s.condensation) / -(pahC * carbonWeight + pahH * hydrogenWeight), 1, 4e-16);
  EXPECT_NEAR(s.nucleation + s.condensation + s.growth + s.oxidationO2 + s.oxidationOH, s.carbon + s.hydrogen,
              1e-15 * (s.growth + s.nucleation + s.condensation));
  EXPECT_LT(s.oxidationO2, 0);
  EXPECT_LT(s.oxidationOH, 0);
  EXPECT_GT(s.dimerNumber, 0);
}

TEST(TwoEquationSoot, AdvanceConservesElementsToRoundOffAndStaysPositiveWhateverTheStep) {
  const SootModelOptions options = test::threePah();
  const TwoEquationSoot model(options);
  RandomStream random(11, 0, 0);
  const auto upTo = [&](double top) { return random.uniform() < 0.15 ? 0 : top * std::pow(10, -6 * random.uniform()); };
  for (int k = 0; k < 600; ++k) {
    const double T = 600 + 2200 * random.uniform();
    const test::FlameGas gas(T, upTo(0.02), upTo(0.1), upTo(0.02), upTo(0.2), upTo(0.2), upTo(0.1),
                             {upTo(1e-3), upTo(1e-3), upTo(1e-3)});
    Population soot = random.uniform() < 0.2
                          ? Population{}
                          : sootOf(std::pow(10, 10 + 10 * random.uniform()), std::pow(10, -9.1 + 2 * random.uniform()));
    std::vector<double> cell = cellOf(gas);
    const Elements before = elements(options, cell, soot);
    const double dt = std::pow(10, -8 + 6 * random.uniform());
    const auto report = model.advance(gas.state, dt, soot, cell);
    const Elements after = elements(options, cell, soot);
    // One rounding per event and sub-step.
    const double tolerance = 1e-15 * (4 + report.subSteps);
    ASSERT_NEAR(after.C, before.C, tolerance * before.C);
    ASSERT_NEAR(after.H, before.H, tolerance * before.H);
    ASSERT_NEAR(after.O, before.O, tolerance * before.O);
    cell.insert(cell.end(), {soot.number, soot.carbon, soot.hydrogen});
    for (const double v : cell) {
      ASSERT_GE(v, 0) << k;
      ASSERT_TRUE(std::isfinite(v));
    }
    // No mean particle smaller than four molecules of the lightest PAH.
    ASSERT_LE(soot.number * 40 * carbonWeight, soot.carbon * constants::avogadro * (1 + 1e-12));
  }
}

TEST(TwoEquationSoot, AdvanceOverAShortTimeIsTheSources) {
  const TwoEquationSoot model(test::threePah());
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  const Population start = sootOf(1e17, 8e-9);
  const auto s = model.sources(gas.state, start);
  Population end = start;
  std::vector<double> cell = cellOf(gas);
  const double dt = 1e-9;
  const auto report = model.advance(gas.state, dt, end, cell);
  // The fastest rate here is of order 1e4 /s: relative change of a rate over dt 1e-5, round-off of differences 1e-6.
  EXPECT_NEAR((end.number - start.number) / dt / s.number, 1, 1e-4);
  EXPECT_NEAR((end.carbon - start.carbon) / dt / s.carbon, 1, 1e-4);
  EXPECT_NEAR((end.hydrogen - start.hydrogen) / dt / s.hydrogen, 1, 1e-4);
  EXPECT_NEAR((cell[S::C2H2] - gas[S::C2H2]) / dt / s.gas[S::C2H2], 1, 1e-4);
  EXPECT_NEAR(report.condensed / dt / s.condensation, 1, 1e-4);
}

TEST(TwoEquationSoot, MonodisperseFreeMolecularCoagulationIsExact) {
  SootModelOptions options;
  options.relativeTolerance = 1e-7;
  const TwoEquationSoot model(options);
  test::FlameGas gas(1600, 0, 0, 0, 0, 0, 0, {});
  gas.state.pressure = 1e-6;  // Knudsen number so large that the continuum branch is 1e-9 of the resistance
  const Population start = sootOf(1e18, 3e-9);
  Population soot = start;
  std::vector<double> cell(S::fixed);
  const double t = 1e-3;
  model.advance(gas.state, t, soot, cell);
  const double K = 2.2 * std::sqrt(24 * constants::boltzmann * 1600 / 1850) *
                   std::pow(6 * start.mass() / (constants::pi * 1850), 1.0 / 6);
  const double exact = std::pow(std::pow(start.number, -5.0 / 6) + 5.0 / 6 * K * t, -6.0 / 5);
  EXPECT_LT(exact / start.number, 0.5);
  EXPECT_NEAR(soot.number / exact, 1, 1e-6);
  EXPECT_NEAR(soot.mass() / start.mass(), 1, 1e-15);
}

// Harmonic mean of the free-molecular kernel of equal spheres, 2.2 sqrt(pi k T / m) 4 d^2, and the continuum one,
// 8 k T C / (3 mu), with slip C at the Knudsen number 2 lambda / d (Wang 2025, eqs. 7-31 to 7-33, 9-28 to 9-30).
TEST(TwoEquationSoot, CoagulationOfEqualSpheresHasTheKernelOfItsSize) {
  const TwoEquationSoot model((SootModelOptions()));
  test::FlameGas gas(1600, 0, 0, 0, 0, 0, 0, {});
  for (const double pressure : {1e5, 5e6}) {
    gas.state.pressure = pressure;
    for (const double d : {2e-9, 40e-9, 500e-9, 5e-6}) {
      const Population soot = sootOf(1e14, d);
      const double kT = constants::boltzmann * 1600, m = soot.mass() / soot.number;
      const double path =
          gas.state.viscosity / pressure *
          std::sqrt(constants::pi * constants::gasConstant * 1600 / (2 * gas.state.meanMolecularWeight));
      const double knudsen = 2 * path / d, slip = 1 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
      const double free = 2.2 * std::sqrt(constants::pi * kT / m) * 4 * d * d;
      const double continuum = 8 * kT * slip / (3 * gas.state.viscosity);
      const double kernel = 1 / (1 / free + 1 / continuum);
      EXPECT_NEAR(model.sources(gas.state, soot).coagulationNumber / (-0.5 * kernel * 1e28), 1, 1e-12) << d;
      EXPECT_NEAR(model.diffusivity(gas.state, soot) / (kT * slip / (3 * constants::pi * gas.state.viscosity * d)), 1,
                  1e-12)
          << d;
    }
  }
}

TEST(TwoEquationSoot, ErrorOfAStepStaysWithinItsSubStepsTimesTheTolerance) {
  SootModelOptions options = test::threePah();
  const TwoEquationSoot model(options);
  options.relativeTolerance = 1e-8;
  const TwoEquationSoot reference(options);
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  for (const double dt : {1e-5, 1e-4, 1e-3}) {
    Population soot = sootOf(1e17, 8e-9), exact = soot;
    std::vector<double> cell = cellOf(gas), exactCell = cell;
    const auto report = model.advance(gas.state, dt, soot, cell);
    reference.advance(gas.state, dt, exact, exactCell);
    const double bound = report.subSteps * model.options().relativeTolerance;
    EXPECT_NEAR(soot.number / exact.number, 1, bound);
    EXPECT_NEAR(soot.carbon / exact.carbon, 1, bound);
    EXPECT_NEAR(cell[S::C2H2] / exactCell[S::C2H2], 1, bound);
    EXPECT_NEAR(cell[S::fixed] / exactCell[S::fixed], 1, bound);
  }
}

TEST(TwoEquationSoot, NaphthaleneAloneDecaysByItsSecondOrderLaw) {
  SootModelOptions options = test::naphthalene();
  options.relativeTolerance = 1e-7;
  options.surfaceGrowth = options.oxidation = false;
  const TwoEquationSoot model(options);
  const test::FlameGas gas(1500, 0, 0, 0, 0, 0, 0, {1e-4});
  PahArray loss{};
  model.dimers().lossRates(1500, gas.pah(), loss);
  std::vector<double> cell = cellOf(gas);
  Population soot;
  const double dt = 0.05;
  const auto report = model.advance(gas.state, dt, soot, cell);
  const double exact = gas.pah()[0] / (1 + loss[0] * dt);
  ASSERT_GT(loss[0] * dt, 0.1);
  EXPECT_NEAR(cell[S::fixed] / exact, 1, 1e-6);
  const double taken = (gas.pah()[0] - cell[S::fixed]) * (10 * carbonWeight + 8 * hydrogenWeight);
  EXPECT_NEAR(soot.mass() / taken, 1, 1e-12);
  EXPECT_NEAR((report.nucleated + report.condensed) / taken, 1, 1e-12);
}

TEST(TwoEquationSoot, SootThatBurnsAwayTakesItsNumberWithIt) {
  const TwoEquationSoot model(test::naphthalene());
  const test::FlameGas gas(1900, 1e-3, 1e-3, 5e-3, 0.1, 0.05, 0, {0});
  Population soot = sootOf(1e15, 5e-9);
  const Population start = soot;
  std::vector<double> cell = cellOf(gas);
  TwoEquationSoot::Report total;
  for (int k = 0; k < 200; ++k) {
    const auto report = model.advance(gas.state, 1e-4, soot, cell);
    total.numberOxidised += report.numberOxidised;
    total.numberCoagulated += report.numberCoagulated;
  }
  EXPECT_LT(soot.carbon, 1e-9 * start.carbon);
  EXPECT_LT(soot.number, 1e-6 * start.number);
  EXPECT_NEAR((soot.number + total.numberOxidised + total.numberCoagulated) / start.number, 1, 1e-12);
}

TEST(TwoEquationSoot, NothingToDoIsFreeAndExact) {
  const TwoEquationSoot model(test::threePah());
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {0, 0, 0});
  std::vector<double> cell = cellOf(gas);
  Population soot;
  EXPECT_EQ(model.advance(gas.state, 1e-4, soot, cell).subSteps, 0);
  EXPECT_EQ(soot.number, 0);
  EXPECT_EQ(cell[S::C2H2], gas[S::C2H2]);
  const auto s = model.sources(gas.state, soot);
  EXPECT_EQ(s.number, 0);
  EXPECT_EQ(s.gas[S::H2], 0);
}

TEST(TwoEquationSoot, NegativeEntriesOfTransportCountAsZeroAndKeepTheirDeficit) {
  const TwoEquationSoot model(test::naphthalene());
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 0, 0.03, {1e-5});
  std::vector<double> cell = cellOf(gas);
  cell[S::O2] = -1e-9;
  Population soot{-5.0, -1e-25, 0};
  model.advance(gas.state, 1e-5, soot, cell);
  EXPECT_EQ(cell[S::O2], -1e-9);
  EXPECT_GT(soot.number, 0);
}

TEST(TwoEquationSoot, TransportPropertiesHaveTheirLimits) {
  EXPECT_NEAR(waldmannThermophoresis(), 0.5385, 1e-4);  // Waldmann's 0.54
  const TwoEquationSoot model(test::naphthalene());
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {0});
  const Population soot = sootOf(1e15, 20e-9);
  EXPECT_NEAR(model.meanDiameter(soot), 20e-9, 1e-20);
  EXPECT_NEAR(model.surfaceArea(soot) / (constants::pi * 4e-16 * 1e15), 1, 1e-12);
  EXPECT_NEAR(model.volumeFraction(soot) / (constants::pi / 6 * 8e-24 * 1e15), 1, 1e-12);
  // Free-molecular limit of Stokes-Einstein-Cunningham: D d^2 is constant.
  const double ratio =
      model.diffusivity(gas.state, sootOf(1e15, 1e-9)) / model.diffusivity(gas.state, sootOf(1e15, 2e-9));
  EXPECT_NEAR(ratio, 4, 0.02);
  EXPECT_TRUE(std::isfinite(model.diffusivity(gas.state, Population{})));
  ParticleGas broken = gas.state;
  broken.temperature = std::nan("");
  EXPECT_THROW((void)model.sources(broken, soot), NumericsError);
}

}  // namespace
}  // namespace lampblack::particles
