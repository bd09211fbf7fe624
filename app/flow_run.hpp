// Checks and runs a deck with `problem: flow`.
#pragma once

#include <mpi.h>

#include <string>

#include "app/recorded_run.hpp"
#include "io/deck.hpp"

namespace lampblack {

// Collective. The size of the case in words. InputError.
std::string checkFlow(MPI_Comm comm, const Deck& deck);

// Collective. From start to report. InputError, NumericsError as they come; the run folder then says so.
void runFlow(MPI_Comm comm, const Deck& deck, const RunOptions& options);

}  // namespace lampblack
