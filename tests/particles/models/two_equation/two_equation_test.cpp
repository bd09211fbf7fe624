#include "particles/models/two_equation/two_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
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

TEST(TwoEquationSoot, WithoutSootAndPahNothingHappens) {
  const TwoEquationSoot model(test::threePah());
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {0, 0, 0});
  const auto s = model.sources(gas.state, Population{});
  EXPECT_EQ(s.number, 0);
  EXPECT_EQ(s.carbon, 0);
  for (const double rate : s.gas) EXPECT_EQ(rate, 0);
}

TEST(TwoEquationSoot, NegativeEntriesCountAsZero) {
  const TwoEquationSoot model(test::naphthalene());
  const test::FlameGas none(1700, 1e-3, 0.03, 1e-4, 0.08, 0, 0.03, {1e-5});
  const test::FlameGas less(1700, 1e-3, 0.03, 1e-4, 0.08, -1e-9, 0.03, {1e-5});
  const auto a = model.sources(none.state, Population{}), b = model.sources(less.state, {-5.0, -1e-25, 0});
  EXPECT_GT(a.number, 0);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.gas, b.gas);
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
