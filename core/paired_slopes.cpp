#include "core/paired_slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cell_geometry.hpp"

namespace lampblack {
namespace {

bool isBent(const Mesh& m, int cell) {
  constexpr double share = 0.01;
  if (!m.isSkewed()) return false;
  for (int i = m.faceStart[static_cast<std::size_t>(cell)]; i < m.faceStart[static_cast<std::size_t>(cell) + 1]; ++i) {
    const int face = m.faceOfCell[static_cast<std::size_t>(i)];
    const double size = m.dimension == 3 ? std::sqrt(m.size(face)) : m.size(face);
    if (length(m.offset[static_cast<std::size_t>(face)]) > share * size) return true;
  }
  return false;
}

bool shareCorners(const CellSide& a, const CellSide& b) {
  for (int i = 0; i < a.corners; ++i)
    for (int j = 0; j < b.corners; ++j)
      if (a.corner[static_cast<std::size_t>(i)] == b.corner[static_cast<std::size_t>(j)]) return true;
  return false;
}

}  // namespace

bool pairedSlopes(const Mesh& m, int cell, std::span<Vector3> weight) {
  const auto c = static_cast<std::size_t>(cell);
  const CellShape shape = m.shape[c];
  if (!hasOppositeSides(shape) || !isBent(m, cell)) return false;
  const int count = m.faceStart[c + 1] - m.faceStart[c];
  const auto at = [&](int i) {
    return static_cast<std::size_t>(m.faceOfCell[static_cast<std::size_t>(m.faceStart[c] + i)]);
  };
  const auto sideOf = [&](int i) -> const CellSide& {
    return sidesOf(shape)[static_cast<std::size_t>(m.low[at(i)] == cell ? m.lowSide[at(i)] : m.highSide[at(i)])];
  };
  const auto outwards = [&](int i) { return scaled(m.step[at(i)], m.low[at(i)] == cell ? 1.0 : -1.0); };
  struct Pair {
    int ahead = 0, behind = 0;
    double shareAhead = 0.0, shareBehind = 0.0;  // 1/m
  };
  std::array<Pair, 3> pairs{};
  std::array<Vector3, 3> along{};
  along[2] = {0.0, 0.0, 1.0};
  int found = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      if (shareCorners(sideOf(i), sideOf(j))) continue;
      if (found == m.dimension) return false;
      const Vector3 ahead = outwards(i), behind = scaled(outwards(j), -1.0);
      const double a = length(ahead), b = length(behind);
      const auto p = static_cast<std::size_t>(found++);
      pairs[p] = {i, j, b / (a * (a + b)), a / (b * (a + b))};
      along[p] = sum(scaled(ahead, pairs[p].shareAhead), scaled(behind, pairs[p].shareBehind));
    }
  if (found != m.dimension || count != 2 * found) return false;
  const double size = dot(along[0], cross(along[1], along[2]));
  if (!(std::abs(size) > 0.05)) return false;  // cells sheared by more than 87 degrees
  for (std::size_t p = 0; p < static_cast<std::size_t>(found); ++p) {
    const Vector3 dual = scaled(cross(along[(p + 1) % 3], along[(p + 2) % 3]), 1.0 / size);
    weight[static_cast<std::size_t>(pairs[p].ahead)] = scaled(dual, pairs[p].shareAhead);
    weight[static_cast<std::size_t>(pairs[p].behind)] = scaled(dual, -pairs[p].shareBehind);
  }
  return true;
}

}  // namespace lampblack
