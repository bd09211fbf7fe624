// What moves the gas in one sweep of a step: the same for the velocities in the mesh's plane and about its axis.
#pragma once

#include <span>

#include "core/modules.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// Velocities stand at the middles of the gas's steps (Pierce and Moin 2004), so that what moves them - density,
// viscosity, pressure - is that of the time between two of them.
struct MomentumSweep {
  const State& start;  // density; velocity before the step
  const State& mean;   // velocity and mass flux: means of `start` and of what the last sweep found
  // Pa s, effective, of `start`: of the cells, and of the gas between each boundary face and its cell.
  std::span<const double> viscosity, boundaryViscosity;
  std::span<const double> divergence;  // 1/s, owned cells: what the face velocities are to have
  double dt = 0.0;                     // s, from one velocity to the next
};

}  // namespace lampblack::flow
