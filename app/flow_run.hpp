// Runs a deck with `problem: flow` from start to report.
#pragma once

#include <mpi.h>

#include <filesystem>

#include "io/deck.hpp"

namespace lampblack {

struct RunOptions {
  std::filesystem::path folder;  // results go here
  bool force = false;            // replace an earlier run in `folder`
  std::vector<std::string> overrides;
};

// Collective. InputError, NumericsError as they come; the run folder then says so.
void runFlow(MPI_Comm comm, const Deck& deck, const RunOptions& options);

}  // namespace lampblack
