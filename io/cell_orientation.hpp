// Whether the corners of a cell are in the order that `CellShape` asks for, and what can be done where they are not.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/mesh_block.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

// Right: counter-clockwise, or all sides with their normals outwards. Mirrored: the other way round. Folded: neither,
// or without area or volume (less than 1e-14 of what its longest edge spans).
enum class CellOrientation { Right, Mirrored, Folded };

// `corners`: places in m, cornersOf(shape) of them; of plane cells the third coordinate does not count. A plane cell is
// judged by its area and, as only a crossed quadrilateral has two turns to each side, by its turns. A cell in space is
// judged by the pyramids from the mean of its corners to its sides.
CellOrientation orientationOf(CellShape shape, std::span<const std::array<double, 3>> corners);

// Exchanges corners so that a mirrored cell becomes a right one.
void mirror(CellShape shape, std::span<std::int64_t> corners);

}  // namespace lampblack::io
