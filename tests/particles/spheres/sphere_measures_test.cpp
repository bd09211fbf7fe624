#include "particles/spheres/sphere_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::particles {
namespace {

TEST(SphereMeasures, GyrationOfSpheresAndPairs) {
  EXPECT_NEAR(gyrationSquared(SphereAggregate(2)), 2.4, 1e-14);
  EXPECT_EQ(gyrationSquaredOfPoints(SphereAggregate(2)), 0);
  EXPECT_NEAR(gyrationSquared(test::pairOfSpheres(1, 1, 0)), 1.6, 1e-13);
  EXPECT_NEAR(gyrationSquaredOfPoints(test::pairOfSpheres(1, 1, 0)), 1, 1e-13);
}

// Cut spheres: slices along the line of the centres.
TEST(SphereMeasures, GyrationOfOverlappingSpheres) {
  const SphereAggregate two = test::pairOfSpheres(1, 0.7, 0.6);
  const double d = two.distance(1), plane = std::sqrt(1 - 0.36);
  double volume = 0, first = 0, second = 0;
  constexpr int n = 200000;
  const double h = (1 + d + 0.7) / n;
  for (int k = 0; k < n; ++k) {
    const double z = -1 + (k + 0.5) * h, from = z < plane ? z : z - d, r = z < plane ? 1 : 0.7;
    const double square = r * r - from * from, v = constants::pi * square * h;
    volume += v;
    first += v * z;
    second += v * (z * z + square / 2);
  }
  EXPECT_NEAR(two.volume(), volume, 1e-8);
  EXPECT_NEAR(gyrationSquared(two), second / volume - first * first / (volume * volume), 1e-8);
  // Turned and moved, and as part of the other order, it is the same.
  EXPECT_NEAR(gyrationSquared(test::pairOfSpheres(0.7, 1, 0.6)), gyrationSquared(two), 1e-13);
}

TEST(SphereMeasures, LengthsAndOverlaps) {
  const SphereAggregate two = test::pairOfSpheres(1, 0.7, 0.6);
  EXPECT_NEAR(maximumLength(two), 1.7 + two.distance(1), 1e-13);
  EXPECT_NEAR(maximumLength(SphereAggregate(2)), 4, 1e-15);
  EXPECT_EQ(uncountedOverlap(two), 0);
  EXPECT_NEAR(meanRadius(two), 0.85, 1e-15);
  EXPECT_NEAR(coordination(two), 1, 1e-15);
  // A bent chain of three whose ends overlap.
  const SphereAggregate three(
      std::vector<AggregateSphere>{{{1, 0, 0}, 1, 0, 0, 0}, {{0, 0, 0}, 1, 0, 0, 0}, {{1, 1, 0}, 1, 0, 0, 1}});
  const auto s = three.spheres();
  const double apart = length(difference(s[0].centre, s[2].centre));
  ASSERT_LT(apart, 2);
  EXPECT_NEAR(uncountedOverlap(three), constants::pi / 12 * (4 + apart) * (2 - apart) * (2 - apart), 1e-12);
}

TEST(SphereMeasures, AreasOfDiscs) {
  const double pi = constants::pi;
  EXPECT_NEAR(coveredArea(std::vector<RigidSphere>{{{3, 4, 0}, 2}}), 4 * pi, 1e-12);
  EXPECT_NEAR(coveredArea(std::vector<RigidSphere>{{{3, 4, 0}, 2}, {{3, 4, 7}, 2}, {{3.5, 4, 0}, 1}}), 4 * pi, 1e-12);
  for (const double side : {-1, 1})  // touching from within
    EXPECT_NEAR(coveredArea(std::vector<RigidSphere>{{{0, 0, 0}, 2}, {{side, 0, 5}, 1}}), 4 * pi, 1e-12);
  // Two whose centres lie on each other's edge.
  const double lens = 2 * pi / 3 - std::sqrt(3) / 2;
  EXPECT_NEAR(coveredArea(std::vector<RigidSphere>{{{0, 0, 0}, 1}, {{0, 1, 0}, 1}}), 2 * pi - lens, 1e-12);
  EXPECT_NEAR(coveredArea(std::vector<RigidSphere>{{{-2, 0, 0}, 1}, {{-3, 0, 1}, 1}, {{9, 9, 9}, 3}}), 11 * pi - lens,
              1e-11);
  // Points that are drawn uniformly.
  RandomStream random(3, 1, 1);
  std::vector<RigidSphere> discs;
  for (int i = 0; i < 40; ++i)
    discs.push_back({{6 * random.uniform(), 6 * random.uniform(), 0}, 0.2 + 0.8 * random.uniform()});
  std::vector<double> inside;
  for (int k = 0; k < 40000; ++k) {
    const double x = -1 + 8 * random.uniform(), y = -1 + 8 * random.uniform();
    bool isIn = false;
    for (const RigidSphere& d : discs) isIn = isIn || std::hypot(x - d.centre[0], y - d.centre[1]) < d.radius;
    inside.push_back(isIn ? 64 : 0);
  }
  EXPECT_LT(std::abs(test::summarise(inside).z(coveredArea(discs))), test::zLimit);
}

// Two touching spheres: (1 + 8/(3 pi)) pi a^2, derived from the lens over all directions.
TEST(SphereMeasures, ShadowOfTwoTouchingSpheres) {
  const SphereAggregate two = test::pairOfSpheres(1, 1, 0);
  RandomStream random(2, 0, 0);
  std::vector<double> areas;
  for (int k = 0; k < 4000; ++k) areas.push_back(projectedArea(two, 1, random));
  EXPECT_LT(std::abs(test::summarise(areas).z(1.848826 * constants::pi)), test::zLimit);
  EXPECT_LT(test::summarise(areas).standardError, 0.005 * constants::pi);
  EXPECT_NEAR(shadowDiameter(constants::pi * 9), 6, 1e-14);
  EXPECT_NEAR(projectedArea(SphereAggregate(2), 3, random), 4 * constants::pi, 1e-12);
}

TEST(SphereMeasures, FractalLawOfPoints) {
  FractalPoints exact;
  for (const double n : {8.0, 64.0, 512.0}) exact.add(n, std::pow(n / 1.3, 1 / 1.8), n);
  EXPECT_NEAR(exact.fit().dimension, 1.8, 1e-12);
  EXPECT_NEAR(exact.fit().prefactor, 1.3, 1e-11);
  EXPECT_NEAR(exact.fit().dimensionError, 0, 1e-6);
  EXPECT_NEAR(exact.fit().dimensionOverRadius, 1.8, 1e-12);
  EXPECT_NEAR(exact.fit().prefactorOverRadius, 1.3, 1e-11);
  EXPECT_TRUE(std::isnan(FractalPoints().fit().dimension));
  FractalPoints narrow;
  for (const double n : {20.0, 30.0, 79.0}) narrow.add(n, n);
  EXPECT_TRUE(std::isnan(narrow.fit().dimension));
  narrow.add(80, 80);
  EXPECT_NEAR(narrow.fit().dimension, 1, 1e-12);
  // ln(R_g/a) = 0, 1, 4 at ln n = 0, 1, 2: the line -1/3 + 2 ln n, whose slope has the square of the error 1/3 and the
  // middle of the points 2/9; ln n of the line's zero is 1/6, 5/6 from the middle.
  FractalPoints points;
  for (const auto& [n, radius] : {std::pair{0, 0}, {1, 1}, {2, 4}}) points.add(std::exp(n), std::exp(radius));
  EXPECT_NEAR(points.fit().dimension, 0.5, 1e-12);
  EXPECT_NEAR(points.fit().dimensionError, std::sqrt(1.0 / 3) / 4, 1e-12);
  EXPECT_NEAR(points.fit().prefactor, std::exp(1.0 / 6), 1e-12);
  EXPECT_NEAR(points.fit().prefactorError, std::exp(1.0 / 6) / 2 * std::sqrt(2.0 / 9 + 25.0 / 108), 1e-12);
  // The other line, 1 + 6/13 (ln(R_g/a) - 5/3) through the same middle.
  EXPECT_NEAR(points.fit().dimensionOverRadius, 6.0 / 13, 1e-12);
  EXPECT_NEAR(points.fit().prefactorOverRadius, std::exp(3.0 / 13), 1e-12);
}

}  // namespace
}  // namespace lampblack::particles
