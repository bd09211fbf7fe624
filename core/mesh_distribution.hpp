// Brings each cell of a mesh to its rank, with one layer of its neighbours. No rank ever holds more than its share.
#pragma once

#include <mpi.h>

#include <vector>

#include "core/cell_set.hpp"

namespace lampblack {

struct DistributedCells {
  CellSet owned;               // by number
  CellSet halo;                // the neighbours of owned cells on other ranks, by owner and number
  std::vector<int> haloOwner;  // rank of each
};

// Collective. `cells`: this rank's share; `shareStart`: number of its first.
DistributedCells distribute(MPI_Comm comm, CellSet cells, std::int64_t totalCells, const std::vector<int>& owner);

}  // namespace lampblack
