// Finds what lies beyond each side of the cells of a MeshBlock: another cell, or a named part of the surface.
#pragma once

#include <mpi.h>

#include "core/cell_set.hpp"
#include "core/mesh_block.hpp"

namespace lampblack {

struct ConnectedCells {
  CellSet cells;  // of this rank's share; `owner` of the sides is not set
  std::int64_t totalFaces = 0;
  std::int64_t totalVertices = 0;  // those that cells use, which are numbered anew without the others
};

// Collective. Sides that have the same vertices are one face, but for those of a wall of no thickness. Each face gets a
// permanent number: faces are counted cell by cell, each with the cell its normal points out of, which is the one of
// the smaller number (of a periodic pair the one whose vertices are the images). InputError on all ranks where a face
// has three cells or, at the surface, no name.
ConnectedCells connect(MPI_Comm comm, const MeshBlock& block);

}  // namespace lampblack
