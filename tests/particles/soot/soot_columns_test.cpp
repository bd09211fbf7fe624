// Growth and sums of many particles in flat arrays against the same one by one.
#include "particles/soot/soot_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/modules.hpp"
#include "particles/population/model/surface_volume.hpp"
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

constexpr SootShape shapes[] = {SootShape::spheres, SootShape::aggregates, SootShape::surfaceVolume};

void expectNear(double value, double expected, double scale) {
  EXPECT_NEAR(value, expected, 1e-12 * scale);
}

void compare(SootShape shape, const test::FlameGas& gas, double dt, bool someLost, bool someStay) {
  const SootModelOptions options = test::naphthalene();
  const DimerModel dimers(options);
  const SootMedium medium(options, dimers, gas.state, true);
  const SootAggregate type(options.sootDensity, shape);
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
    if (shape != SootShape::surfaceVolume) {
      EXPECT_EQ(all.primaries[k], before.primaries[k]);
    }
    if (!left) {
      EXPECT_EQ(all.carbon[k] + all.hydrogen[k], 0);
      continue;
    }
    const double most = std::max(mass, SootAggregate::mass(p));  // some grow to thousands of times what they were
    expectNear(all.carbon[k], p.carbon, most);
    expectNear(all.hydrogen[k], p.hydrogen, most);
    expectNear(all.primaries[k], p.primaries, p.primaries);
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
    sums.slopes += w * medium.collisionSlope(p, rate, type.shapeGain(p.primaries));
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
  for (const SootShape shape : shapes) compare(shape, growing(), 1e-5, false, true);
}

// Long enough for steps of a particle to be cut where it is small.
TEST(SootColumns, GrowAsOneByOneInSeveralSteps) {
  for (const SootShape shape : shapes) compare(shape, growing(), 5e-3, false, true);
}

TEST(SootColumns, BurnAsOneByOne) {
  for (const SootShape shape : shapes) {
    compare(shape, burning(), 2e-6, true, true);
    compare(shape, burning(), 1e-4, true, true);
  }
}

// The law of the population balance's particles by volume and surface, and the two diameters of collision.
TEST(SootAggregate, ByVolumeAndSurfaceIsTheTypeOfThePopulationBalance) {
  constexpr double rho = 1850;
  const SurfaceVolume there(rho, 1.8);
  const SootAggregate fractal(rho, SootShape::surfaceVolume, 1.8), mean(rho, SootShape::surfaceVolume);
  const auto at = [&](const SootAggregate& type, const SurfaceVolume::Particle& p) {
    return type.make(rho * p.volume, 0, there.primaries(p));
  };
  const auto expectSame = [&](const SootAggregate::Particle& here, const SurfaceVolume::Particle& p) {
    EXPECT_NEAR(fractal.surface(here) / p.surface, 1, 1e-13);
    EXPECT_NEAR(fractal.collisionDiameter(here) / there.collisionDiameter(p), 1, 1e-13);
  };
  const SurfaceVolume::Particle small = there.make(3e-26), large{8e-24, 4.7 * there.make(8e-24).surface};
  for (const auto& [p, q] : {std::pair{small, small}, {small, large}, {large, large}}) {
    expectSame(fractal.coagulated(at(fractal, p), at(fractal, q)), there.coagulated(p, q));
    SurfaceVolume::Particle seven = p;
    for (int k = 0; k < 7; ++k) seven = there.coagulated(seven, q);
    expectSame(fractal.coagulated(at(fractal, p), at(fractal, q), 7), seven);
    expectSame(fractal.mean(at(fractal, q), 3, at(fractal, q), 1), q);
  }
  const SurfaceVolume::Particle both = there.mean(large, 3, there.make(7e-24), 1);
  expectSame(fractal.mean(at(fractal, large), 3, at(fractal, there.make(7e-24)), 1), both);
  EXPECT_EQ(fractal.mean(at(fractal, small), 1, at(fractal, there.make(9e-24)), 1).primaries, 1);
  const double sphere = std::cbrt(6 / constants::pi * large.volume), surface = std::sqrt(large.surface / constants::pi);
  EXPECT_NEAR(at(mean, large).diameter / (0.5 * (sphere + surface)), 1, 1e-13);
  // A gain and a loss at the same time, against small steps of either law: of second order.
  for (const double part : {0.1, 0.05}) {
    const double gain = part, loss = 0.8 * part;
    double V = 1, S = 2.5;  // n = S^3/V^2, in spheres of 1
    for (int k = 0; k < 4000; ++k) {
      const double dS = gain / 4000 * (2.0 / 3) / std::sqrt(S) - loss / 4000 * (2.0 / 3) * S / V;
      V += (gain - loss) / 4000;
      S += dS;
    }
    EXPECT_NEAR(primariesAfter(2.5 * 2.5 * 2.5, 1, gain, loss) / (S * S * S / (V * V)), 1, 0.15 * part * part);
  }
  // A gain of volume: d ln d_c / d ln V, three times, with S going as it grows.
  for (const SootAggregate& type : {fractal, mean}) {
    const SootAggregate::Particle p = at(type, large);
    const double mass = SootAggregate::mass(p), gain = 1e-6 * mass;
    const auto more = type.make(mass + gain, 0, primariesAfter(p.primaries, mass, gain, 0));
    EXPECT_NEAR(3 * std::log(more.diameter / p.diameter) / std::log1p(1e-6), type.shapeGain(p.primaries), 1e-5);
  }
}

}  // namespace
}  // namespace lampblack::particles
