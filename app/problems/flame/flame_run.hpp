// Runs of a deck with `problem: flame1d`.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Prepared is the first guess. A run whose flame does not converge throws NumericsError;
// results.h5.part then holds its last grid and profile, from which another run can start.
std::unique_ptr<PreparedRun> prepareFlame(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
