// No rank holds anything of a flow as a whole: rank 3 has a corner of a few cells. What it takes from memory at once
// stays below one byte for each cell of the mesh while a step is made, and below a value for each while paths are
// traced, for which ranks share out the vertices on their borders.
#include <gtest/gtest.h>

#include "flow/paths/streamline.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/corner_mesh.hpp"
#include "tests/watched_memory.hpp"

namespace lampblack::test {
namespace {

void expectOnlyItsShare(const Mesh& mesh, std::size_t taken, std::size_t perCell) {
  const std::size_t bound = perCell * static_cast<std::size_t>(mesh.totalCells);
  if (worldRank() == smallRank) {
    EXPECT_LT(mesh.cells, mesh.totalCells / 300);
    EXPECT_LT(taken, bound);
  } else {
    EXPECT_GE(taken, bound);  // ranks that have a third of the cells: the watch works
  }
}

TEST(FlowMemory, AStepAndPathsTakeNothingOfTheSizeOfTheMesh) {
  ASSERT_EQ(worldSize(), smallRank + 1);
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 0.2, N2: 0.8");
  CornerMesh made = cornerMesh(2, 200);
  const Mesh mesh(MPI_COMM_WORLD, std::move(made.block), Geometry::Planar, {.weight = made.weight});
  HaloExchange halo(mesh);
  BoundaryCondition wall = side(BoundaryKind::Wall, 0, false).condition;
  wall.temperature = 350.0;
  const FlowContext context{mesh,       halo,          gas.mechanism,
                            gas.thermo, gas.transport, std::vector(mesh.patches.size(), wall)};
  std::optional<State> state;
  std::optional<TransportOperator> transport;
  const std::size_t ofStep = largestTaken([&] {
    state.emplace(mesh, air.size(), std::vector<ScalarBlock>{});
    for (int c = 0; c < mesh.cells; ++c) {
      const auto& Y = mesh.centre[at(c)][0] < 0.5 ? air : fuel;
      state->velocity[at(2 * c)] = 0.1 * mesh.centre[at(c)][1];
      state->temperature[at(c)] = 300.0 + 100.0 * mesh.centre[at(c)][0];
      state->density[at(c)] = gas.thermo.density(state->temperature[at(c)], state->thermodynamicPressure, Y);
      state->enthalpy[at(c)] = gas.thermo.enthalpyMass(state->temperature[at(c)], Y);
      std::copy(Y.begin(), Y.end(), state->Y.begin() + c * static_cast<std::ptrdiff_t>(Y.size()));
    }
    transport.emplace(context, *state, TransportOperator::Options{0.5, 2});
    transport->initialise(*state, 1e-4);
    for (int sweep = 0; sweep < 2; ++sweep) transport->advance(*state, 0.0, 1e-4);
  });
  expectOnlyItsShare(mesh, ofStep, 1);
  const std::size_t ofPaths = largestTaken([&] {
    const Streamlines lines(context, *state, transport->properties(), 0.5);
    const std::vector<Vector3> starts{{0.2, 0.2, 0.0}, {0.99, 0.01, 0.0}};
    static_cast<void>(lines.trace(starts, 1e-3, 0.1));
  });
  expectOnlyItsShare(mesh, ofPaths, sizeof(double));
}

}  // namespace
}  // namespace lampblack::test
