// Meshes of Gmsh (Geuzaine and Remacle 2009): files of version 2.0 to 2.2, 4.0 and 4.1, as text or binary
// (little endian).
// docs/formats.md says what is read of them.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/mesh_block.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

// Collective. Rank 0 reads the file, in portions, and sends each rank its share: no rank holds the mesh as a whole.
// Memory and work of a rank are proportional to its share (sorting adds a logarithm); rank 0 keeps the list of
// geometrical entities as well. `scale`: m per unit of the file, above 0. `portion`: values read and sent at once.
//
// Vertices are those that cells use, numbered in the order of the file, like the cells. Cells are turned so that their
// corners stand as CellShape asks. Faces with a physical group that no kept cell has a vertex of are left out, and
// groups of which nothing is left. Elements of higher order are read by their corners. `notes`, where it is given: gets
// what of the file is passed over, a sentence each, on all ranks.
//
// InputError on all ranks: no such file, no mesh of Gmsh, another version or order of bytes, a damaged or truncated
// file, elements that Lampblack has not, no cells, a plane mesh that is not plane, folded cells.
MeshBlock readGmsh(MPI_Comm comm, const std::filesystem::path& file, double scale, std::size_t portion = 1U << 17U,
                   std::vector<std::string>* notes = nullptr);

}  // namespace lampblack::io
