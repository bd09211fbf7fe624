// What a deck with `problem: aggregates` asks for: spheres, how they become aggregates, the gas around them, how often,
// and what is written.
#pragma once

#include <mpi.h>

#include <memory>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/aggregates/aggregates_case.hpp"

namespace lampblack::app {

class PreparedRun;

// All keys such a deck may have.
DeckSchema aggregatesSchema();

// InputError, pointing into the deck.
AggregatesCase readAggregatesCase(const Deck& deck);

// Collective; see Problem. Repeats are spread over the ranks.
std::unique_ptr<PreparedRun> prepareAggregates(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
