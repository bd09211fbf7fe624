// Parts of the graph whose vertices are the cells and whose edges are the faces between two of them, so that few faces
// lie between parts.
#pragma once

#include <mpi.h>

#include <vector>

#include "core/cell_set.hpp"

namespace lampblack {

// Both are collective and give the part, of as many as there are ranks, of each of this rank's cells. `weight`: of each
// of this rank's cells, zero or more, with a sum above zero. A part may be empty.

// By METIS on the first rank, with about 100 bytes a cell of the whole mesh. NumericsError, on all ranks, when METIS
// fails.
std::vector<int> metisParts(MPI_Comm comm, const CellSet& cells, const std::vector<double>& weight);

// By PT-Scotch through PETSc; only where isThere(Partitioner::PtScotch).
std::vector<int> ptScotchParts(MPI_Comm comm, const CellSet& cells, const std::vector<double>& weight);

}  // namespace lampblack
