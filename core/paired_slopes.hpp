// The gradient in a quadrilateral or hexahedron around a bend from the slopes between its opposite neighbours: along
// each of its axes the slope of the parabola through three values, over the same mean of the two steps, from which the
// bend drops out. By least squares a thin cell's neighbours along its layer, which lie many heights beside its plane,
// would take up to a fifth from the slope across the layer. Exact for linear fields.
#pragma once

#include <span>

#include "core/mesh.hpp"

namespace lampblack {

// Whether steps miss a face's centre of this owned cell by more than a hundredth of the face's size, and the cell is
// one with opposite sides: `weight` has what the difference to the value beyond each of its faces counts by.
bool pairedSlopes(const Mesh& m, int cell, std::span<Vector3> weight);

}  // namespace lampblack
