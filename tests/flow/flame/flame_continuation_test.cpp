// Branches of counterflow flames over the load.
#include "flow/flame/flame_continuation.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "tests/flow/flame/steady_hydrogen.hpp"

namespace lampblack::flow {
namespace {

GridOptions coarse() {
  GridOptions grid = coarseGrid();
  grid.prune = 0.02;
  return grid;
}

// Newton and time steps from a profile at a fixed load.
double steadyPeakAt(const FlameProblem& problem, FlameProfile profile, double value) {
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations.setGrid(profile.z);
  equations.setLoad(value);
  const NewtonReport report = NewtonSolver().steady(equations, profile.x);
  EXPECT_TRUE(report.converged) << report.reason;
  return profile.peakTemperature();
}

TEST(FlameContinuation, AHydrogenFlameGoesOutAtATurningPoint) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  const FlameProfile start = steadyHydrogen(problem, coarse());
  FlameContinuationOptions options;
  options.grid = coarse();
  options.maximumTurningPoints = 1;
  std::vector<FlameProfile> profiles;
  const FlameBranch branch =
      followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, start, options,
                  [&](const FlameBranchPoint&, const FlameProfile& profile) { profiles.push_back(profile); });
  ASSERT_TRUE(branch.complete) << branch.reason;
  ASSERT_EQ(branch.turningPoints.size(), 1u);
  const TurningPoint& out = branch.turningPoints.front();
  EXPECT_TRUE(out.highest);
  EXPECT_GT(out.load, 10);  // far from the start
  // Round the turn the flame keeps getting colder.
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    EXPECT_LT(branch.points[i].peakTemperature, branch.points[i - 1].peakTemperature);
  ASSERT_GT(profiles.size(), 6u);
  const FlameProfile& before = profiles[out.index - 1];
  // The flame burns just below this load, from a profile nearby, and goes out above it, where there is no other
  // solution than cold mixing (streams of 300 K). The steps next to the turn are a few per cent of the load.
  EXPECT_GT(steadyPeakAt(problem, before, 0.97 * out.load), 1200);
  EXPECT_LT(steadyPeakAt(problem, before, 1.03 * out.load), 400);

  // Shorter steps find the same turning point: the parabola's error is far below the distance between points.
  options.continuation.largestStep = 2000;
  options.continuation.firstStep = 2000;
  const FlameBranch fine = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, before, options);
  ASSERT_EQ(fine.turningPoints.size(), 1u) << fine.reason;
  EXPECT_NEAR(fine.turningPoints.front().load / out.load, 1, 0.01);
}

TEST(FlameContinuation, EndsWhereAskedTo) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  const FlameProfile start = steadyHydrogen(problem, coarse());
  FlameContinuationOptions options;
  options.grid = coarse();
  options.highestLoad = 1.2;
  FlameBranch branch = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, start, options);
  EXPECT_TRUE(branch.complete);
  EXPECT_GT(branch.points.back().load, 1.2);
  EXPECT_LE(branch.points[branch.points.size() - 2].load, 1.2);
  EXPECT_EQ(branch.last.global(load), branch.points.back().load);

  options.continuation.towardsHigherLoad = false;
  options.lowestLoad = 0.9;
  branch = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, start, options);
  EXPECT_TRUE(branch.complete);
  EXPECT_LT(branch.points.back().load, 0.9);

  options = {};
  options.lowestPeakTemperature = 2040;
  branch = followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, start, options);
  EXPECT_TRUE(branch.complete);
  EXPECT_LT(branch.points.back().peakTemperature, 2040);
}

TEST(FlameContinuation, AFreeFlameHasNoStrain) {
  const FlameProblem problem = hydrogenProblem(FlameType::Free);
  EXPECT_THROW(followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, roughFlame(problem, 12), {}),
               InputError);
}

}  // namespace
}  // namespace lampblack::flow
