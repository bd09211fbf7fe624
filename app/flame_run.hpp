// Checks and runs a deck with `problem: flame1d`.
#pragma once

#include <mpi.h>

#include <string>

#include "app/recorded_run.hpp"
#include "io/deck.hpp"

namespace lampblack {

// Collective. The size of the case in words. InputError.
std::string checkFlame(MPI_Comm comm, const Deck& deck);

// Collective. InputError; NumericsError where the flame does not converge: results.h5.part then holds its last grid and
// profile, from which another run can start.
void runFlame(MPI_Comm comm, const Deck& deck, const RunOptions& options);

}  // namespace lampblack
