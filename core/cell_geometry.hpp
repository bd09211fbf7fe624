// Measures of cells and of their sides from the places of the corners, in a plane or in space. A box along the axes is
// measured by its edges, to the last bit.
#pragma once

#include <span>

#include "core/mesh_block.hpp"
#include "core/vector3.hpp"

namespace lampblack {

struct SideMeasures {
  Vector3 centre{};   // m
  Vector3 normal{};   // outwards, of length one
  double size = 0.0;  // m^2; of a plane cell the length, m
};
// A quadrilateral in space need not be plane: it is the four triangles around the mean of its corners.
SideMeasures measureSide(CellShape shape, const CellSide& side, std::span<const Vector3> corners);

struct CellMeasures {
  Vector3 centre{};   // m, of gravity
  double size = 0.0;  // m^3; of a plane cell the area, m^2
  // Smallest over all corners of the volume spanned by the edges there (right-handed), over what edges of their lengths
  // span at most: one for a box, zero or less for a cell that is folded.
  double shape = 0.0;
};
CellMeasures measureCell(CellShape shape, std::span<const Vector3> corners);

}  // namespace lampblack
