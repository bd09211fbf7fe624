// Runs of a deck with `problem: reactor`.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. A reactor has one cell: rank 0 computes, the others wait.
std::unique_ptr<PreparedRun> prepareReactor(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
