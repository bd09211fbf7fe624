// Steady hydrogen flames that other tests begin with.
#pragma once

#include <mpi.h>

#include "core/modules.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::flow {

inline GridOptions coarseGrid() {
  GridOptions grid;
  grid.slope = 0.2;
  grid.curve = 0.3;
  return grid;
}

inline FlameProfile steadyHydrogen(const FlameProblem& problem, const GridOptions& grid = coarseGrid()) {
  FlameSolverOptions options;
  options.grid = grid;
  FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, options);
  return solver.solve(initialFlame(*hydrogenMechanism(), problem, 0)).profile;
}

}  // namespace lampblack::flow
