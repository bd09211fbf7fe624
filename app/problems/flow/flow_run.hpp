// Runs of a deck with `problem: flow`.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Prepared are the mesh, the operators and the state at the start.
std::unique_ptr<PreparedRun> prepareFlow(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
