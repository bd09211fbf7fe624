#include "particles/spheres/ballistic_joining.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "particles/spheres/sphere_measures.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::particles {
namespace {

using test::Sample;
using test::summarise;
using test::zLimit;

TEST(BallisticJoining, RotationsAreUniform) {
  RandomStream random(1, 2, 3);
  constexpr int draws = 20000;
  std::array<std::vector<double>, 4> moments;
  for (int k = 0; k < draws; ++k) {
    const Rotation r = randomRotation(random);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) ASSERT_NEAR(dot(r[i], r[j]), i == j ? 1 : 0, 1e-14);
    ASSERT_NEAR(dot(cross(r[0], r[1]), r[2]), 1, 1e-13);
    const double trace = r[0][0] + r[1][1] + r[2][2];
    moments[0].push_back(r[2][0]);
    moments[1].push_back(r[0][1] * r[0][1]);
    moments[2].push_back(std::pow(r[1][2], 4));
    moments[3].push_back(trace * trace);
  }
  // An entry is uniform in -1 to 1; the trace, the character of vectors, has the mean 0 and the mean square 1.
  constexpr std::array exact{0.0, 1.0 / 3, 0.2, 1.0};
  for (std::size_t m = 0; m < exact.size(); ++m) EXPECT_LT(std::abs(summarise(moments[m]).z(exact[m])), zLimit) << m;
}

// A sphere and two that touch, all of radius 1: as large as the union of two discs of radius 2, whose distance is twice
// the sine of the pair's angle to the line, over the disc of radius 3 in which lines are drawn.
TEST(BallisticJoining, LinesHitAsOftenAsTheyMay) {
  RandomStream random(6, 0, 0);
  BallisticJoining joining;
  const SphereAggregate one(1), two = joining.join(one, one, random);
  constexpr int angles = 1000, draws = 20000;
  double area = 0;
  for (int k = 0; k < angles; ++k) {
    const double cosine = (k + 0.5) / angles, half = 0.5 * std::sqrt(1 - cosine * cosine);  // of the discs' radius
    area += 4 * (2 * constants::pi - 2 * std::acos(half) + 2 * half * std::sqrt(1 - half * half)) / angles;
  }
  std::vector<double> hits;
  for (int k = 0; k < draws; ++k) hits.push_back(joining.draw(two, one, random) ? 1 : 0);
  EXPECT_LT(std::abs(summarise(hits).z(area / (9 * constants::pi))), zLimit);
  EXPECT_EQ(joining.tries(), draws + 1U);
  EXPECT_TRUE(joining.draw(one, one, random));
}

// Two spheres touch in a direction of which the square of the sine is uniform: uniform impact points.
TEST(BallisticJoining, ImpactPointsAreUniform) {
  RandomStream random(4, 0, 0);
  std::vector<double> sines, squares;
  for (int k = 0; k < 4000; ++k) {
    const double r = 2 * std::sqrt(random.uniform()), angle = 2 * constants::pi * random.uniform();
    const std::vector<RigidSphere> one{{{0, 0, 0}, 1}}, other{{{r * std::cos(angle), r * std::sin(angle), 0}, 1}};
    const auto contact = firstContact(one, other);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->height * contact->height + r * r, 4, 1e-12);
  }
  // Of a large and a small aggregate: the direction from the large sphere in which a small one hits it is uniform.
  BallisticJoining joining;
  const SphereAggregate large(10), small(0.5);
  std::vector<double> heights;
  for (int k = 0; k < 4000; ++k) {
    const SphereAggregate two = joining.join(large, small, random);
    const Vector3 line = difference(two.spheres()[1].centre, two.spheres()[0].centre);
    EXPECT_NEAR(length(line), 10.5, 1e-12);
    heights.push_back(line[2] / 10.5 * (line[2] / 10.5));
  }
  EXPECT_LT(std::abs(summarise(heights).z(0.5)), zLimit);  // of a point uniform in a disc, cos^2 is uniform in 0 to 1
  EXPECT_EQ(joining.tries(), 4000);                        // a disc of the sum of both radii: every line hits
}

TEST(BallisticJoining, TouchesWhereNoPairOverlaps) {
  RandomStream random(5, 0, 0);
  BallisticJoining joining;
  const SphereAggregate first = test::ballisticAggregate(5, 1), second = test::ballisticAggregate(4, 2);
  for (int k = 0; k < 20; ++k) {
    const SphereAggregate both = joining.join(first, second, random);
    ASSERT_EQ(both.count(), first.count() + second.count());
    EXPECT_LT(test::largestMismatch(both), 1e-12);
    EXPECT_NEAR(both.volume(), first.volume() + second.volume(), 1e-12 * both.volume());
    EXPECT_LT(uncountedOverlap(both), 1e-12);
    EXPECT_NEAR(coordination(both), 2 * (1 - 1.0 / 48), 1e-14);
  }
}

TEST(BallisticJoining, SquaresFindWhatAllPairsFind) {
  RandomStream random(6, 0, 0);
  int hits = 0;
  for (int k = 0; k < 40; ++k) {
    std::array<std::vector<RigidSphere>, 2> clouds;
    for (auto& cloud : clouds)
      for (int i = 0; i < 80; ++i)
        cloud.push_back({{k % 7 == 0 ? 300 * random.uniform() : 30 * random.uniform(), 30 * random.uniform(),
                          10 * random.uniform()},
                         0.1 + random.uniform()});
    for (RigidSphere& s : clouds[1]) s.centre[0] += 25 - k;
    const auto found = firstContact(clouds[0], clouds[1]), exact = firstContactOfPairs(clouds[0], clouds[1]);
    ASSERT_EQ(found.has_value(), exact.has_value());
    if (!exact) continue;
    ++hits;
    EXPECT_EQ(found->height, exact->height);
    EXPECT_EQ(found->first, exact->first);
    EXPECT_EQ(found->second, exact->second);
  }
  EXPECT_GT(hits, 30);
}

// A tree is joined at any of its spheres: its necks stay between the same spheres.
TEST(BallisticJoining, NecksStayBetweenTheirSpheres) {
  std::vector<AggregateSphere> spheres{{{0, 0, 0}, 1, 0, 0, 0},
                                       {{1, 0, 0}, 0.9, 0, 0.1, 0},
                                       {{0, 1, 0}, 0.8, 0, 0.2, 0},
                                       {{0, 2, 0}, 0.7, 0, 0.3, 2},
                                       {{1, 2, 1}, 0.6, 0, 0.05, 3}};
  const SphereAggregate tree(spheres), one(1);
  std::vector<RigidSphere> places, origin{{{0, 0, 0}, 1}};
  for (const AggregateSphere& s : tree.spheres()) places.push_back({s.centre, s.radius});
  for (std::size_t at = 0; at < 5; ++at) {
    const double apart = 1 + tree.spheres()[at].radius;
    const SphereAggregate both =
        joinedAt(origin, one, places, tree, difference({apart, 0, 0}, tree.spheres()[at].centre), 0, at);
    ASSERT_EQ(both.count(), 6);
    EXPECT_LT(test::largestMismatch(both), 1e-13);
    double necks = 0;
    for (std::size_t k = 1; k < 6; ++k) {
      const AggregateSphere &s = both.spheres()[k], &p = both.spheres()[s.parent];
      necks += s.neck * s.radius * p.radius;
    }
    EXPECT_NEAR(necks, 0.1 * 0.9 + 0.2 * 0.8 + 0.3 * 0.56 + 0.05 * 0.42, 1e-14);
    EXPECT_NEAR(both.surface(), one.surface() + tree.surface(), 1e-12);
  }
}

// Clusters of clusters of the same number, of an independent program of 600 clusters a size (specification of spheres,
// section Tests, 4): two and four exactly drawn, eight within the errors of both.
TEST(BallisticJoining, EqualPairsHaveTheRadiiOfAnotherProgram) {
  RandomStream random(7, 0, 0);
  BallisticJoining joining;
  std::vector<double> four, eight, sixteen;
  const auto of = [&](int doublings, const auto& self) -> SphereAggregate {
    if (doublings == 0) return SphereAggregate(1);
    return joining.join(self(doublings - 1, self), self(doublings - 1, self), random);
  };
  EXPECT_NEAR(gyrationSquaredOfPoints(of(1, of)), 1, 1e-14);
  for (int k = 0; k < 1000; ++k) {
    four.push_back(gyrationSquaredOfPoints(of(2, of)));
    eight.push_back(gyrationSquaredOfPoints(of(3, of)));
    sixteen.push_back(gyrationSquaredOfPoints(of(4, of)));
  }
  const auto apart = [](const Sample& sample, double mean, double error) {
    return std::abs(sample.mean - mean) / std::hypot(sample.standardError, error);
  };
  EXPECT_LT(apart(summarise(four), 3.105, 0.028), zLimit);
  EXPECT_LT(apart(summarise(eight), 7.483, 0.077), zLimit);
  EXPECT_LT(apart(summarise(sixteen), 16.43, 0.18), zLimit);
}

}  // namespace
}  // namespace lampblack::particles
