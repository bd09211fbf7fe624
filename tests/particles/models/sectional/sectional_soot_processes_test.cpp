// Each process of the sectional soot model alone, at one state.
#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/soot/surface_chemistry.hpp"
#include "tests/particles/models/sectional/sectional_soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

using namespace test;
using Aggregation = SectionalSootOptions::Aggregation;

void turnOff(SootModelOptions& soot) {
  soot.inception = soot.condensation = soot.surfaceGrowth = soot.oxidation = soot.coagulation = false;
}

TEST(SectionalSoot, CoagulationKeepsCarbonAndPrimaries) {
  for (const double factor : {2.0, 1.4, 1.2}) {
    SectionalSootOptions options = pyrene();
    options.factor = factor;
    turnOff(options.soot);
    options.soot.coagulation = true;
    const SectionalSoot model(options);
    const SectionGas gas(1600, sooting({1e-6}));
    const auto y = randomState(model, 3);
    const auto f = sourcesOf(model, gas.gas, y);
    const std::size_t n = model.sections();
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) size += std::abs(model.pivots()[i] * f.scalars[i]);
    EXPECT_NEAR(carbonOf(model, f.scalars), 0, 1e-14 * size);
    const std::span<const double> primaries(f.scalars.data() + n, n);
    double primarySize = 0;
    for (const double p : primaries) primarySize += std::abs(p);
    EXPECT_NEAR(sum(primaries), 0, 1e-14 * primarySize);
    EXPECT_LT(sum({f.scalars.data(), n}), 0);
  }
}

// Every collision of two takes one away: the number falls by half the sum of all kernels, whatever the pivots, as long
// as no sum lies beyond the last one.
TEST(SectionalSoot, CoagulationTakesOneParticleACollision) {
  SectionalSootOptions options = pyrene();
  options.aggregation = Aggregation::spheres;
  options.factor = 1.7;
  turnOff(options.soot);
  options.soot.coagulation = true;
  const SectionalSoot model(options);
  const SectionGas gas(1600, sooting({1e-6}));
  auto y = randomState(model, 3);
  for (std::size_t i = 25; i < y.size(); ++i) y[i] = 0;
  const double lambda = meanFreePath(gas.gas);
  const auto diameter = [&](std::size_t i) { return std::cbrt(6 * model.pivots()[i] / (constants::pi * 1800)); };
  double collisions = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = 0; j < y.size(); ++j) {
      const double di = diameter(i), dj = diameter(j);
      const double fm =
          freeMolecularKernel(freeMolecularPrefactor(1600, 2.2), model.pivots()[i], di, model.pivots()[j], dj);
      const double co = continuumPrefactor(1600, gas.gas.viscosity) * (di + dj) *
                        (slipCorrection(2 * lambda / di) / di + slipCorrection(2 * lambda / dj) / dj);
      collisions += 0.5 * harmonicMean(fm, co) * y[i] * y[j];
    }
  }
  EXPECT_NEAR(sum(sourcesOf(model, gas.gas, y).scalars), -collisions, 1e-12 * collisions);
}

TEST(SectionalSoot, GrowthAddsTheCarbonOfTheSurfaceAndNoNumber) {
  SectionalSootOptions options = pyrene();
  turnOff(options.soot);
  options.soot.surfaceGrowth = true;
  options.soot.alpha = 0.3;
  const SectionalSoot model(options);
  const SectionGas gas(1700, sooting({0}));
  auto y = randomState(model, 5);
  const std::size_t n = model.sections();
  y[n - 1] = y[2 * n - 1] = 0;
  const auto f = sourcesOf(model, gas.gas, y);
  const auto properties = model.properties(gas.gas, y);
  const SurfaceChemistry chemistry(options.soot, 1700);
  const auto& c = gas.concentrations;
  const double expected =
      2 * options.soot.carbonWeight * chemistry.rates(c, 0.3).growth * c[SootSpecies::C2H2] * properties.surfaceArea;
  EXPECT_NEAR(carbonOf(model, f.scalars), expected, 1e-12 * expected);
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) size += std::abs(f.scalars[i]);
  EXPECT_NEAR(sum({f.scalars.data(), n}), 0, 1e-14 * size);
}

TEST(SectionalSoot, OxidationTakesNumberOnlyFromTheFirstSection) {
  SectionalSootOptions options = pyrene();
  turnOff(options.soot);
  options.soot.oxidation = true;
  const SectionalSoot model(options);
  const SectionGas gas(1800, {1e-3, 0.02, 3e-3, 0.1, 0.02, 1e-5, 0.1, 0});
  auto y = randomState(model, 5);
  const std::size_t n = model.sections();
  auto f = sourcesOf(model, gas.gas, y);
  const auto processes = model.processes(gas.gas, y);
  EXPECT_NEAR(sum({f.scalars.data(), n}), processes.oxidationNumber, 1e-10 * y[0]);
  EXPECT_LT(processes.oxidationNumber, 0);
  EXPECT_NEAR(carbonOf(model, f.scalars), processes.oxidationO2 + processes.oxidationOH,
              1e-12 * std::abs(processes.oxidationOH));
  y[0] = y[n] = 0;
  f = sourcesOf(model, gas.gas, y);
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) size += std::abs(f.scalars[i]);
  EXPECT_NEAR(sum({f.scalars.data(), n}), 0, 1e-14 * size);
}

// Wang (2025), eq. 9-23 by hand.
TEST(SectionalSoot, PyreneNucleatesAtThePublishedRate) {
  SectionalSootOptions options = pyrene();
  turnOff(options.soot);
  options.soot.inception = true;
  const SectionalSoot model(options);
  const SectionGas gas(1600, sooting({2e-6}));
  const std::vector<double> y(model.scalars().size(), 0);
  const auto f = sourcesOf(model, gas.gas, y);
  const double m = (16 * 12.011e-3 + 10 * 1.008e-3) / constants::avogadro;
  const double N = gas.concentrations[7] * constants::avogadro;
  const double expected = 0.002 * 2.2 * std::sqrt(4 * constants::pi * constants::boltzmann * 1600 / m) *
                          std::pow(6 * m / (constants::pi * 1800), 2.0 / 3) * N * N;
  EXPECT_NEAR(f.scalars[0], expected, 1e-12 * expected);
  EXPECT_NEAR(f.scalars[model.sections()], expected, 1e-12 * expected);
  EXPECT_NEAR(f.exchange[7], -2 * expected / constants::avogadro, 1e-12 * expected / constants::avogadro);
  EXPECT_NEAR(f.exchange[1], 10 * expected / constants::avogadro, 1e-11 * expected / constants::avogadro);
}

TEST(SectionalSoot, BreakUpKeepsCarbonAndPrimariesAndMakesOneOfOne) {
  for (const double factor : {2.0, 1.3}) {
    SectionalSootOptions options = pyrene();
    options.factor = factor;
    options.sections = factor < 2 ? 90 : 35;
    turnOff(options.soot);
    options.soot.oxidation = true;
    const SectionGas gas(1800, {1e-3, 0.02, 3e-3, 0.1, 0.02, 1e-5, 0.1, 0});
    const SectionalSoot without(options);
    options.fragmentation.active = true;
    const SectionalSoot model(options);
    const auto y = randomState(model, 5);
    auto f = sourcesOf(model, gas.gas, y);
    const auto oxidised = sourcesOf(without, gas.gas, y);
    double size = 0, carbonSize = 0, primarySize = 0;
    const std::size_t n = model.sections();
    for (std::size_t i = 0; i < 2 * n; ++i) f.scalars[i] -= oxidised.scalars[i];
    for (std::size_t i = 0; i < n; ++i) {
      size += std::abs(f.scalars[i]);
      carbonSize += model.pivots()[i] * std::abs(f.scalars[i]);
      primarySize += std::abs(f.scalars[n + i]);
    }
    const auto processes = model.processes(gas.gas, y);
    EXPECT_GT(processes.fragmentationNumber, 0);
    EXPECT_NEAR(sum({f.scalars.data(), n}), processes.fragmentationNumber, 1e-12 * size);
    EXPECT_NEAR(carbonOf(model, f.scalars), 0, 1e-11 * carbonSize);
    EXPECT_NEAR(sum({f.scalars.data() + n, n}), 0, 1e-11 * primarySize);
  }
}

TEST(SectionalSoot, ProcessesAreThoseOfTheSources) {
  const SectionalSoot model(twoPahWithEverything());
  const SectionGas gas(1650, sooting({3e-6, 1e-6}));
  const auto y = randomState(model, 11);
  const auto f = sourcesOf(model, gas.gas, y);
  const auto p = model.processes(gas.gas, y);
  const std::size_t n = model.sections();
  const double number = p.nucleationNumber + p.coagulationNumber + p.oxidationNumber + p.fragmentationNumber;
  EXPECT_NEAR(sum({f.scalars.data(), n}), number, 1e-12 * std::abs(p.coagulationNumber));
  const double mass = p.nucleation + p.condensation + p.growth + p.oxidationO2 + p.oxidationOH + p.carbonisation;
  EXPECT_NEAR(carbonOf(model, f.scalars) + f.scalars.back(), mass, 1e-12 * p.growth);
}

// A first-order loss: the hydrogen of the soot, and nothing else, feeds H2.
TEST(SectionalSoot, CarbonisationReleasesHydrogenAtFirstOrder) {
  SectionalSootOptions options = pyrene();
  turnOff(options.soot);
  options.carbonisation = true;
  const SectionalSoot model(options);
  const SectionGas gas(1600, sooting({1e-6}));
  auto y = randomState(model, 2);
  const auto f = sourcesOf(model, gas.gas, y);
  const double k = options.carbonisationRate * std::exp(-options.carbonisationEnergy / (constants::gasConstant * 1600));
  EXPECT_NEAR(f.scalars.back(), -k * y.back(), 1e-12 * k * y.back());
  EXPECT_NEAR(f.exchange[1], k * y.back() / (2 * options.soot.hydrogenWeight), 1e-9 * f.exchange[1]);
}

}  // namespace
}  // namespace lampblack::particles
