#include "io/cell_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lampblack::io {
namespace {

using Place = std::array<double, 3>;

constexpr double leastContent = 1e-14;  // of a cell, over its longest edge to the power of the dimension

Place minus(const Place& a, const Place& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Place meanPlace(std::span<const Place> places) {
  Place sum{};
  for (const Place& place : places)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += place[k] / static_cast<double>(places.size());
  return sum;
}

CellOrientation orientationInPlane(std::span<const Place> corners) {
  const std::size_t n = corners.size();
  double area = 0, longest = 0;
  int left = 0, right = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Place along = minus(corners[(i + 1) % n], corners[i]);
    const Place next = minus(corners[(i + 2) % n], corners[(i + 1) % n]);
    const Place out = minus(corners[i], corners[0]);
    area += (out[0] * along[1] - out[1] * along[0]) / 2;
    longest = std::max(longest, std::hypot(along[0], along[1]));
    const double turn = along[0] * next[1] - along[1] * next[0];
    left += turn > 0 ? 1 : 0;
    right += turn < 0 ? 1 : 0;
  }
  if (!(std::abs(area) > leastContent * longest * longest)) return CellOrientation::Folded;
  if (left == 2 && right == 2) return CellOrientation::Folded;
  return area > 0 ? CellOrientation::Right : CellOrientation::Mirrored;
}

CellOrientation orientationInSpace(CellShape shape, std::span<const Place> corners) {
  const Place centre = meanPlace(corners);
  double longest = 0;
  std::array<double, 6> volumes{};
  const auto sides = sidesOf(shape);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    std::array<Place, 4> places{};
    const auto n = static_cast<std::size_t>(sides[s].corners);
    for (std::size_t i = 0; i < n; ++i)
      places[i] = minus(corners[static_cast<std::size_t>(sides[s].corner[i])], centre);
    const Place middle = meanPlace(std::span(places.data(), n));
    for (std::size_t i = 0; i < n; ++i) {
      const Place &a = places[i], &b = places[(i + 1) % n];
      volumes[s] += dot(middle, cross(a, b)) / 6;
      const Place edge = minus(b, a);
      longest = std::max(longest, std::sqrt(dot(edge, edge)));
    }
  }
  const double least = leastContent * longest * longest * longest;
  const std::span<const double> all(volumes.data(), sides.size());
  if (std::ranges::all_of(all, [&](double v) { return v > least; })) return CellOrientation::Right;
  if (std::ranges::all_of(all, [&](double v) { return v < -least; })) return CellOrientation::Mirrored;
  return CellOrientation::Folded;
}

}  // namespace

CellOrientation orientationOf(CellShape shape, std::span<const Place> corners) {
  const bool plane = shape == CellShape::Triangle || shape == CellShape::Quadrilateral;
  return plane ? orientationInPlane(corners) : orientationInSpace(shape, corners);
}

void mirror(CellShape shape, std::span<std::int64_t> corners) {
  switch (shape) {
    case CellShape::Triangle:
    case CellShape::Tetrahedron:
      std::swap(corners[1], corners[2]);
      break;
    case CellShape::Quadrilateral:
    case CellShape::Pyramid:
      std::swap(corners[1], corners[3]);
      break;
    case CellShape::Prism:
      std::swap(corners[1], corners[2]);
      std::swap(corners[4], corners[5]);
      break;
    case CellShape::Hexahedron:
      std::swap(corners[1], corners[3]);
      std::swap(corners[5], corners[7]);
      break;
  }
}

}  // namespace lampblack::io
