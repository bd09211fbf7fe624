#include "particles/spheres/sphere_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"

namespace lampblack::particles {
namespace {

TEST(SphereGrowth, ASphereByItself) {
  SphereAggregate one(1);
  growEverywhere(one, 0.37);
  EXPECT_NEAR(one.spheres()[0].radius, 1.37, 1e-13);
  EXPECT_NEAR(one.volume(), volumeOfRadius(1.37), 1e-12);
  EXPECT_EQ(growSphere(one, 0, volumeOfRadius(1.5) - volumeOfRadius(1.37)), 0);
  EXPECT_NEAR(one.spheres()[0].radius, 1.5, 1e-13);
}

// The volume gained is the integral of the free surface over the radius.
TEST(SphereGrowth, TwoTouchingSpheresGainTheirSurface) {
  SphereAggregate two = test::pairOfSpheres(1, 0.8, 0);
  const double apart = two.distance(1), before = two.volume();
  double gained = 0;
  constexpr int steps = 16;  // Gauss's rule of three points in each
  const double h = 0.2 / steps;
  for (int k = 0; k < steps; ++k) {
    double at = 0;
    for (const auto& [place, weight] :
         {std::pair{0.5 - std::sqrt(0.15), 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + std::sqrt(0.15), 5.0 / 18}}) {
      growEverywhere(two, (place - at) * h);
      at = place;
      gained += h * weight * two.surface();
    }
    growEverywhere(two, (1 - at) * h);
  }
  EXPECT_EQ(two.count(), 2);
  EXPECT_NEAR(two.spheres()[0].radius, 1.2, 1e-13);
  EXPECT_NEAR(two.volume() - before, gained, 1e-10);
  EXPECT_NEAR(two.distance(1), apart, 1e-13);  // at rest
  EXPECT_NEAR(two.volume(), volumeOfRadius(1.2) + volumeOfRadius(1.0) - lensVolume(1.2, 1.0, apart), 1e-12);
}

TEST(SphereGrowth, OneOfTwoTakesFromTheOther) {
  SphereAggregate two = test::pairOfSpheres(1, 1, 0.3);
  const double apart = two.distance(1), before = two.volume(), other = two.spheres()[1].volume;
  EXPECT_EQ(growSphere(two, 0, 0.3), 0);
  EXPECT_NEAR(two.volume(), before + 0.3, 1e-13);
  EXPECT_LT(two.spheres()[1].volume, other);
  EXPECT_DOUBLE_EQ(two.spheres()[1].radius, 1);
  EXPECT_NEAR(two.distance(1), apart, 1e-13);
  const double r = two.spheres()[0].radius;
  EXPECT_NEAR(two.volume(), volumeOfRadius(r) + volumeOfRadius(1) - lensVolume(r, 1, apart), 1e-12);
  EXPECT_LT(test::largestMismatch(two), 1e-13);
}

// Less surface than spheres by themselves would have, and less for its volume.
TEST(SphereGrowth, AChainLosesSurface) {
  SphereAggregate chain = test::chainOfSpheres(100, 0);
  double volume = chain.volume();
  const double specific = chain.surface() / volume;
  for (int k = 0; k < 10; ++k) {
    const double layer = 0.02, first = chain.surface();
    growEverywhere(chain, layer);
    const double gained = chain.volume() - volume;
    EXPECT_NEAR(gained, 0.5 * layer * (first + chain.surface()), 1e-3 * gained);
    volume = chain.volume();
    EXPECT_LT(test::largestMismatch(chain), 1e-11);
  }
  EXPECT_EQ(chain.count(), 100);
  EXPECT_NEAR(chain.spheres()[7].radius, 1.2, 1e-13);
  EXPECT_NEAR(chain.surface(), 100 * surfaceOfRadius(1.2) - 99 * 2 * capSurface(1.2, 1), 1e-10);
  EXPECT_LT(chain.surface() / chain.volume(), specific / 1.2);
}

TEST(SphereGrowth, SwallowsNeighbours) {
  SphereAggregate three(std::vector<AggregateSphere>{
      {{0, 0, 0}, 0.2, 0, 0, 0}, {{1, 0, 0}, 1, 0, 0.15 * 0.15, 0}, {{2, 0, 0}, 0.5, 0, 0.09, 1}});
  const double before = three.volume();
  EXPECT_EQ(growSphere(three, 1, 3), 0);  // the small one is gone, and both stand where it stood
  ASSERT_EQ(three.count(), 2);
  EXPECT_NEAR(three.volume(), before + 3, 1e-10);
  EXPECT_EQ(growSphere(three, 0, 60), 0);
  EXPECT_EQ(three.count(), 1);
  EXPECT_NEAR(three.spheres()[0].radius, std::cbrt((before + 63) * 3 / (4 * constants::pi)), 1e-11);
}

TEST(SphereGrowth, RefusesToShrink) {
  SphereAggregate one(1);
  EXPECT_THROW(growEverywhere(one, -0.1), InputError);
  EXPECT_THROW((void)growSphere(one, 0, -0.1), InputError);
}

}  // namespace
}  // namespace lampblack::particles
