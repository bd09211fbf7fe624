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
