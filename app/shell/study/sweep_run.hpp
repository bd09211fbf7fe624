// Carries out the runs of a study, one after another on all ranks or side by side on groups of them.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/shell/study/sweep_study.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

enum class RunFailure { none, input, numerics, system, bug, stopped };  // from harmless to severe

struct RunOutcome {
  RunFailure failure = RunFailure::none;
  std::string message;   // why it failed
  double seconds = 0.0;  // wall time
  bool isTaken = false;  // was there already; of the ranks of its group
};

struct SweepOptions {
  bool force = false;    // earlier runs are replaced
  bool collect = false;  // nothing is run: what is not finished has failed, by the record that it left
};

// Collective. Reads every deck of the study, so that a mistake in the last one is known before the first is run, and
// makes all that is there before the first step of the first run that can begin. InputError, also where none can.
void checkDecks(MPI_Comm comm, const SweepStudy& study);

// Collective. Runs all of them, each in a folder of its name below `folder`. Where the folder has the finished run of
// the same deck already it is taken as it is; one that was cut short goes on from its newest checkpoint, or begins anew
// where it has none. A run that fails does not keep the others from going on, but a full disk and a signal do: what
// would have followed has their outcome. Same outcomes on every rank. InputError where ranks_per_run does not divide
// the ranks.
std::vector<RunOutcome> runStudy(MPI_Comm comm, const SweepStudy& study, const std::filesystem::path& folder,
                                 const SweepOptions& options);

}  // namespace lampblack::app
