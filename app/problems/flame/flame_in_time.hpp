// A flame deck with a section `unsteady`: the flame in time, its history and its profiles at the output times.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "app/problems/flame/flame_case.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_profile.hpp"
#include "io/history.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

struct FlameInTime {
  std::vector<double> times;           // s, of the profiles
  std::vector<FlameProfile> profiles;  // on one grid
  UnsteadyReport report;
  std::string failure;  // why it went no further; empty where it came to the end
};

// Collective. From `start`, which becomes the last state; rows of the history are written on the way.
FlameInTime flameInTime(MPI_Comm comm, FlameCase& flame, FlameProfile& start, HistoryWriter& history);

// Columns of the history.
std::vector<Quantity> flameHistoryColumns(const FlameCase& flame);

// Collective: /unsteady.
void writeFlameInTime(ResultsWriter& results, const FlameCase& flame, const FlameInTime& course);

}  // namespace lampblack::app
