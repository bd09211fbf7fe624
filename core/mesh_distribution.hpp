// The DMPlex side of a mesh: a box of cells, partitioned by METIS and distributed with one layer of halo cells, reduced
// to what this rank sees of it. Knows indices only; positions and metrics are the Mesh's.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lampblack {

// This rank's cells, in no particular order, and the faces around them.
struct LocalBox {
  struct Cell {
    std::int64_t natural;  // i + j * cellsAlong[0]
    int owner;             // rank
  };
  struct InteriorFace {
    int a, b;  // indices into `cells`; either may be a halo cell
  };
  struct BoundaryFace {
    int cell, axis;
    bool atMax;
  };
  std::vector<Cell> cells;
  std::vector<InteriorFace> interior;
  std::vector<BoundaryFace> boundary;
};

// Collective. Every rank owns at least one cell. `cellWeight` is in natural order, or empty for equal weights; rank 0's
// counts. InputError, on all ranks, when there are fewer cells than ranks.
LocalBox distributeBox(MPI_Comm comm, const std::array<int, 2>& cellsAlong, const std::array<bool, 2>& periodic,
                       const std::vector<double>& cellWeight);

}  // namespace lampblack
