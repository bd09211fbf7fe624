// `problem: population_balance`: methods of the population balance, repeated and compared.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Prepared are a solver of every method, for its own checks, and the exact solution.
std::unique_ptr<PreparedRun> preparePopulation(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
