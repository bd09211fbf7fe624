// Gives each cell of a mesh to a rank, and brings it there with one layer of its neighbours. No rank ever holds more
// than its share.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "core/cell_set.hpp"

namespace lampblack {

// Collective. The rank of each of this rank's cells: pieces of a space-filling curve of about equal weight, each of at
// least one cell. `weight`: of each of this rank's cells, zero or more, on any scale; empty on all ranks for equal
// ones, which also stand in where the sum is zero. InputError, on all ranks, when there are fewer cells than ranks.
std::vector<int> partitionAlongCurve(MPI_Comm comm, const CellSet& cells, int dimension,
                                     std::span<const double> weight);

struct DistributedCells {
  CellSet owned;               // by number
  CellSet halo;                // the neighbours of owned cells on other ranks, by owner and number
  std::vector<int> haloOwner;  // rank of each
};

// Collective. `cells`: this rank's share; `shareStart`: number of its first.
DistributedCells distribute(MPI_Comm comm, CellSet cells, std::int64_t totalCells, const std::vector<int>& owner);

}  // namespace lampblack
