// A burning flame for streams whose own start goes out: at a part of their velocities and strain (the load) flames
// burn more easily, and from there the load is raised in steps, at last along the branch of flames. Either a flame
// arrives at the load asked for, or the branch turns before: then it is known that the flame is out.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/modules.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"

namespace lampblack::flow {

struct RaisedFlame {
  std::optional<FlameProfile> profile;   // of the gas alone, burning at the load of the problem (1)
  std::optional<double> extinctionLoad;  // below 1, where the branch of burning flames turns
};

// Collective. Neither is given where no start burns, or where the branch is lost on its way. `report` sees the load and
// the peak temperature (K) of every flame on the way, `tries` the load of every flame that is about to be solved, on
// all ranks. Not for free flames (std::logic_error).
[[nodiscard]] RaisedFlame flameFromLowerLoad(MPI_Comm comm, const std::shared_ptr<const Mechanism>& mechanism,
                                             const FlameProblem& problem, const FlameSolverOptions& options,
                                             const InitialFlameOptions& start,
                                             const std::function<void(double load, double peak)>& report = {},
                                             const std::function<void(double load)>& tries = {});

}  // namespace lampblack::flow
