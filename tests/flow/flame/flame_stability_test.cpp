// Which solutions last, what is done about those that do not, and flames that their own start does not light.
#include "flow/flame/flame_stability.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_continuation.hpp"
#include "flow/flame/flame_from_lower_load.hpp"
#include "flow/flame/flame_state.hpp"
#include "tests/flow/flame/steady_hydrogen.hpp"

namespace lampblack::flow {
namespace {

std::unique_ptr<FlameEquations> equationsAt(const FlameProblem& problem, const FlameProfile& profile) {
  auto equations = std::make_unique<FlameEquations>(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations->setGrid(profile.z);
  equations->setLoad(profile.global(load));
  std::vector<double> F(profile.size());
  equations->residual(profile.x, F);
  return equations;
}

std::optional<GrowingMode> modeOf(const FlameProblem& problem, const FlameProfile& profile) {
  return growingMode(*equationsAt(problem, profile), profile.x);
}

std::optional<GrowingMode> singleModeOf(const FlameProblem& problem, const FlameProfile& profile) {
  return singleGrowingMode(*equationsAt(problem, profile), profile.x);
}

FlameProblem fasterBy(FlameProblem problem, double factor) {
  problem.left.massFlux *= factor;
  problem.right->massFlux *= factor;
  return problem;
}

// Diluted hydrogen against air, 1 m/s on both sides.
FlameProblem diluted(double atmospheres) {
  FlameProblem problem;
  problem.type = FlameType::Counterflow;
  problem.length = 0.01;
  problem.pressure = atmospheres * 101325;
  problem.left = hydrogenStream("H2: 0.25, N2: 0.75", 300, 1);
  problem.right = hydrogenStream("O2: 0.21, N2: 0.79", 300, 1);
  const Thermo thermo(*hydrogenMechanism());
  for (FlameStream* stream : {&problem.left, &*problem.right})
    stream->massFlux = thermo.density(stream->temperature, problem.pressure, stream->Y);  // 1 m/s
  return problem;
}

FlameSolution solved(const FlameProblem& problem, bool preferStable) {
  FlameSolverOptions options;
  options.preferStable = preferStable;
  FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, options);
  return solver.solve(initialFlame(*hydrogenMechanism(), problem, 0));
}

// The load changes by 0.02 % between the points on both sides of the turn, whose parabola knows it better than that.
TEST(FlameStability, AModeGrowsBehindTheTurningPointAndNoneBeforeIt) {
  const FlameProblem problem = fasterBy(hydrogenProblem(FlameType::Counterflow), 60);
  FlameContinuationOptions options;
  options.grid = coarseGrid();
  options.grid.prune = 0.02;
  options.continuation.largestStep = options.continuation.firstStep = 300;
  options.lowestPeakTemperature = 1270;
  std::vector<FlameProfile> profiles;
  const FlameBranch branch =
      followFlame(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, steadyHydrogen(problem), options,
                  [&](const FlameBranchPoint&, const FlameProfile& profile) { profiles.push_back(profile); });
  ASSERT_EQ(branch.turningPoints.size(), 1u) << branch.reason;
  const std::size_t turn = branch.turningPoints.front().index;
  ASSERT_GT(turn, 20u);
  ASSERT_GT(profiles.size(), turn + 6);
  for (std::size_t i = turn - 20; i < turn; ++i) {
    EXPECT_FALSE(modeOf(problem, profiles[i])) << i - turn;
    EXPECT_FALSE(singleModeOf(problem, profiles[i])) << i - turn;
  }
  double rate = 0;
  for (std::size_t i = turn + 1; i < profiles.size(); ++i) {
    const auto mode = modeOf(problem, profiles[i]);
    ASSERT_TRUE(mode) << i - turn;
    EXPECT_GT(mode->rate, rate) << i - turn;  // it passes through zero at the turn
    rate = mode->rate;
    // Either way of the two is within a tenth of its own rate; there is but one mode.
    const auto single = singleModeOf(problem, profiles[i]);
    ASSERT_TRUE(single) << i - turn;
    EXPECT_NEAR(single->rate / rate, 1, 0.2) << i - turn;
  }

  // The mode is one: residuals beside the solution grow with it. Transport coefficients change along with the
  // temperature there, which the matrix leaves out: some per cent.
  const FlameProfile& last = profiles.back();
  const GrowingMode mode = modeOf(problem, last).value();
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations.setGrid(last.z);
  equations.setLoad(last.global(load));
  std::vector<double> ahead = last.x, behind = last.x, F(last.size()), back(last.size()), M(last.size());
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    ahead[i] += 0.05 * mode.direction[i];
    behind[i] -= 0.05 * mode.direction[i];
  }
  equations.residual(ahead, F);
  equations.residual(behind, back);
  equations.timeWeights(last.x, M);
  double product = 0, square = 0;
  for (std::size_t i = 0; i < last.points(); ++i) {
    const std::size_t u = i * last.layout.width() + FlameLayout::temperature;
    const double stored = M[u] * mode.direction[u];
    product -= stored * (F[u] - back[u]) / 0.1;
    square += stored * stored;
  }
  EXPECT_NEAR(product / square / mode.rate, 1, 0.2);
}

TEST(FlameStability, FlamesOfEveryTypeLast) {
  for (const FlameType type : {FlameType::Free, FlameType::Burner, FlameType::Wall, FlameType::Counterflow}) {
    const FlameSolution solution = solved(hydrogenProblem(type), true);
    EXPECT_FALSE(solution.growthRate) << static_cast<int>(type);
    EXPECT_EQ(stateOf(*hydrogenMechanism(), hydrogenProblem(type), solution), FlameState::Burning);
  }
}

// At 32 atm Newton's method finds a solution of 1394 K in which two modes grow: the sign of the determinant is that of
// the stable flame of 1805 K.
TEST(FlameStability, AnUnstableSolutionIsLeftForTheFlameThatLasts) {
  const FlameProblem problem = diluted(32);
  const FlameSolution unstable = solved(problem, false);
  ASSERT_LT(unstable.profile.peakTemperature(), 1500);
  const auto mode = modeOf(problem, unstable.profile);
  ASSERT_TRUE(mode);
  EXPECT_GT(mode->rate, 1e3);
  FlameSolution named = unstable;
  named.growthRate = mode->rate;
  EXPECT_EQ(stateOf(*hydrogenMechanism(), problem, named), FlameState::UnstableBranch);

  const FlameSolution stable = solved(problem, true);
  EXPECT_NEAR(stable.profile.peakTemperature(), 1805, 5);
  EXPECT_FALSE(stable.growthRate);
}

// The Newton matrix of a time step of 10 us decays everywhere.
TEST(FlameStability, FactorsOfATimeStepAreNotTakenForSteadyOnes) {
  const FlameProblem problem = diluted(32);
  const FlameProfile unstable = solved(problem, false).profile;
  const GrowingMode mode = modeOf(problem, unstable).value();
  const auto equations = equationsAt(problem, unstable);
  EXPECT_FALSE(equations->hasSteadyFactors());
  ASSERT_TRUE(equations->factorise(unstable.x, 0));
  EXPECT_TRUE(equations->hasSteadyFactors());
  EXPECT_EQ(growingMode(*equations, unstable.x, true).value().rate, mode.rate);
  ASSERT_TRUE(equations->factorise(unstable.x, 1e5));
  EXPECT_FALSE(equations->hasSteadyFactors());
  EXPECT_EQ(growingMode(*equations, unstable.x, true).value().rate, mode.rate);
}

TEST(FlameFromLowerLoad, BurnsWhereItsOwnStartGoesOut) {
  const FlameProblem problem = diluted(2);
  const FlameSolution own = solved(problem, true);
  ASSERT_EQ(stateOf(*hydrogenMechanism(), problem, own), FlameState::Out);
  const RaisedFlame raised = flameFromLowerLoad(MPI_COMM_WORLD, hydrogenMechanism(), problem, {}, {});
  ASSERT_TRUE(raised.profile);
  EXPECT_FALSE(raised.extinctionLoad);
  FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, {});
  EXPECT_GT(solver.solve(*raised.profile).profile.peakTemperature(), 1500);
}

// The same strain, as a part of two loads; the branch is found on its way to either.
TEST(FlameFromLowerLoad, KnowsWhereTheBranchEnds) {
  std::vector<double> strain;
  for (const double factor : {150.0, 400.0}) {
    const FlameProblem problem = fasterBy(hydrogenProblem(FlameType::Counterflow), factor);
    FlameSolverOptions options;
    options.grid = coarseGrid();
    const RaisedFlame raised = flameFromLowerLoad(MPI_COMM_WORLD, hydrogenMechanism(), problem, options, {});
    EXPECT_FALSE(raised.profile);
    ASSERT_TRUE(raised.extinctionLoad);
    strain.push_back(*raised.extinctionLoad * factor);
  }
  EXPECT_NEAR(strain[0] / strain[1], 1, 0.02);
  EXPECT_NEAR(strain[0], 89.8, 2);  // of the whole branch from a load of 1
}

TEST(FlameState, StreamsThatCannotBurnAreInert) {
  FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  InitialFlameOptions cold;
  cold.cold = true;
  FlameSolution solution;
  solution.profile = initialFlame(*hydrogenMechanism(), problem, 0, cold);
  EXPECT_EQ(stateOf(*hydrogenMechanism(), problem, solution), FlameState::Out);
  problem.right = hydrogenStream("N2: 1", 300, 0.6);
  solution.profile = initialFlame(*hydrogenMechanism(), problem, 0, cold);
  EXPECT_EQ(stateOf(*hydrogenMechanism(), problem, solution), FlameState::Inert);
}

}  // namespace
}  // namespace lampblack::flow
