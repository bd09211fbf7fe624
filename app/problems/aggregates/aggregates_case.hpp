// What a deck with `problem: aggregates` asks for: spheres, how they become aggregates, the gas around them, how often,
// and what is written.
#pragma once

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/aggregates/aggregates_case.hpp"

namespace lampblack::app {

// All keys such a deck may have.
DeckSchema aggregatesSchema();

// InputError, pointing into the deck.
AggregatesCase readAggregatesCase(const Deck& deck);

}  // namespace lampblack::app
