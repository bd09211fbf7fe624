// Shipped decks at the ends of their ranges, from the streams alone.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/problems/flame/flame_case.hpp"
#include "app/shell/problem.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_fields.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/flame_state.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

// Of the series over the strain in chapter 7 of Wang (2025) the flame of the fastest streams, 34.9 cm/s. In
// the study it starts from its neighbour.
TEST(ShippedFlame, TheMostStrainedSootingFlameConvergesFromItsStreams) {
  const std::string path = test::sourcePath("cases/flame1d/counterflow_ethylene_soot/deck.yaml");
  FlameCase flame = readFlameCase(
      Deck::load(path, {"left.velocity=34.9 cm/s", "right.velocity=34.9 cm/s"}, deckKinds(), MPI_COMM_WORLD));
  ASSERT_NE(flame.soot, nullptr);
  FlameSolver solver(MPI_COMM_WORLD, flame.mechanism, flame.problem, flame.soot.get(), flame.solver);
  const FlameSolution solution =
      solver.solve(initialFlame(*flame.mechanism, flame.problem, flame.scalarNames().size(), flame.start));
  for (const FlameStage& stage : solution.stages) EXPECT_TRUE(stage.newton.converged) << stage.name;
  // A solution of all equations, which conserves.
  for (const FlameBudget& budget : solution.budgets)
    EXPECT_LE(std::abs(budget.imbalance()), 1e-8 * (std::abs(budget.in) + std::abs(budget.out) + std::abs(budget.wall)))
        << budget.name;
  const FlameSummary summary =
      flameSummary(flame.problem, solution.profile, flameFields(*flame.mechanism, flame.problem, solution.profile));
  ASSERT_TRUE(summary.strain && summary.strain->global);
  EXPECT_NEAR(*summary.strain->global, 173, 0.5);  // as Wang (2025) rounds it
  EXPECT_GT(summary.maximumTemperature, 2000);     // it burns
}

// Methane against air at global strain rates near extinction, where Newton's method finds solutions between the turning
// points (1760.5 and 1763.9 K).
TEST(ShippedFlame, StrainedMethaneEndsOnTheStableBranch) {
  const std::string path = test::sourcePath("cases/flame1d/counterflow_methane/deck.yaml");
  for (const auto& [strain, peak] : {std::pair{530.0, 1815.6}, {532.0, 1812.4}}) {
    const std::string left = std::to_string(0.3352566974612946 * strain / 50), right = std::to_string(strain / 200);
    const FlameCase flame = readFlameCase(Deck::load(
        path, {"left.velocity=" + left + " m/s", "right.velocity=" + right + " m/s"}, deckKinds(), MPI_COMM_WORLD));
    FlameSolver solver(MPI_COMM_WORLD, flame.mechanism, flame.problem, nullptr, flame.solver);
    const FlameSolution solution = solver.solve(initialFlame(*flame.mechanism, flame.problem, 0, flame.start));
    EXPECT_EQ(stateOf(*flame.mechanism, flame.problem, solution), FlameState::Burning) << strain;
    EXPECT_NEAR(solution.profile.peakTemperature(), peak, 2) << strain;
  }
}

}  // namespace
}  // namespace lampblack::app
