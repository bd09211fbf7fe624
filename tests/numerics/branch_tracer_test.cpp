#include "numerics/branch_tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/modules.hpp"
#include "tests/numerics/small_systems.hpp"

namespace lampblack::numerics {
namespace {

using test::SmallLoadedSystem;

ContinuationOptions accurate(double largestStep) {
  ContinuationOptions options;
  options.largestStep = largestStep;
  options.firstStep = std::min(options.firstStep, largestStep);
  options.newton.stepTolerance = 1e-8;
  options.goodSteps = 4;
  return options;
}

// The unit circle x^2 + load^2 = 1 from (1, 0): turns at load = 1 and -1.
SmallLoadedSystem circle() {
  return {2, [](auto x, auto F) { F[0] = x[0] * x[0] + x[1] * x[1] - 1; },
          [](auto x, std::vector<double>& J) {
            J[0] = 2 * x[0];
            J[1] = 2 * x[1];
          }};
}

TEST(BranchTracer, GoesRoundACircle) {
  SmallLoadedSystem system = circle();
  BranchTracer tracer(system, accurate(1000));  // 0.1, since the scale is 1e-4
  ASSERT_TRUE(tracer.start(std::vector<double>{1, 0})) << tracer.reason();
  for (int i = 0; i < 200 && tracer.points().back().arcLength < 2e4 * std::numbers::pi; ++i) {
    ASSERT_TRUE(tracer.advance()) << tracer.reason();
    EXPECT_NEAR(tracer.x()[0] * tracer.x()[0] + tracer.x()[1] * tracer.x()[1], 1, 1e-11);
  }
  // Once round: chords of at most 0.1 are shorter than their arcs by h^2/24 at most, and the last may go 0.1 too far.
  EXPECT_NEAR(std::atan2(tracer.x()[1], tracer.x()[0]), 0, 0.1 + 2 * std::numbers::pi * 0.01 / 24);
  ASSERT_EQ(tracer.turningPoints().size(), 2u);
  // The fourth derivative of cos is at most 1: the parabola through points up to 0.1 away is off by less than
  // 0.1^4/24 * 16 there.
  EXPECT_NEAR(tracer.turningPoints()[0].load, 1, 1e-4);
  EXPECT_TRUE(tracer.turningPoints()[0].highest);
  EXPECT_NEAR(tracer.turningPoints()[1].load, -1, 1e-4);
  EXPECT_FALSE(tracer.turningPoints()[1].highest);
}

TEST(BranchTracer, GoesDownwardsWhereTold) {
  SmallLoadedSystem system = circle();
  ContinuationOptions options = accurate(1000);
  options.towardsHigherLoad = false;
  BranchTracer tracer(system, options);
  ASSERT_TRUE(tracer.start(std::vector<double>{1, 0}));
  ASSERT_TRUE(tracer.advance());
  EXPECT_LT(tracer.x()[1], 0);
}

// load = x^3 - 3x has its maximum 2 at x = -1 and its minimum -2 at x = 1. Other unknowns follow x, in many places:
// they must not keep the load from being seen.
TEST(BranchTracer, FollowsAnSCurveWithManyUnknowns) {
  std::vector<double> errors;
  for (const double largest : {400.0, 200.0, 100.0}) {
    const std::size_t n = 40;
    SmallLoadedSystem system(
        n,
        [](auto x, auto F) {
          F[0] = x[0] * x[0] * x[0] - 3 * x[0] - x[n - 1];
          for (std::size_t i = 1; i + 1 < n; ++i) F[i] = x[i] - x[i - 1];
        },
        [](auto x, std::vector<double>& J) {
          J[0] = 3 * x[0] * x[0] - 3;
          J[n - 1] = -1;
          for (std::size_t i = 1; i + 1 < n; ++i) {
            J[i * n + i] = 1;
            J[i * n + i - 1] = -1;
          }
        });
    BranchTracer tracer(system, accurate(largest));
    std::vector<double> x(n, -2.0);  // load = -2
    ASSERT_TRUE(tracer.start(x)) << tracer.reason();
    while (tracer.x()[0] < 2) ASSERT_TRUE(tracer.advance()) << tracer.reason();
    ASSERT_EQ(tracer.turningPoints().size(), 2u);
    EXPECT_TRUE(tracer.turningPoints()[0].highest);
    EXPECT_FALSE(tracer.turningPoints()[1].highest);
    errors.push_back(std::abs(tracer.turningPoints()[0].load - 2) + std::abs(tracer.turningPoints()[1].load + 2));
  }
  // The parabola's error is of third order in the step where the load is not symmetric about the turn; where points
  // fall with respect to the turn varies, so only a factor of 4 for each halving, in the mean.
  EXPECT_LT(errors[2], errors[0] / 16);
  EXPECT_LT(errors[2], 1e-5);
}

// Bratu's problem: solutions exist up to load 3.513830719 (Frank-Kamenetskii). Central differences: error of second
// order.
TEST(BranchTracer, FindsTheFoldOfBratusProblem) {
  std::vector<double> folds;
  for (const std::size_t inner : {15u, 31u}) {
    const std::size_t n = inner + 1;
    SmallLoadedSystem system(
        n, [=](auto x, auto F) { test::bratuResidual(x, inner, x[n - 1], F); },
        [=](auto x, std::vector<double>& J) {
          test::bratuMatrix(x, inner, x[n - 1], n, J);
          for (std::size_t i = 0; i < inner; ++i) J[i * n + n - 1] = -std::exp(x[i]);
        });
    BranchTracer tracer(system, accurate(1000));
    ASSERT_TRUE(tracer.start(std::vector<double>(n, 0.0))) << tracer.reason();
    while (tracer.turningPoints().empty()) ASSERT_TRUE(tracer.advance()) << tracer.reason();
    folds.push_back(tracer.turningPoints().front().load);
    EXPECT_TRUE(tracer.turningPoints().front().highest);
  }
  const double exact = 3.513830719125162;
  EXPECT_NEAR((folds[0] - exact) / (folds[1] - exact), 4, 0.1);
  EXPECT_NEAR(folds[1] + (folds[1] - folds[0]) / 3, exact, 1e-4);
}

// The same branch in other unknowns from some point on: as after a change of grid, next to the turning point.
TEST(BranchTracer, ResumesNearATurningPointWhereAFixedLoadWouldHaveNoSolution) {
  SmallLoadedSystem system = circle();
  BranchTracer tracer(system, accurate(1000));
  ASSERT_TRUE(tracer.start(std::vector<double>{1, 0}));
  while (tracer.x()[1] < 0.99) ASSERT_TRUE(tracer.advance());
  // Off the circle, at a load beyond its end, as interpolation might do.
  std::vector<double> x(tracer.x().begin(), tracer.x().end());
  const std::vector<double> tangent(tracer.tangent().begin(), tracer.tangent().end());
  x[1] = 1.01;
  ASSERT_TRUE(tracer.resume(x, tangent)) << tracer.reason();
  EXPECT_NEAR(tracer.x()[0] * tracer.x()[0] + tracer.x()[1] * tracer.x()[1], 1, 1e-11);
  while (tracer.x()[0] > -0.5) ASSERT_TRUE(tracer.advance()) << tracer.reason();
  EXPECT_EQ(tracer.turningPoints().size(), 1u);
}

// A turn in the very first step cannot be seen in the loads of three points.
TEST(BranchTracer, SeesATurnWithinTheFirstStep) {
  SmallLoadedSystem system = circle();
  ContinuationOptions options = accurate(1000);
  options.firstStep = 1000;
  BranchTracer tracer(system, options);
  ASSERT_TRUE(tracer.start(std::vector<double>{0.02, std::sqrt(1 - 0.02 * 0.02)}));
  ASSERT_TRUE(tracer.advance()) << tracer.reason();
  EXPECT_LT(tracer.x()[0], 0);
  ASSERT_EQ(tracer.turningPoints().size(), 1u);
  EXPECT_NEAR(tracer.turningPoints()[0].load, 1, 1e-5);  // the parabola is off by less than 0.1^4/24
  ASSERT_TRUE(tracer.advance());
  EXPECT_EQ(tracer.turningPoints().size(), 1u);
}

// load = x, but only up to x = 1: an end of the branch that is no turning point.
TEST(BranchTracer, SaysThatTheBranchEnds) {
  SmallLoadedSystem system(
      2, [](auto x, auto F) { F[0] = x[0] > 1 ? std::nan("") : x[0] - x[1]; },
      [](auto, std::vector<double>& J) {
        J[0] = 1;
        J[1] = -1;
      });
  BranchTracer tracer(system, accurate(1000));
  ASSERT_TRUE(tracer.start(std::vector<double>{0.5, 0.5}));
  int points = 0;
  while (tracer.advance()) ASSERT_LT(++points, 100);
  EXPECT_FALSE(tracer.reason().empty());
  EXPECT_NEAR(tracer.x()[1], 1, 1e-4);
  EXPECT_TRUE(tracer.turningPoints().empty());
}

}  // namespace
}  // namespace lampblack::numerics
