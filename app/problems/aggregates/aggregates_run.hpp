// Runs of a deck with `problem: aggregates`: aggregates of overlapping spheres in space.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Repeats are spread over the ranks.
std::unique_ptr<PreparedRun> prepareAggregates(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
