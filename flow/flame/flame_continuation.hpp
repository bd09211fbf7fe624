// The S-shaped curve of a flame: solutions of a counterflow, wall or burner flame along a change of its load, round the
// turning points at which it goes out or ignites. The grid follows the flame.
#pragma once

#include <mpi.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_grid.hpp"
#include "numerics/branch_tracer.hpp"

namespace lampblack::flow {

struct FlameContinuationOptions {
  ContinuationOptions continuation;
  GridOptions grid;
  FlameTolerances tolerances;
  std::size_t pointsBetweenGrids = 4;  // of the branch; 0: the grid stays
  // The branch ends with the first point beyond any of these.
  double lowestLoad = 0, highestLoad = std::numeric_limits<double>::infinity();
  double lowestPeakTemperature = 0;  // K
  std::size_t maximumPoints = 200;   // of the branch
  std::size_t maximumTurningPoints = std::numeric_limits<std::size_t>::max();
};

struct FlameBranchPoint {
  double load = 0;             // factor on the strain: strain rates and mass fluxes of the streams are in proportion
  double peakTemperature = 0;  // K
  std::size_t gridPoints = 0;
  NewtonReport newton;
};

struct FlameBranch {
  std::vector<FlameBranchPoint> points;
  std::vector<TurningPoint> turningPoints;
  std::string reason;     // why the branch ends here
  bool complete = false;  // as asked for; false: the next point could not be found
  int stop = 0;           // the signal that asked to stop on the way, or 0
  FlameProfile last;
};

// From a converged flame (FlameSolver) whose load is in its globals. Collective. `onPoint` sees every point, on all
// ranks. InputError for a free flame, whose strain is nothing to change; NumericsError where the start is no solution.
FlameBranch followFlame(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, const FlameProblem& problem,
                        CarriedModel* carried, const FlameProfile& start, const FlameContinuationOptions& options,
                        const std::function<void(const FlameBranchPoint&, const FlameProfile&)>& onPoint = {});

}  // namespace lampblack::flow
