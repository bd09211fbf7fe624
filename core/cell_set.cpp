#include "core/cell_set.hpp"

#include <bit>
#include <cstddef>

namespace lampblack {

void CellSet::Amount::add(CellShape shape) {
  ++cells;
  corners += cornersOf(shape);
  sides += static_cast<std::int64_t>(lampblack::sidesOf(shape).size());
}

void CellSet::resize(const Amount& all) {
  numbers.resize(static_cast<std::size_t>(all.cells));
  shapes.resize(numbers.size());
  cornerStart.resize(numbers.size() + 1);
  sideStart.resize(numbers.size() + 1);
  vertices.resize(static_cast<std::size_t>(all.corners));
  places.resize(vertices.size());
  sides.resize(static_cast<std::size_t>(all.sides));
}

void CellSet::pack(std::size_t cell, std::vector<std::int64_t>& message) const {
  message.push_back(numbers[cell]);
  message.push_back(static_cast<std::int64_t>(shapes[cell]));
  const auto corners = verticesOf(cell);
  message.insert(message.end(), corners.begin(), corners.end());
  for (const std::array<double, 3>& place : placesOf(cell))
    for (const double x : place) message.push_back(std::bit_cast<std::int64_t>(x));
  static_assert(sizeof(Side) == 3 * sizeof(std::int64_t));
  for (const Side& side : sidesOf(cell)) {
    const auto words = std::bit_cast<std::array<std::int64_t, 3>>(side);
    message.insert(message.end(), words.begin(), words.end());
  }
}

void CellSet::unpack(std::span<const std::int64_t> message, Amount& next) {
  for (std::size_t word = 0; word < message.size();) {
    const auto cell = static_cast<std::size_t>(next.cells);
    numbers[cell] = message[word++];
    shapes[cell] = static_cast<CellShape>(message[word++]);
    auto corner = static_cast<std::size_t>(next.corners), side = static_cast<std::size_t>(next.sides);
    next.add(shapes[cell]);
    cornerStart[cell + 1] = next.corners;
    sideStart[cell + 1] = next.sides;
    const auto corners = static_cast<std::size_t>(cornersOf(shapes[cell]));
    for (std::size_t c = 0; c < corners; ++c) vertices[corner + c] = message[word++];
    for (std::size_t c = 0; c < corners; ++c)
      for (double& x : places[corner + c]) x = std::bit_cast<double>(message[word++]);
    for (; side < static_cast<std::size_t>(next.sides); ++side, word += 3)
      sides[side] = std::bit_cast<Side>(std::array{message[word], message[word + 1], message[word + 2]});
  }
}

}  // namespace lampblack
