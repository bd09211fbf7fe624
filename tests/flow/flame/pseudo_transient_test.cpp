// Pseudo-transient steps where Newton's method alone does not converge.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <vector>

#include "core/modules.hpp"
#include "numerics/newton_solver.hpp"
#include "tests/numerics/small_systems.hpp"

namespace lampblack::flow {
namespace {

using test::scalar;
using test::SmallSystem;

// From the right a minimum of the residual lies in the way (at sqrt(2/3)), at which Newton's method gets stuck, damped
// or not; dx/dt = -F passes it. The second unknown follows the first within 1e-9 s: stiff.
SmallSystem hill() {
  return {2,
          [](auto x, auto F) {
            F[0] = x[0] * x[0] * x[0] - 2 * x[0] + 2;
            F[1] = 1e9 * (x[1] - x[0]);
          },
          [](auto x, std::vector<double>& J) {
            J = {3 * x[0] * x[0] - 2, 0, -1e9, 1e9};
          }};
}

TEST(PseudoTransient, ConvergesWhereNewtonAloneDoesNot) {
  SmallSystem system = hill();
  std::vector<double> x = {1, 1};
  const NewtonReport alone = NewtonSolver().newton(system, x);
  EXPECT_FALSE(alone.converged);
  EXPECT_FALSE(alone.reason.empty());

  x = {1, 1};
  const NewtonReport report = NewtonSolver().steady(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_GT(report.timeSteps, 0u);
  // The real root of x^3 - 2x + 2 (Cardano).
  EXPECT_NEAR(x[0], -1.7692923542386314, 1e-7);
  EXPECT_NEAR(x[1], x[0], 1e-7);
}

TEST(PseudoTransient, ATimeStepIsOneOfImplicitEuler) {
  SmallSystem system = scalar([](double x) { return x * x; }, [](double x) { return 2 * x; });
  NewtonOptions options;
  PseudoTransientOptions transient;
  transient.stepTolerance = 1e-8;
  NewtonReport report;
  std::vector<double> x = {1};
  EXPECT_TRUE(NewtonSolver(options, transient).timeStep(system, x, 2, report)) << report.reason;
  EXPECT_NEAR(x[0], 0.5, 1e-11);  // x^2 + (x - 1)/2 = 0
  EXPECT_EQ(report.timeSteps, 1u);
}

TEST(PseudoTransient, AlgebraicEquationsHaveNoTimeDerivative) {
  SmallSystem system = hill();
  system.weights[1] = 0;
  std::vector<double> x = {1, 0};
  const NewtonReport report = NewtonSolver().steady(system, x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x[0], -1.7692923542386314, 1e-7);
}

TEST(PseudoTransient, WithoutASolutionItEndsAndNamesTheWorstUnknown) {
  SmallSystem system(
      4,
      [](auto x, auto F) {
        for (std::size_t i = 0; i < 4; ++i) F[i] = x[i] - 1;
        F[2] = 1 + x[2] * x[2];
      },
      [](auto x, std::vector<double>& J) {
        for (std::size_t i = 0; i < 4; ++i) J[i * 4 + i] = i == 2 ? 2 * x[2] : 1;
      });
  std::vector<double> x(4, 0.3);
  const NewtonReport report = NewtonSolver().steady(system, x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.worst, "x2");
  EXPECT_FALSE(report.reason.empty());
  EXPECT_GT(report.timeSteps, 0u);
  for (const double value : x) EXPECT_TRUE(std::isfinite(value));
}

// Each rank computes a part of the residual; all see the same vectors and take the same way.
TEST(PseudoTransient, RanksTakeTheSameWay) {
  const std::size_t n = 24;
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto equations = [&](std::span<const double> u, std::span<double> F) {
    std::vector<double> all(n);
    test::bratuResidual(u, n, 2, all);
    for (std::size_t i = 0; i < n; ++i)
      if (static_cast<int>(i) % ranks != rank) all[i] = 0;
    MPI_Allreduce(all.data(), F.data(), static_cast<int>(n), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  };
  SmallSystem system(n, equations, [&](auto u, std::vector<double>& J) { test::bratuMatrix(u, n, 2, n, J); });
  NewtonOptions options;
  options.maximumSteps = 2;  // too few from here: time steps have to help
  PseudoTransientOptions transient;
  transient.firstStep = 1e-3;
  std::vector<double> u(n, -3.0);
  const NewtonReport report = NewtonSolver(options, transient).steady(system, u);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_GT(report.timeSteps, 0u);

  std::vector<double> first = u;
  first.push_back(static_cast<double>(report.residuals));
  std::vector<double> mine = first;
  MPI_Bcast(first.data(), static_cast<int>(first.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  EXPECT_EQ(mine, first);
  // And the same as on one rank, since sums of one value and zeros are exact.
  SmallSystem alone = test::bratu(n, 2);
  std::vector<double> serial(n, -3.0);
  EXPECT_EQ(NewtonSolver(options, transient).steady(alone, serial).residuals, report.residuals);
  EXPECT_EQ(serial, u);
}

}  // namespace
}  // namespace lampblack::flow
