// Runs of a deck with `problem: pah`: molecules that grow, each by itself.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Molecules are spread over the ranks.
std::unique_ptr<PreparedRun> preparePah(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
