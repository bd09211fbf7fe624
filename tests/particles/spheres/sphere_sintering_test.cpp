#include "particles/spheres/sphere_sintering.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"

namespace lampblack::particles {
namespace {

// Time 1 of spheres of radius 1.
SinteringLaw unitLaw(SinteringMechanism mechanism) {
  return {mechanism, mechanism == SinteringMechanism::grainBoundary ? 1.0 / 16 : 1.0, 0, 0};
}

// Times at which equal spheres have these ratios of neck and radius, of an independent program
// (specification of spheres, section Tests, 1).
TEST(SphereSintering, EqualSpheresByGrainBoundaryDiffusion) {
  constexpr std::array<std::array<double, 2>, 8> published{{{0.1, 2.745979e-7},
                                                            {0.2, 1.863390e-5},
                                                            {0.3, 2.280974e-4},
                                                            {0.5, 5.998377e-3},
                                                            {0.7, 6.464916e-2},
                                                            {0.8, 1.957326e-1},
                                                            {0.9, 6.707665e-1},
                                                            {0.94999, 1.5119}}};
  SphereSintering sintering(unitLaw(SinteringMechanism::grainBoundary), 1e-6);
  for (const auto& [ratio, time] : published) {
    SphereAggregate two(std::vector<AggregateSphere>{{{0, 0, 0}, 1, 0, 0, 0}, {{2, 0, 0}, 1, 0, 1e-4, 0}});
    sintering.advance(two, 1, time);
    ASSERT_EQ(two.count(), 2);
    const double r = two.spheres()[0].radius;
    EXPECT_NEAR(std::sqrt(two.spheres()[1].neck) / r, ratio, 1e-5) << time;
    if (time > 1.5) {
      EXPECT_NEAR(two.distance(1), 0.694659, 2e-4);
      EXPECT_NEAR(r, 1.112345, 1e-5);
      EXPECT_NEAR(two.surface() / (8 * constants::pi), 0.811831, 1e-5);
    }
    EXPECT_LT(test::largestMismatch(two), 1e-11);
  }
}

TEST(SphereSintering, EndsAsOneSphere) {
  SphereAggregate two = test::pairOfSpheres(1, 1, 0.01);
  const double volume = two.volume();
  SphereSintering sintering(unitLaw(SinteringMechanism::grainBoundary));
  sintering.advance(two, 1, 1.5115);
  EXPECT_EQ(two.count(), 2);
  sintering.advance(two, 1, 0.0015);
  ASSERT_EQ(two.count(), 1);
  EXPECT_DOUBLE_EQ(two.volume(), volume);
  EXPECT_NEAR(two.spheres()[0].radius, std::cbrt(2.0), 1e-7);
  EXPECT_NEAR(two.surface() / (8 * constants::pi), std::cbrt(0.5), 1e-7);
}

TEST(SphereSintering, BeginsBySixthPower) {
  SphereAggregate two = test::pairOfSpheres(1, 1, 0.01);
  SphereSintering sintering(unitLaw(SinteringMechanism::grainBoundary));
  sintering.advance(two, 1, 1e-11);
  EXPECT_NEAR(std::pow(two.spheres()[1].neck, 3) - 1e-12, 12 / constants::pi * 1e-11,
              2e-2 * 12 / constants::pi * 1e-11);
}

// The distance goes with the radius of the one as the specification derives it from the conservation of both volumes.
TEST(SphereSintering, RadiiFollowTheDistance) {
  std::vector<AggregateSphere> spheres{
      {{0, 0, 0}, 1, 0, 0, 0}, {{1, 0, 0}, 0.8, 0, 0.2, 0}, {{-1, 0.3, 0}, 1.2, 0, 0.3, 0}};
  const double r = 1, other = 0.8;
  const SphereAggregate before(spheres);
  std::vector<SphereSurfaces> surfaces;
  before.surfaces(surfaces);
  const double x = planeOfNeck(r, 0.2), y = planeOfNeck(other, 0.2), d = x + y, neck = 0.2 * constants::pi;
  const double first = surfaces[0].free + 0.3 * constants::pi * r / planeOfNeck(r, 0.3), second = surfaces[1].free;
  const double slope =
      -(neck * neck * other + neck * y * second) / (d * first * second + neck * (r * second + other * first));
  // The neck of the first two widens a little, all volumes stay.
  const double h = 1e-5;
  const auto radiusOf = [&](std::size_t i, std::vector<double> necks) {
    return radiusOfVolume(before.spheres()[i].volume, necks, 1);
  };
  const auto distanceOf = [&](double square) {
    return planeOfNeck(radiusOf(0, {square, 0.3}), square) + planeOfNeck(radiusOf(1, {square}), square);
  };
  const double changed =
      (radiusOf(0, {0.2 + h, 0.3}) - radiusOf(0, {0.2 - h, 0.3})) / (distanceOf(0.2 + h) - distanceOf(0.2 - h));
  EXPECT_NEAR(changed, slope, 1e-7);
  // And the rate of the neck is that of the law: one short step of both necks.
  SphereAggregate after(spheres);
  SphereSintering sintering(unitLaw(SinteringMechanism::viscousFlow));
  const double dt = 1e-7;
  const SinteringLaw law{SinteringMechanism::viscousFlow, 1, 0, 0};
  sintering = SphereSintering(law);
  sintering.advance(after, 1, dt);
  const double rate = approachRate(law, 1, r, other, 0.2), rate2 = approachRate(law, 1, r, 1.2, 0.3);
  // The other neck keeps its radius as this one sinters, so that its plane moves by r/x dr, and the other way round.
  const double n2 = 0.3 * constants::pi, x2 = planeOfNeck(r, 0.3), y2 = planeOfNeck(1.2, 0.3), d2 = x2 + y2;
  const double first2 = surfaces[0].free + neck * r / x, second2 = surfaces[2].free;
  const double slope2 =
      -(n2 * n2 * 1.2 + n2 * y2 * second2) / (d2 * first2 * second2 + n2 * (r * second2 + 1.2 * first2));
  const double grown = -slope * rate - slope2 * rate2;
  EXPECT_NEAR((after.spheres()[0].radius - 1) / dt, grown, 1e-4 * grown);
  const double moved = -rate + r / x * (-slope2 * rate2);
  EXPECT_NEAR((after.distance(1) - d) / dt, moved, 1e-4 * std::abs(moved));
}

TEST(SphereSintering, ViscousFlowBeginsAtTheRateOfSurfaceTension) {
  const SinteringLaw law = unitLaw(SinteringMechanism::constant);
  EXPECT_NEAR(approachRate(law, 1, 1, 1, 1e-12), 1, 1e-10);
  EXPECT_NEAR(approachRate(law, 1, 3, 3, 1e-12), 3, 1e-10);  // the time is that of the law, whatever the size
  // Symmetric in both; by the smaller one's radius over its time.
  EXPECT_DOUBLE_EQ(approachRate(law, 1, 1, 0.7, 0.2), approachRate(law, 1, 0.7, 1, 0.2));
  const double a = 1, b = 0.7, d = planeOfNeck(a, 0.2) + planeOfNeck(b, 0.2);
  const double published = b * 4 * a * b * d * d * (a + b) /
                           ((a + b + d) * (a * a * a * a + b * b * b * b - 2 * a * a * b * b + 4 * d * a * b * (a + b) -
                                           d * d * (a * a + b * b)));
  EXPECT_NEAR(approachRate(law, 1, a, b, 0.2), published, 1e-13);
}

// By grain-boundary diffusion r^4/tau is the same for all sizes, so that the smaller of two sinters as fast as both.
TEST(SphereSintering, GrainBoundariesOfUnequalSpheres) {
  const SinteringLaw law = unitLaw(SinteringMechanism::grainBoundary);
  const double a = 1, b = 0.5, neck = 0.16, x = planeOfNeck(a, neck), y = planeOfNeck(b, neck);
  EXPECT_NEAR(approachRate(law, 1, a, b, neck),
              1 / (constants::pi * neck) * (1 / (a - x) + 1 / (b - y) - 2 / std::sqrt(neck)), 1e-12);
}

TEST(SphereSintering, AggregatesKeepTheirVolumeAndLoseSurface) {
  SphereAggregate one = test::ballisticAggregate(5, 3);
  const double volume = one.volume();
  SphereSintering sintering(unitLaw(SinteringMechanism::viscousFlow));
  double surface = one.surface(), reach = one.reach();
  for (int k = 0; k < 8; ++k) {
    sintering.advance(one, 1, k < 4 ? 0.1 : 2.0);
    EXPECT_NEAR(one.volume() / volume, 1, 1e-13);
    EXPECT_LT(one.surface(), surface);
    EXPECT_LT(test::largestMismatch(one), 1e-10);
    surface = one.surface();
  }
  EXPECT_LT(one.count(), 32);
  EXPECT_LT(one.reach(), reach);
  sintering.advance(one, 1, 1000);
  ASSERT_EQ(one.count(), 1);
  EXPECT_NEAR(one.spheres()[0].radius, std::cbrt(32.0), 1e-4);  // without the first necks' trace of volume
}

TEST(SphereSintering, DoesNotDependOnHowTimeIsCut) {
  SphereAggregate whole = test::ballisticAggregate(3, 5), cut = whole;
  SphereSintering sintering(unitLaw(SinteringMechanism::viscousFlow), 1e-6);
  sintering.advance(whole, 1, 0.3);
  for (int k = 0; k < 10; ++k) sintering.advance(cut, 1, 0.03);
  ASSERT_EQ(whole.count(), cut.count());
  for (std::size_t i = 0; i < whole.count(); ++i)
    EXPECT_NEAR(length(difference(whole.spheres()[i].centre, cut.spheres()[i].centre)), 0, 1e-5);
}

// Far below the critical diameter the time of sintering is 1e-140 s: no step is as short.
TEST(SphereSintering, NucleiMergeAtOnce) {
  SinteringLaw silica{SinteringMechanism::viscousFlow, 1.1e-14, 1.2e5, 4.4e-9};
  const double big = 1e-8, small = 5e-10;
  SphereAggregate four(std::vector<AggregateSphere>{{{0, 0, 0}, big, 0, 0, 0},
                                                    {{2 * big, 0, 0}, big, 0, 0, 0},
                                                    {{0, big + small, 0}, small, 0, 0, 0},
                                                    {{0, big + 3 * small, 0}, small, 0, 0, 2}});
  const double volume = four.volume();
  SphereSintering(silica).advance(four, 1500, 1e-5);
  ASSERT_EQ(four.count(), 2);
  EXPECT_NEAR(four.volume() / volume, 1, 1e-10);
  EXPECT_NEAR(four.distance(1) / (2 * big), 1, 1e-3);
  EXPECT_LT(four.spheres()[1].neck, 0.01 * big * big);
  EXPECT_TRUE(std::isfinite(four.reach()));
}

TEST(SphereSintering, NothingWithoutALawOrTime) {
  SphereAggregate two = test::pairOfSpheres(1, 1, 0.3);
  SphereSintering none({}), some(unitLaw(SinteringMechanism::viscousFlow));
  none.advance(two, 1500, 1);
  some.advance(two, 1500, 0);
  EXPECT_NEAR(two.spheres()[1].neck, 0.09, 1e-16);
  EXPECT_THROW(SphereSintering(unitLaw(SinteringMechanism::viscousFlow), 0), InputError);
  EXPECT_THROW(SphereSintering({SinteringMechanism::viscousFlow, 0, 0, 0}), InputError);
}

}  // namespace
}  // namespace lampblack::particles
