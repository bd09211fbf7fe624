// Checks and runs a deck with `problem: reactor`.
#pragma once

#include <mpi.h>

#include <string>

#include "app/recorded_run.hpp"
#include "io/deck.hpp"

namespace lampblack {

// Collective. The size of the case in words. InputError.
std::string checkReactor(MPI_Comm comm, const Deck& deck);

// Collective. A reactor has one cell: rank 0 computes, the others wait. InputError, NumericsError as they come; the run
// folder then says so.
void runReactor(MPI_Comm comm, const Deck& deck, const RunOptions& options);

}  // namespace lampblack
