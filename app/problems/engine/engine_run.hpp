// Runs of a deck with `problem: engine`: the stochastic reactor model of an engine.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Several repeats are spread over the ranks; of one the ranks share the reactions.
std::unique_ptr<PreparedRun> prepareEngine(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
