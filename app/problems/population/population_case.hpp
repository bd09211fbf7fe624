// What a deck with `problem: population_balance` asks for, checked and in SI: the bridge from the words of the deck to
// the processes and the methods.
#pragma once

#include <mpi.h>

#include <memory>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/population/comparison/population_case.hpp"

namespace lampblack::app {

class PreparedRun;

// All keys such a deck may have.
DeckSchema populationSchema();

// Checks what the schema cannot; InputError otherwise. A solver of every method is made once, for its own checks.
PopulationCase readPopulationCase(const Deck& deck);

// Collective; see Problem. Prepared are a solver of every method, for its own checks, and the exact solution.
std::unique_ptr<PreparedRun> preparePopulation(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
