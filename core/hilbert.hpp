// Hilbert's space-filling curve: the place along it of a point, so that points near along the curve are near in space.
#pragma once

#include <array>
#include <cstdint>

namespace lampblack {

// `place`: in [0, 1], two or three coordinates. Skilling (2004), "Programming the Hilbert curve": 31 bits an axis in
// two dimensions, 21 in three.
std::uint64_t hilbertIndex(const std::array<double, 3>& place, int dimension);

}  // namespace lampblack
