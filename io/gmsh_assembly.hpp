// From what each rank has gathered of a Gmsh mesh to its block of cells and vertices.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh_block.hpp"
#include "core/modules.hpp"
#include "io/gmsh_shares.hpp"

namespace lampblack::io {

// What all ranks know of the whole.
struct GmshPlan {
  int dimension = 2;
  bool groupedOnly = false;  // cells without a physical group are left out
  std::int64_t cells = 0;
  std::vector<std::int64_t> groups;     // physical groups of the surface
  std::vector<std::string> groupNames;  // theirs; two groups may have the same
  std::vector<std::string> notes;       // what of the file is passed over
};

// Collective; uses up `share`. `scale`: m per unit of the file. InputError, without the name of the file, where cells,
// faces or periodic pairs name nodes that are not there, where a plane mesh is not plane, and where cells are folded.
MeshBlock assembleGmsh(MPI_Comm comm, GmshShare& share, const GmshPlan& plan, double scale);

}  // namespace lampblack::io
