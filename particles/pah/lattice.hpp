// The lattice of hexagons that molecules lie on: a cell by its two axial coordinates, and the six directions around it
// in order, so that neighbours in a direction and in the next are neighbours of each other.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::particles {

struct LatticeCell {
  std::int32_t q = 0, r = 0;
  friend constexpr auto operator<=>(const LatticeCell&, const LatticeCell&) = default;
};

inline constexpr std::array<LatticeCell, 6> latticeDirections{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};

// The cell beside `cell` in a direction, any integer from 0.
constexpr LatticeCell beside(const LatticeCell& cell, unsigned direction) {
  const LatticeCell& d = latticeDirections[direction % 6];
  return {cell.q + d.q, cell.r + d.r};
}

}  // namespace lampblack::particles
