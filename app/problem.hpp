// What a deck may be about. Each `problem:` is one entry of a table: its keys, how a deck of it is checked, and how it
// is run. The commands and the reference page are made from this table; a new problem is a new entry.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "app/recorded_run.hpp"
#include "io/deck.hpp"

namespace lampblack {

struct Problem {
  std::string name;  // as in `problem: flow`
  std::string doc;   // one line for the reference page
  DeckSchema (*schema)();
  // Collective. Reads everything the deck names; says in a few words what is there ("47 species, ..."). InputError.
  std::string (*check)(MPI_Comm, const Deck&);
  // Collective. InputError, NumericsError as they come; the run folder then says so.
  void (*run)(MPI_Comm, const Deck&, const RunOptions&);
};

const std::vector<Problem>& problems();

// The problems' decks as the deck reader wants them.
DeckKinds deckKinds();

// The problem of a deck that was read with deckKinds().
const Problem& problemOf(const Deck& deck);

}  // namespace lampblack
