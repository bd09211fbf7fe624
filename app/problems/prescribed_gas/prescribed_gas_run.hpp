// Runs of a deck with `problem: prescribed_gas`.
#pragma once

#include <mpi.h>

#include <memory>

#include "app/run/prepared_run.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Collective; see Problem. Repeats of an ensemble are spread over the ranks; a model runs on the first.
std::unique_ptr<PreparedRun> preparePrescribedGas(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
