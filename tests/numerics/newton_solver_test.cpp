// Newton's method alone: steps, bounds, damping, factors that are kept.
#include "numerics/newton_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/stop_request.hpp"
#include "tests/numerics/small_systems.hpp"

namespace lampblack::numerics {
namespace {

using test::bratu;
using test::scalar;
using test::SmallSystem;

TEST(Newton, SolvesALinearSystemInOneStep) {
  // The residual of three equations in different units: 1e8 apart.
  SmallSystem system(
      3,
      [](auto x, auto F) {
        F[0] = 1e8 * (2 * x[0] - x[1] - 1);
        F[1] = -x[0] + 2 * x[1] - x[2];
        F[2] = -x[1] + 2 * x[2] - 3;
      },
      [](auto, std::vector<double>& J) { J = {2e8, -1e8, 0, -1, 2, -1, 0, -1, 2}; });
  std::vector<double> x = {100, -1000, 7};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(report.steps, 1u);
  EXPECT_EQ(report.factorisations, 1u);
  EXPECT_EQ(report.residuals, 2u);
  // By hand: x = (1.5, 2, 2.5). Rounding of numbers of 1e3.
  EXPECT_NEAR(x[0], 1.5, 1e-12);
  EXPECT_NEAR(x[1], 2, 1e-12);
  EXPECT_NEAR(x[2], 2.5, 1e-12);
}

// Central differences: the error falls by four with each halving of the distance, up to the next order.
TEST(Newton, BratuConvergesToTheExactSolutionWithSecondOrder) {
  const double load = 3;
  std::vector<double> errors;
  for (const std::size_t n : {15u, 31u, 63u}) {
    SmallSystem system = bratu(n, load);
    std::vector<double> u(n, 0.0);
    const NewtonReport report = NewtonSolver().newton(system, u);
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_LT(report.worstResidual, NewtonOptions().stepTolerance);
    EXPECT_EQ(report.timeSteps, 0u);
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i + 1) / static_cast<double>(n + 1);
      error = std::max(error, std::abs(u[i] - test::bratuExact(x, load)));
    }
    errors.push_back(error);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.3);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.1);
}

TEST(Newton, DampsStepsThatWouldDiverge) {
  // Undamped steps of atan diverge from |x| > 1.39.
  SmallSystem system = scalar([](double x) { return std::atan(x); }, [](double x) { return 1 / (1 + x * x); });
  std::vector<double> x = {20};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x[0], 0, 1e-7);  // stepTolerance times scale
}

TEST(Newton, ScalingOfTheEquationsChangesNothing) {
  std::vector<std::size_t> steps;
  std::vector<double> roots;
  for (const double factor : {1.0, 0x1p60}) {  // a power of two: the same rounding
    SmallSystem system =
        scalar([=](double x) { return factor * (std::exp(x) - 5); }, [=](double x) { return factor * std::exp(x); });
    std::vector<double> x = {-3};
    const NewtonReport report = NewtonSolver().newton(system, x);
    EXPECT_TRUE(report.converged) << report.reason;
    steps.push_back(report.steps);
    roots.push_back(x[0]);
  }
  EXPECT_EQ(steps[0], steps[1]);
  EXPECT_EQ(roots[0], roots[1]);
  EXPECT_NEAR(roots[0], std::log(5), 1e-7);
}

TEST(Newton, NeverLeavesTheBounds) {
  // From 8 the full step of ln x + 2 goes to -8 (2 + ln 8) + 8 < 0, where the logarithm does not exist.
  SmallSystem system = scalar([](double x) { return std::log(x) + 2; }, [](double x) { return 1 / x; });
  system.lower[0] = 1e-6;
  system.upper[0] = 10;
  std::vector<double> x = {8};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_FALSE(system.outOfBounds);
  EXPECT_NEAR(x[0], std::exp(-2), 1e-7);
}

TEST(Newton, SaysWhichUnknownIsHeldByItsBound) {
  SmallSystem system(
      2,
      [](auto x, auto F) {
        F[0] = x[0] - 1;
        F[1] = x[1] + 3;
      },
      [](auto, std::vector<double>& J) {
        J = {1, 0, 0, 1};
      });
  system.lower[1] = 0;
  std::vector<double> x = {0, 1};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.worst, "x1");
  EXPECT_THAT(report.reason, testing::HasSubstr("x1"));
  EXPECT_THAT(report.reason, testing::HasSubstr("bound"));
  EXPECT_FALSE(system.outOfBounds);
}

TEST(Newton, ATinyStepOutOfBoundsIsNoFailure) {
  SmallSystem system = scalar([](double x) { return x + 1e-9; }, [](double) { return 1; });
  system.lower[0] = 0;
  std::vector<double> x = {0};
  const NewtonReport report = NewtonSolver().newton(system, x);  // 1e-9 is 1e-5 of the scale
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_FALSE(system.outOfBounds);
  EXPECT_GE(x[0], 0);
}

TEST(Newton, StepsBackFromWhereTheEquationsCannotBeEvaluated) {
  SmallSystem system(
      1,
      [](auto x, auto F) {
        if (x[0] <= 0) throw NumericsError("negative");
        F[0] = std::log(x[0]) + 2;
      },
      [](auto x, std::vector<double>& J) { J[0] = 1 / x[0]; });
  std::vector<double> x = {8};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x[0], std::exp(-2), 1e-7);

  x = {-1};
  EXPECT_THROW(NewtonSolver().newton(system, x), NumericsError);
}

TEST(Newton, ErrorsThatAreNoNumericsErrorsPassThroughPetsc) {
  SmallSystem system(
      1,
      [](auto x, auto F) {
        if (x[0] < 2) throw std::logic_error("not for the line search");
        F[0] = x[0];
      },
      [](auto, std::vector<double>& J) { J[0] = 1; });
  std::vector<double> x = {3};
  EXPECT_THROW(NewtonSolver().newton(system, x), std::logic_error);
}

// Whichever evaluation it is that is asked to stop: of the start, in a line search, in a time step.
TEST(Newton, AStopEndsItAtOnceAndWhatWasDoneIsCounted) {
  std::size_t calls = 0;
  const auto run = [&](std::size_t last, NewtonReport& report) {
    calls = 0;
    SmallSystem system(
        1,
        [&, last](auto x, auto F) {
          if (++calls >= last) throw Stopped(15, "stopped");
          F[0] = std::atan(x[0]) + 1e-3 * x[0];  // Newton's method alone diverges from far
        },
        [](auto x, std::vector<double>& J) { J[0] = 1 / (1 + x[0] * x[0]) + 1e-3; });
    std::vector<double> x = {60};
    NewtonOptions options;
    options.maximumSteps = 3;
    NewtonSolver solver(options, {});
    try {
      report = solver.steady(system, x);
      EXPECT_TRUE(report.converged) << report.reason;
      return true;
    } catch (const Stopped&) {
      report = solver.report();
      return false;
    }
  };
  NewtonReport whole, part;
  ASSERT_TRUE(run(10000, whole));
  ASSERT_GT(whole.timeSteps, 0u);
  const std::size_t all = calls;
  for (std::size_t last = 1; last <= all; ++last) {
    ASSERT_FALSE(run(last, part));
    EXPECT_EQ(calls, last) << "it goes on after a stop";
    EXPECT_EQ(part.residuals, last);
  }
}

// The line search of a step within the tolerance, which may be cut to nothing.
TEST(Newton, ATinyStepThatCannotBeEvaluatedEnds) {
  std::size_t calls = 0;
  SmallSystem system(
      1,
      [&](auto, auto F) {
        if (++calls > 1) throw NumericsError("no value");
        F[0] = 1e-9;
      },
      [](auto, std::vector<double>& J) { J[0] = 1; });
  std::vector<double> x = {1};
  EXPECT_FALSE(NewtonSolver().newton(system, x).converged);
  EXPECT_LT(calls, 100u);
}

TEST(Newton, KeepsFactorsWhileTheyConvergeFast) {
  // Bratu at a small load is nearly linear: one matrix is good for all steps, at the price of more of them.
  std::vector<double> kept(31, 0.0), renewed(31, 0.0);
  NewtonOptions options;
  options.stepTolerance = 1e-8;
  SmallSystem system = bratu(31, 1);
  const NewtonReport lazy = NewtonSolver(options).newton(system, kept);
  EXPECT_TRUE(lazy.converged) << lazy.reason;
  EXPECT_EQ(lazy.factorisations, 1u);
  EXPECT_EQ(system.factorisations, 1u);
  EXPECT_EQ(lazy.residuals, lazy.steps + 1);

  options.jacobianAge = 1;
  const NewtonReport eager = NewtonSolver(options).newton(system, renewed);
  EXPECT_TRUE(eager.converged) << eager.reason;
  EXPECT_EQ(eager.factorisations, eager.steps);
  EXPECT_LT(eager.steps, lazy.steps);
  // The contraction of the kept factors is below 0.4: the error is below 1/(1 - 0.4) of the last step.
  EXPECT_THAT(kept, testing::Pointwise(testing::DoubleNear(2e-12), renewed));
}

TEST(Newton, RenewsFactorsAtOnceWhereTheySlowDown) {
  // Strongly nonlinear: with one matrix for ever the contraction would be about 1 - exp(-(x - x0)) from left of the
  // root.
  SmallSystem system = scalar([](double x) { return std::exp(x) - 1; }, [](double x) { return std::exp(x); });
  std::vector<double> x = {3};
  NewtonOptions options;
  options.jacobianAge = 1000;
  const NewtonReport report = NewtonSolver(options).newton(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_GT(report.factorisations, 2u);
  // At least a factor 0.4 a step, from 1e4 to 1e-3: 18 steps; each renewal may add one that was slow.
  EXPECT_LE(report.steps, 18u + report.factorisations);
}

TEST(Newton, PolishesWithTheFactorsAtHandDownToRounding) {
  // The matrix is wrong by a tenth: a contraction of 0.1 a step.
  SmallSystem system(
      2,
      [](auto x, auto F) {
        F[0] = x[0] * x[0] - 2;
        F[1] = x[1] - x[0];
      },
      [](auto x, std::vector<double>& J) {
        J = {1.1 * 2 * x[0], 0, -1, 1};
      });
  NewtonOptions options;
  std::vector<double> rough = {1.4, 0}, fine = rough;
  const NewtonReport first = NewtonSolver(options).newton(system, rough);
  ASSERT_TRUE(first.converged) << first.reason;
  EXPECT_GT(std::abs(rough[0] - std::sqrt(2)), 1e-12);
  options.polish = 1e-11;  // of the scale 1e-4: rounding level
  const NewtonReport second = NewtonSolver(options).newton(system, fine);
  ASSERT_TRUE(second.converged) << second.reason;
  EXPECT_NEAR(fine[0], std::sqrt(2), 1e-15);
  EXPECT_LE(second.factorisations, first.factorisations + 1);

  options.polish = 1e-30;  // never reached: rounding stops it
  const NewtonReport third = NewtonSolver(options).newton(system, fine);
  EXPECT_TRUE(third.converged) << third.reason;
  EXPECT_LE(third.steps, 6u);
}

TEST(Newton, ASingularMatrixIsAFailureWithAReason) {
  SmallSystem system = scalar([](double x) { return x * x + 1; }, [](double x) { return 2 * x; });
  std::vector<double> x = {0};
  const NewtonReport report = NewtonSolver().newton(system, x);
  EXPECT_FALSE(report.converged);
  EXPECT_THAT(report.reason, testing::HasSubstr("singular"));
}

}  // namespace
}  // namespace lampblack::numerics
