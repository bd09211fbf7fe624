// How a flame is solved, as a deck says it: the sections grid, solver, continuation and unsteady, and the key initial.
#pragma once

#include "app/problems/flame/flame_case.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

void addFlameSolverKeys(DeckSchema& schema);
// Of a flame whose streams have been read; not the flame of `initial`. InputError, pointing into the deck.
void readFlameSolver(const Deck& deck, FlameCase& flame);

}  // namespace lampblack::app
