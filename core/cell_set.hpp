// Cells with all there is to know about each, so that any of them can go to any rank: where its corners are, and what
// lies beyond each of its sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh_block.hpp"

namespace lampblack {

struct CellSet {
  // What lies beyond a side.
  struct Side {
    std::int64_t neighbour = -1;  // number of the cell there; -1: the surface
    std::int64_t face = -1;       // permanent number of the face
    std::int32_t owner = -1;      // rank of the neighbour
    std::int16_t patch = -1;      // at the surface
    std::int8_t neighbourSide = -1;
    std::int8_t isLow = 1;  // whether the face's normal points out of this cell
  };

  std::vector<std::int64_t> numbers;
  std::vector<CellShape> shapes;
  std::vector<std::int64_t> cornerStart{0}, sideStart{0};  // of each cell in the arrays below, and the end
  std::vector<std::int64_t> vertices;                      // permanent numbers of the corners
  std::vector<std::array<double, 3>> places;               // m, of the corners
  std::vector<Side> sides;

  [[nodiscard]] std::size_t size() const { return numbers.size(); }
  [[nodiscard]] std::span<const std::array<double, 3>> placesOf(std::size_t cell) const {
    return {&places[static_cast<std::size_t>(cornerStart[cell])],
            static_cast<std::size_t>(cornerStart[cell + 1] - cornerStart[cell])};
  }
  [[nodiscard]] std::span<const std::int64_t> verticesOf(std::size_t cell) const {
    return {&vertices[static_cast<std::size_t>(cornerStart[cell])],
            static_cast<std::size_t>(cornerStart[cell + 1] - cornerStart[cell])};
  }
  [[nodiscard]] std::span<const Side> sidesOf(std::size_t cell) const {
    return {&sides[static_cast<std::size_t>(sideStart[cell])],
            static_cast<std::size_t>(sideStart[cell + 1] - sideStart[cell])};
  }

  // Room for so many cells, with so many corners and sides in all.
  struct Amount {
    std::int64_t cells = 0, corners = 0, sides = 0;
    void add(CellShape shape);
  };
  void resize(const Amount& all);

  // A cell as words, appended to `message`; and the cells of such a message, put where `next` says, which moves on.
  void pack(std::size_t cell, std::vector<std::int64_t>& message) const;
  void unpack(std::span<const std::int64_t> message, Amount& next);
};

}  // namespace lampblack
