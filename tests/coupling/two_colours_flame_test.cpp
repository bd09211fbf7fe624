// A kind of particles that no place knows (two_colours.hpp) in a one-dimensional flame whose equations are solved, both
// ways: the gas has lost in the end what the particles have gained on their way through it.
#include <gtest/gtest.h>

#include <memory>

#include "coupling/flame_coupling.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/coupling/two_colours.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::test {
namespace {

// Hot acetylene in a gas that does not react, from a burner.
TEST(TwoColoursInAFlame, TakeFromItsGasWhatTheyGain) {
  const auto mechanism = std::make_shared<const Mechanism>(shippedMechanism("perfect_gas_soot_9.yaml"));
  FlameProblem problem;
  problem.type = FlameType::Burner;
  problem.length = 0.01;
  problem.left = streamAt(*mechanism, "GAS: 0.98, C2H2: 0.02", 1500, 0.5);
  FlameSolver solver(MPI_COMM_WORLD, mechanism, problem, nullptr, {});
  FlameCouplingOptions options;
  options.ensemble.make = [&](std::uint64_t) { return TwoColours::some(*mechanism, 2e-15); };
  options.ensemble.repeats = 2;
  options.ensemble.paths.resize(1);
  options.tolerance = 1e-3;
  const FlameCoupling coupling = coupleFlame(MPI_COMM_WORLD, *mechanism, problem.pressure, solver, nullptr,
                                             solver.solve(initialFlame(*mechanism, problem, 0)), options);
  EXPECT_TRUE(coupling.converged);
  const FlamePath& path = coupling.paths[0].path;
  const double gained = coupling.paths[0].content[0] * path.velocity.back() -
                        12.0 * TwoColours::eachNumber * TwoColours::carbonAtStart * path.velocity.front();
  const double offered = problem.left.massFlux * problem.left.Y[mechanism->speciesIndex("C2H2")] * 24.022 / 26.038;
  EXPECT_GT(gained, 0.3 * offered);
  EXPECT_LT(gained, 0.8 * offered);
  for (const FlameBudget& budget : coupling.solution.budgets) {
    const double lost = -budget.given / gained;
    if (budget.name == "C") {
      EXPECT_NEAR(lost, 1.0, 5e-3);
    } else if (budget.name == "H") {
      EXPECT_NEAR(lost, 0.0, 1e-9);
    }
  }
  EXPECT_NEAR(coupling.steps.back().taken[0] / gained, 1.0, 5e-3);
}

}  // namespace
}  // namespace lampblack::test
