#include "core/cell_set.hpp"

#include <bit>
#include <cstddef>

namespace lampblack {

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

void CellSet::unpack(std::span<const std::int64_t> message) {
  for (std::size_t next = 0; next < message.size();) {
    numbers.push_back(message[next++]);
    shapes.push_back(static_cast<CellShape>(message[next++]));
    const int corners = cornersOf(shapes.back());
    for (int c = 0; c < corners; ++c) vertices.push_back(message[next++]);
    for (int c = 0; c < corners; ++c) {
      std::array<double, 3>& place = places.emplace_back();
      for (double& x : place) x = std::bit_cast<double>(message[next++]);
    }
    for (std::size_t s = 0; s < lampblack::sidesOf(shapes.back()).size(); ++s, next += 3)
      sides.push_back(std::bit_cast<Side>(std::array{message[next], message[next + 1], message[next + 2]}));
    cornerStart.push_back(static_cast<std::int64_t>(vertices.size()));
    sideStart.push_back(static_cast<std::int64_t>(sides.size()));
  }
}

CellSet reordered(const CellSet& cells, const std::vector<std::size_t>& order) {
  CellSet result;
  std::vector<std::int64_t> message;
  for (const std::size_t cell : order) {
    message.clear();
    cells.pack(cell, message);
    result.unpack(message);
  }
  return result;
}

}  // namespace lampblack
