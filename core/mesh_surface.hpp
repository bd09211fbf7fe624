// Whether every face of a mesh's surface belongs to a boundary.
#pragma once

#include <mpi.h>

#include "core/cell_set.hpp"

namespace lampblack {

// Collective. `cells`: this rank's share, connected. InputError on all ranks, the same on any number of them, where a
// side has neither a neighbour nor a patch; it says so where another such side lies at the same place, whose cell has
// corners of its own there.
void requireBoundaries(MPI_Comm comm, const CellSet& cells, int dimension);

}  // namespace lampblack
