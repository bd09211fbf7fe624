// Growth in whole events of many particles in flat arrays.
#include "particles/soot/soot_events.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../statistics.hpp"
#include "core/modules.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t many = 700;  // no whole number of blocks

struct Scene {
  explicit Scene(SootShape shape)
      : options(test::naphthalene()),
        gas(1700, 1e-3, 0.05, 1e-4, 0.1, 1e-2, 0.03, {1e-5}),
        dimers(options),
        medium(options, dimers, gas.state, true),
        type(options.sootDensity, shape),
        fluxes(medium.fluxes()) {
    fluxes.alpha = 0.6;
    fluxes.growth *= 0.05;  // so that some nuclei burn
    fluxes.condensation = medium.condensation(1e16);
  }
  // From nuclei to some that have many events at once.
  [[nodiscard]] SootColumns particles() const {
    SootColumns all;
    all.resize(many);
    for (std::size_t k = 0; k < many; ++k) {
      const double carbon =
          dimers.smallestNucleus() * medium.carbonAtom() * std::pow(10, 0.004 * static_cast<double>(k));
      all.set(k, type.make(carbon, 0.01 * carbon, 1 + static_cast<double>(k % 3)),
              1e12 * (1 + static_cast<double>(k % 2)));
    }
    return all;
  }
  SootModelOptions options;
  test::FlameGas gas;
  DimerModel dimers;
  SootMedium medium;
  SootAggregate type;
  SootFluxes fluxes;
};

SootColumns part(const SootColumns& all, std::size_t first, std::size_t count) {
  SootColumns some;
  some.resize(count);
  for (std::size_t k = 0; k < count; ++k) some.set(k, all.particle(first + k), all.weight[first + k]);
  return some;
}

// What is told as changed has changed, nothing else has, and what went in and out is the difference.
TEST(SootEvents, TellWhatTheyChanged) {
  for (const SootShape shape : {SootShape::spheres, SootShape::aggregates, SootShape::surfaceVolume}) {
    const Scene scene(shape);
    const SootColumns before = scene.particles();
    SootColumns after = before;
    RandomStream random(1, 0, 7);
    GrowthByEvents growth(scene.type, scene.medium, scene.fluxes, 3e-6, random);
    std::vector<std::uint32_t> changed;
    growth.grow(after, changed);
    std::vector<bool> has(many, false);
    for (const auto k : changed) has[k] = true;
    EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
    double carbon = 0, hydrogen = 0, lost = 0;
    for (std::size_t k = 0; k < many; ++k) {
      EXPECT_EQ(has[k], after.carbon[k] != before.carbon[k] || after.hydrogen[k] != before.hydrogen[k]) << k;
      carbon += before.weight[k] * (after.carbon[k] - before.carbon[k]);
      hydrogen += before.weight[k] * (after.hydrogen[k] - before.hydrogen[k]);
      if (after.carbon[k] == 0) {
        lost += before.weight[k];
        EXPECT_EQ(after.hydrogen[k], 0);
        continue;
      }
      EXPECT_GE(after.carbon[k], scene.dimers.smallestNucleus() * scene.medium.carbonAtom() * (1 - 1e-8));
      const double d = scene.type.make(after.carbon[k], after.hydrogen[k], after.primaries[k]).diameter;
      EXPECT_NEAR(after.diameter[k], d, 1e-13 * d);
      if (shape != SootShape::surfaceVolume) {
        EXPECT_EQ(after.primaries[k], before.primaries[k]);
      }
    }
    const SootTransfer& moved = growth.moved();
    const double scale = 1e-12 * moved.growth;
    EXPECT_NEAR(carbon,
                moved.dimers * scene.medium.dimerCarbon() + moved.growth - moved.oxidationO2 - moved.oxidationOH,
                scale);
    EXPECT_NEAR(hydrogen, moved.dimers * scene.medium.dimerHydrogen() - moved.hydrogenO2 - moved.hydrogenOH, scale);
    EXPECT_EQ(moved.lost, lost);
    EXPECT_GT(changed.size(), many / 4);
    EXPECT_LT(changed.size(), many);
    EXPECT_GT(lost, 0);
  }
}

// By volume and surface what a particle takes up makes it rounder, and what it loses leaves its primaries.
TEST(SootEvents, ByVolumeAndSurfaceRoundWhatGrows) {
  for (const bool burns : {false, true}) {
    Scene scene(SootShape::surfaceVolume);
    if (burns)
      scene.fluxes.growth = scene.fluxes.condensation = 0;
    else
      scene.fluxes.O2 = scene.fluxes.OH = 0;
    const SootColumns before = scene.particles();
    SootColumns after = before;
    RandomStream random(1, 0, 7);
    (void)growAllByEvents(after, scene.type, scene.medium, scene.fluxes, 3e-6, random);
    double changed = 0;
    for (std::size_t k = 0; k < many; ++k) {
      if (after.carbon[k] == 0) continue;
      const double mass = before.carbon[k] + before.hydrogen[k];
      const double gain = after.carbon[k] + after.hydrogen[k] - mass, n = before.primaries[k];
      const double expected = burns ? n : std::pow((std::sqrt(n) * mass + gain) / (mass + gain), 2);
      EXPECT_NEAR(after.primaries[k], expected, 1e-12 * n);
      changed += std::abs(gain) / mass;
    }
    EXPECT_GT(changed, 0.5);
  }
}

// The line of events goes on from some particles to those that come next.
TEST(SootEvents, OfSomeAfterTheOtherAreThoseOfAll) {
  const Scene scene(SootShape::spheres);
  SootColumns all = scene.particles();
  SootColumns first = part(all, 0, 256), second = part(all, 256, many - 256);
  RandomStream one(1, 0, 7), two(1, 0, 7);
  const SootTransfer whole = growAllByEvents(all, scene.type, scene.medium, scene.fluxes, 3e-6, one);
  GrowthByEvents growth(scene.type, scene.medium, scene.fluxes, 3e-6, two);
  std::vector<std::uint32_t> changed;
  growth.grow(first, changed);
  growth.grow(second, changed);
  for (std::size_t k = 0; k < many; ++k)
    EXPECT_EQ(all.carbon[k], k < 256 ? first.carbon[k] : second.carbon[k - 256]) << k;
  EXPECT_EQ(whole.lost, growth.moved().lost);
  EXPECT_NEAR(whole.growth, growth.moved().growth, 1e-13 * whole.growth);
  EXPECT_EQ(one.position(), two.position());
}

// A nucleus that is due one event of growth and one of oxidation is gone where oxidation comes first: with means a of
// growth and b of oxidation that is b/(a + b) (1 - exp(-a - b)), and where growth comes first, those that follow may
// still end it. Here with growth that lifts it out of reach: by a dimer.
TEST(SootEvents, ComeInAnyOrder) {
  Scene scene(SootShape::spheres);
  scene.fluxes.alpha = 0;
  const double nucleus = scene.dimers.smallestNucleus() * scene.medium.carbonAtom();
  SootColumns all;
  all.resize(20000);
  for (std::size_t k = 0; k < all.size(); ++k) all.set(k, scene.type.make(nucleus, 0, 1), 1);
  const auto expect = [&](double dt) {
    return expectedEvents(scene.medium.growth(scene.fluxes), nucleus, 0, 1, 1, all.diameter[0], dt,
                          1 / scene.medium.carbonAtom());
  };
  scene.fluxes.condensation *= expect(1e-9)[oxidationByOHEvent] / expect(1e-9)[dimerEvent];
  const double dt = 0.5e-9 / expect(1e-9)[oxidationByOHEvent];
  const double a = expect(dt)[dimerEvent], b = expect(dt)[oxidationByOHEvent];
  ASSERT_NEAR(a, b, 0.1 * b);
  RandomStream random(5, 0, 7);
  const double n = static_cast<double>(all.size());
  const double gone = growAllByEvents(all, scene.type, scene.medium, scene.fluxes, dt, random).lost / n;
  const double share = b / (a + b) * (1 - std::exp(-a - b));
  EXPECT_NEAR(gone, share, test::zLimit * std::sqrt(share * (1 - share) / n));
}

}  // namespace
}  // namespace lampblack::particles
