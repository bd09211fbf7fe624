// Which cells of a mesh places lie in.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh.hpp"

namespace lampblack {

struct FoundCells {
  std::vector<int> cell;                  // of each place: its cell where this rank owns it, else -1
  std::vector<std::int64_t> naturalCell;  // its permanent number, the same on all ranks; -1: outside the mesh
};

// Collective, with the same places on all ranks. Of a place on a face the cell of the smaller number. Cells are taken
// as convex; between faces in space that are not plane a place may be a little outside of every cell, and goes to the
// one it is nearest to.
FoundCells findCells(const Mesh& mesh, std::span<const Vector3> places);

// Collective. Where the mesh is, for a place that is not in it, in words: "the mesh reaches from (0, 0) to (1, 2) m",
// and where the place is between these "..., but has no cell there; the nearest has its centre
// at (0.5, 1) m".
std::string meshExtentText(const Mesh& mesh, const Vector3& place);

}  // namespace lampblack
