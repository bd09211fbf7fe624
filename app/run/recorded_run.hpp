// What every run has in common, whatever its problem: a folder, a run record that says "running" while it goes on and
// afterwards how it ended, and what it was made from.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"
#include "io/run_record.hpp"

namespace lampblack::app {

struct RunOptions {
  std::filesystem::path folder;  // results go here
  bool force = false;            // replace an earlier run in `folder`
  std::vector<std::string> overrides;
  // Go on from this checkpoint, or where the name is empty from the newest one in `folder`.
  std::optional<std::filesystem::path> restart = {};
};

// The part of a run that is its own: computes, writes its results, and completes the record (steps, stages, results).
using RunWork = std::function<void(const RunFolder& folder, const RunInfo& info, RunRecord& record)>;

// Collective. Makes the folder (InputError where it holds a run already) and does the work in it. What the work throws
// is recorded and passed on.
void recordedRun(MPI_Comm comm, const Deck& deck, const RunOptions& options, std::uint64_t seed, const RunWork& work);

// Memory in use at its peak by the rank that used most, in bytes. Collective.
double peakMemory(MPI_Comm comm);

}  // namespace lampblack::app
