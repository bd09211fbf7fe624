// Growth and sums of many particles in flat arrays against the same one by one.
#include "particles/soot/soot_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

// 301 particles, no whole number of blocks: nuclei to 60 nm, of differing hydrogen, primaries and weight.
SootColumns manyParticles(const SootAggregate& type) {
  SootColumns all;
  const std::size_t n = 301;
  all.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double d = 0.8e-9 * std::pow(75.0, static_cast<double>(k) / (n - 1));
    const double mass = 1850 * constants::pi / 6 * d * d * d, hydrogen = 0.01 * static_cast<double>(k % 7);
    all.set(k, type.make((1 - hydrogen) * mass, hydrogen * mass, 1 + static_cast<double>(k % 5)),
            1e12 * (1 + static_cast<double>(k % 3)));
  }
  return all;
}

void expectNear(double value, double expected, double scale) {
  EXPECT_NEAR(value, expected, 1e-12 * scale);
}

void compare(bool coalescing, const test::FlameGas& gas, double dt, bool someLost, bool someStay) {
  const SootModelOptions options = test::naphthalene();
  const DimerModel dimers(options);
  const SootMedium medium(options, dimers, gas.state, true);
  const SootAggregate type(options.sootDensity, coalescing);
  SootFluxes fluxes = medium.fluxes();
  fluxes.alpha = 0.6;
  fluxes.condensation = medium.condensation(1e15);
  SootColumns all = manyParticles(type);
  const SootColumns before = all;
  const SootTransfer moved = growAll(all, type, medium, fluxes, dt);
  SootTransfer expected;
  SootSums sums;
  double carbon = 0, hydrogen = 0;  // what the particles gained
  bool lost = false, stayed = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    SootAggregate::Particle p = before.particle(k);
    const double w = before.weight[k], mass = SootAggregate::mass(p);
    SootTransfer one;
    const bool left = medium.grow(type, fluxes, dt, p, one);
    expected.add(w, one);
    carbon += w * (all.carbon[k] - before.carbon[k]);
    hydrogen += w * (all.hydrogen[k] - before.hydrogen[k]);
    lost |= !left;
    stayed |= left;
    ASSERT_EQ(all.carbon[k] > 0, left) << k;
    EXPECT_EQ(all.weight[k], w);
    EXPECT_EQ(all.primaries[k], before.primaries[k]);
    if (!left) {
      EXPECT_EQ(all.carbon[k] + all.hydrogen[k], 0);
      continue;
    }
    expectNear(all.carbon[k], p.carbon, mass);
    expectNear(all.hydrogen[k], p.hydrogen, mass);
    expectNear(all.diameter[k], p.diameter, p.diameter);
  }
  EXPECT_EQ(lost, someLost);
  EXPECT_EQ(stayed, someStay);
  for (const auto part :
       {&SootTransfer::dimers, &SootTransfer::growth, &SootTransfer::oxidationO2, &SootTransfer::oxidationOH,
        &SootTransfer::hydrogenO2, &SootTransfer::hydrogenOH, &SootTransfer::lost})
    expectNear(moved.*part, expected.*part, expected.*part);
  // Atoms: what the particles gained is what was moved.
  const double gross = moved.growth + moved.oxidationO2 + moved.oxidationOH + moved.dimers * medium.dimerCarbon();
  expectNear(carbon, moved.dimers * medium.dimerCarbon() + moved.growth - moved.oxidationO2 - moved.oxidationOH, gross);
  expectNear(hydrogen, moved.dimers * medium.dimerHydrogen() - moved.hydrogenO2 - moved.hydrogenOH, gross);

  for (std::size_t k = 0; k < before.size(); ++k) {
    const SootAggregate::Particle p = before.particle(k);
    const double w = before.weight[k], rate = medium.collision(p);
    sums.number += w;
    sums.carbon += w * p.carbon;
    sums.hydrogen += w * p.hydrogen;
    sums.primaries += w * p.primaries;
    sums.area += w * type.surface(p);
    sums.diameters += w * p.diameter;
    sums.collisions += w * rate;
    sums.slopes += w * medium.collisionSlope(p, rate);
  }
  const SootSums found = sumsOf(before, type, medium);
  for (const auto sum : {&SootSums::number, &SootSums::carbon, &SootSums::hydrogen, &SootSums::primaries,
                         &SootSums::area, &SootSums::diameters, &SootSums::collisions, &SootSums::slopes})
    expectNear(found.*sum, sums.*sum, sums.*sum);
}

// H, H2, OH, H2O, O2, C2H2, A2.
const test::FlameGas& growing() {
  static const test::FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-6, 0.03, {2e-5});
  return gas;
}
const test::FlameGas& burning() {
  static const test::FlameGas gas(2200, 3e-3, 0.01, 5e-3, 0.1, 0.02, 1e-5, {1e-8});
  return gas;
}

TEST(SootColumns, GrowAsOneByOne) {
  for (const bool coalescing : {true, false}) compare(coalescing, growing(), 1e-5, false, true);
}

// Long enough for steps of a particle to be cut where it is small.
TEST(SootColumns, GrowAsOneByOneInSeveralSteps) {
  for (const bool coalescing : {true, false}) compare(coalescing, growing(), 5e-3, false, true);
}

TEST(SootColumns, BurnAsOneByOne) {
  for (const bool coalescing : {true, false}) {
    compare(coalescing, burning(), 2e-6, true, true);
    compare(coalescing, burning(), 1e-4, true, true);
  }
}

}  // namespace
}  // namespace lampblack::particles
