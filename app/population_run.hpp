// `problem: population_balance`: methods of the population balance, repeated and compared.
#pragma once

#include <mpi.h>

#include <string>

#include "app/recorded_run.hpp"
#include "io/deck.hpp"

namespace lampblack {

// Collective; see Problem.
std::string checkPopulation(MPI_Comm comm, const Deck& deck);
void runPopulationBalance(MPI_Comm comm, const Deck& deck, const RunOptions& options);

}  // namespace lampblack
