// How the flow of opposed streams converges with the grid.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_grid.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::flow {
namespace {

double pressureGradientOn(std::size_t points) {
  FlameProblem problem;
  problem.type = FlameType::Counterflow;
  problem.length = 0.02;
  problem.left = hydrogenStream("N2: 1", 300, 0.6);
  problem.right = hydrogenStream("O2: 1", 300, 0.4);
  InitialFlameOptions cold;
  cold.cold = true;
  std::vector<double> z;
  for (std::size_t i = 0; i < points; ++i)
    z.push_back(problem.length * static_cast<double>(i) / static_cast<double>(points - 1));
  FlameSolverOptions options;
  options.refine = false;
  options.newton.stepTolerance = 1e-8;
  FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, options);
  return solver.solve(onGrid(initialFlame(*hydrogenMechanism(), problem, 0, cold), z)).profile.global(pressureGradient);
}

// The streams are fast: |m| h over the viscosity is 16 on the coarsest grid and 4 on the finest. A scheme that leans
// upwind there errs by a multiple of the spacing (ratio 2), a central one by its square (ratio 4).
TEST(FlameMomentum, PressureGradientConvergesQuadraticallyAlsoWhereStreamsAreFast) {
  const double coarse = pressureGradientOn(41), middle = pressureGradientOn(81), fine = pressureGradientOn(161);
  EXPECT_GT((coarse - middle) / (middle - fine), 3.4) << coarse << " " << middle << " " << fine;
  EXPECT_LT((coarse - middle) / (middle - fine), 4.6);
  EXPECT_LT(std::abs(middle - fine), 0.01 * std::abs(fine));
}

}  // namespace
}  // namespace lampblack::flow
