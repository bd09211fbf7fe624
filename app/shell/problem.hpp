// What a deck may be about. Each `problem:` is one entry of a table: its keys, and how a run of it is prepared. The
// commands and the reference page are made from this table; a new problem is a new entry.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct Problem {
  std::string name;  // as in `problem: flow`
  std::string doc;   // one line for the reference page
  DeckSchema (*schema)();
  // Collective. Reads everything the deck names and makes all that is there before the first step; the deck has to live
  // as long. InputError, NumericsError.
  std::unique_ptr<PreparedRun> (*prepare)(MPI_Comm, const Deck&);
  bool restarts = false;  // whether its runs write checkpoints and can be restarted from them
};

const std::vector<Problem>& problems();

// The problems' decks as the deck reader wants them.
DeckKinds deckKinds(const std::vector<Problem>& table = problems());

// The problem of a deck that was read with deckKinds() of the same table.
const Problem& problemOf(const Deck& deck, const std::vector<Problem>& table = problems());

}  // namespace lampblack::app
