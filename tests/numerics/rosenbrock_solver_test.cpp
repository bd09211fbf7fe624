#include "numerics/rosenbrock_solver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {
namespace {

constexpr std::array<double, 3> onesOfThree{1, 1, 1};

// A -> B -> C with a second-order step back (Robertson 1966): stiff, and A + B + C is kept.
void robertson(std::span<const double> y, std::span<double> f) {
  const double a = 0.04 * y[0], b = 1e4 * y[1] * y[2], c = 3e7 * y[1] * y[1];
  f[0] = -a + b;
  f[1] = a - b - c;
  f[2] = c;
}
void robertsonJacobian(std::span<const double> y, DenseLu& J) {
  const double da = 0.04, db1 = 1e4 * y[2], db2 = 1e4 * y[1], dc = 6e7 * y[1];
  const double rows[3][3] = {{-da, db1, db2}, {da, -db1 - dc, -db2}, {0, dc, 0}};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) J.column(j)[i] = rows[i][j];
}

TEST(RosenbrockSolver, SolvesAStiffProblemAndKeepsItsInvariant) {
  RosenbrockSolver solver;
  std::vector<double> y{1, 0, 0};
  const std::array<double, 3> smallest{1, 1e-5, 1};
  const auto result = solver.integrate(robertson, robertsonJacobian, 40, y, {1e-6, smallest});
  // Reference at t = 40 (Hindmarsh, LSODE).
  EXPECT_NEAR(y[0], 0.7158, 1e-4);
  EXPECT_NEAR(y[1], 9.185e-6, 1e-8);
  EXPECT_NEAR(y[2], 0.2842, 1e-4);
  EXPECT_NEAR(y[0] + y[1] + y[2], 1, 1e-14);
  EXPECT_LT(result.steps, 400);
}

// x' = -x^2, y' = x^2 - sin y over a unit of time. Steps of one size, as the tolerance never asks for smaller ones.
double endAfterRosenbrockSteps(int steps) {
  RosenbrockSolver solver;
  std::vector<double> y{1, 0};
  const auto rates = [](std::span<const double> x, std::span<double> f) {
    f[0] = -x[0] * x[0];
    f[1] = x[0] * x[0] - std::sin(x[1]);
  };
  const auto jacobian = [](std::span<const double> x, DenseLu& J) {
    J.column(0)[0] = -2 * x[0], J.column(1)[0] = 0;
    J.column(0)[1] = 2 * x[0], J.column(1)[1] = -std::cos(x[1]);
  };
  for (int i = 0; i < steps; ++i)
    EXPECT_EQ(solver.integrate(rates, jacobian, 1.0 / steps, y, {1e9, onesOfThree}).steps, 1);
  return y[1];
}

// A small change of the start goes where a difference of two solutions goes, with each step's Jacobian held: to the
// change of the Jacobian in a step.
TEST(RosenbrockSolver, CarriesAChangeOfItsStart) {
  DenseRosenbrockMatrices matrices(3);
  DenseRosenbrockSystem system(robertson, robertsonJacobian, matrices);
  const std::array<double, 3> smallest{1, 1e-5, 1}, away{0.3, 2e-6, -0.5};
  const double dt = 0.4, small = 1e-6;
  const auto end = [&](double share, std::span<double> change) {
    RosenbrockSolver solver;
    std::vector<double> y{1, 2e-5, 0.1};
    for (std::size_t i = 0; i < 3; ++i) y[i] += share * away[i];
    solver.integrate(system, dt, 0, y, {1e-8, smallest}, [&](std::span<const double>, double) {
      if (!change.empty()) solver.carry(system, change);
      return true;
    });
    return y;
  };
  std::vector<double> change(away.begin(), away.end());
  const auto at = end(0, change), beside = end(small, {});
  EXPECT_GT(std::abs(change[1] / away[1]), 2.0);  // it does not stay what it was
  for (std::size_t i = 0; i < 3; ++i) {
    const double difference = (beside[i] - at[i]) / small;
    EXPECT_NEAR(change[i], difference, 3e-3 * std::abs(difference)) << i;
  }
}

// Of a linear system, whose Jacobian stays, to the last step's round-off.
TEST(RosenbrockSolver, CarriesAChangeOfALinearSystemAsItself) {
  const auto rates = [](std::span<const double> x, std::span<double> f) { f[0] = x[1], f[1] = -4 * x[0] - 50 * x[1]; };
  const auto jacobian = [](std::span<const double>, DenseLu& J) {
    J.column(0)[0] = 0, J.column(1)[0] = 1;
    J.column(0)[1] = -4, J.column(1)[1] = -50;
  };
  DenseRosenbrockMatrices matrices(2);
  DenseRosenbrockSystem system(rates, jacobian, matrices);
  RosenbrockSolver solver;
  std::vector<double> y{1, 0}, change = y;
  const auto result = solver.integrate(system, 2, 0, y, {1e-4, onesOfThree}, [&](std::span<const double>, double) {
    solver.carry(system, change);
    return true;
  });
  EXPECT_GT(result.steps, 3);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(change[i], y[i], 1e-13);
}

TEST(RosenbrockSolver, IsOfThirdOrder) {
  const double coarse = endAfterRosenbrockSteps(20), middle = endAfterRosenbrockSteps(40),
               fine = endAfterRosenbrockSteps(80);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 3, 0.1);
}

TEST(RosenbrockSolver, ErrorFollowsTheTolerance) {
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    RosenbrockSolver solver;
    std::vector<double> y{1, 0, 0};
    solver.integrate(
        [](std::span<const double> x, std::span<double> f) { f[0] = x[1], f[1] = -x[0], f[2] = -1e6 * x[2]; },
        [](std::span<const double>, DenseLu& J) {
          for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t i = 0; i < 3; ++i) J.column(j)[i] = 0;
          J.column(1)[0] = 1, J.column(0)[1] = -1, J.column(2)[2] = -1e6;
        },
        10, y, {tolerance, onesOfThree});
    EXPECT_NEAR(y[0], std::cos(10), 30 * tolerance) << tolerance;
    EXPECT_NEAR(y[1], -std::sin(10), 30 * tolerance) << tolerance;
  }
}

TEST(RosenbrockSolver, SaysWhereItCannotGoOn) {
  RosenbrockSolver solver;
  std::vector<double> y{1};  // the rates end at 1.5
  const auto rates = [](std::span<const double> x, std::span<double> f) { f[0] = x[0] < 1.5 ? 1 : std::nan(""); };
  const auto jacobian = [](std::span<const double>, DenseLu& J) { J.column(0)[0] = 0; };
  EXPECT_THROW(solver.integrate(rates, jacobian, 2, y, {1e-6, onesOfThree}), NumericsError);
  EXPECT_NEAR(y[0], 1.5, 1e-6);  // as far as it came
  std::vector<double> nan{1};
  EXPECT_THROW(solver.integrate([](std::span<const double>, std::span<double> f) { f[0] = std::nan(""); }, jacobian, 1,
                                nan, {1e-6, onesOfThree}),
               NumericsError);
  EXPECT_EQ(nan[0], 1);
}

}  // namespace
}  // namespace lampblack::numerics
