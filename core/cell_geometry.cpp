#include "core/cell_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack {
namespace {

Vector3 meanOf(std::span<const Vector3> points) {
  Vector3 total{};
  for (const Vector3& point : points) total = sum(total, point);
  return scaled(total, 1.0 / static_cast<double>(points.size()));
}

struct Corners {
  std::array<Vector3, 4> places{};
  int count = 0;
  [[nodiscard]] std::span<const Vector3> all() const { return {places.data(), static_cast<std::size_t>(count)}; }
};

Corners cornersOf(const CellSide& side, std::span<const Vector3> corners) {
  Corners result;
  for (; result.count < side.corners; ++result.count)
    result.places[static_cast<std::size_t>(result.count)] =
        corners[static_cast<std::size_t>(side.corner[static_cast<std::size_t>(result.count)])];
  return result;
}

// Whether all edges of the sides go along the axes, and the cell's smallest and largest coordinates.
struct Extent {
  Vector3 lower{}, upper{};
  bool isBox = false;
};
Extent extentOf(CellShape shape, std::span<const Vector3> corners) {
  Extent extent{corners[0], corners[0], shape == CellShape::Quadrilateral || shape == CellShape::Hexahedron};
  for (const Vector3& corner : corners)
    for (std::size_t i = 0; i < 3; ++i) {
      extent.lower[i] = std::min(extent.lower[i], corner[i]);
      extent.upper[i] = std::max(extent.upper[i], corner[i]);
    }
  for (const Vector3& corner : corners)
    for (std::size_t i = 0; i < 3; ++i)
      extent.isBox = extent.isBox && (corner[i] == extent.lower[i] || corner[i] == extent.upper[i]);
  return extent;
}

bool isPlane(CellShape shape) {
  return shape == CellShape::Triangle || shape == CellShape::Quadrilateral;
}

// The corners that the edges of each corner lead to, in right-handed order.
std::span<const std::array<int, 3>> edgesOf(CellShape shape) {
  static constexpr std::array<std::array<int, 3>, 3> triangle{{{1, 2, -1}, {2, 0, -1}, {0, 1, -1}}};
  static constexpr std::array<std::array<int, 3>, 4> quadrilateral{{{1, 3, -1}, {2, 0, -1}, {3, 1, -1}, {0, 2, -1}}};
  static constexpr std::array<std::array<int, 3>, 4> tetrahedron{{{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}}};
  // The top of a pyramid has four edges; its base tells.
  static constexpr std::array<std::array<int, 3>, 4> pyramid{{{1, 3, 4}, {2, 0, 4}, {3, 1, 4}, {0, 2, 4}}};
  static constexpr std::array<std::array<int, 3>, 6> prism{
      {{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}}};
  static constexpr std::array<std::array<int, 3>, 8> hexahedron{
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
  switch (shape) {
    case CellShape::Triangle:
      return triangle;
    case CellShape::Quadrilateral:
      return quadrilateral;
    case CellShape::Tetrahedron:
      return tetrahedron;
    case CellShape::Pyramid:
      return pyramid;
    case CellShape::Prism:
      return prism;
    case CellShape::Hexahedron:
      return hexahedron;
  }
  return triangle;
}

double shapeOf(CellShape shape, std::span<const Vector3> corners) {
  double worst = 1.0;
  std::size_t corner = 0;
  for (const std::array<int, 3>& edges : edgesOf(shape)) {
    const Vector3& from = corners[corner++];
    const auto edge = [&](std::size_t i) { return difference(corners[static_cast<std::size_t>(edges[i])], from); };
    const Vector3 a = edge(0), b = edge(1);
    const Vector3 c = isPlane(shape) ? Vector3{0.0, 0.0, 1.0} : edge(2);
    worst = std::min(worst, dot(cross(a, b), c) / (length(a) * length(b) * length(c)));
  }
  return worst;
}

CellMeasures measurePolygon(std::span<const Vector3> corners) {
  const Vector3 middle = meanOf(corners);
  double area = 0.0;
  Vector3 moment{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 a = difference(corners[i], middle), b = difference(corners[(i + 1) % corners.size()], middle);
    const double part = 0.5 * cross(a, b)[2];
    area += part;
    moment = sum(moment, scaled(sum(a, b), part / 3.0));
  }
  return {sum(middle, scaled(moment, 1.0 / area)), area, 0.0};
}

CellMeasures measurePolyhedron(CellShape shape, std::span<const Vector3> corners) {
  const Vector3 middle = meanOf(corners);
  double volume = 0.0;
  Vector3 moment{};
  const auto addTetrahedron = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 x = difference(a, middle), y = difference(b, middle), z = difference(c, middle);
    const double part = dot(cross(x, y), z) / 6.0;
    volume += part;
    moment = sum(moment, scaled(sum(sum(x, y), z), 0.25 * part));
  };
  for (const CellSide& side : sidesOf(shape)) {
    const Corners of = cornersOf(side, corners);
    const auto all = of.all();
    if (of.count == 3) {
      addTetrahedron(all[0], all[1], all[2]);
      continue;
    }
    const Vector3 centre = meanOf(all);
    for (std::size_t i = 0; i < 4; ++i) addTetrahedron(all[i], all[(i + 1) % 4], centre);
  }
  return {sum(middle, scaled(moment, 1.0 / volume)), volume, 0.0};
}

}  // namespace

SideMeasures measureSide(CellShape shape, const CellSide& side, std::span<const Vector3> corners) {
  const Corners of = cornersOf(side, corners);
  const auto all = of.all();
  if (isPlane(shape)) {
    const Vector3 along = difference(all[1], all[0]);
    const double size = length(along);
    return {scaled(sum(all[0], all[1]), 0.5), {along[1] / size, -along[0] / size, 0.0}, size};
  }
  const Extent cell = extentOf(shape, corners);
  if (cell.isBox) {
    const Vector3 spanned = cross(difference(all[1], all[0]), difference(all[3], all[0]));
    const double size = length(spanned);
    return {scaled(sum(all[0], all[2]), 0.5), scaled(spanned, 1.0 / size), size};
  }
  const Vector3 middle = meanOf(all);
  Vector3 area{}, moment{};
  double total = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vector3 a = difference(all[i], middle), b = difference(all[(i + 1) % all.size()], middle);
    const Vector3 part = scaled(cross(a, b), 0.5);
    area = sum(area, part);
    const double size = length(part);
    total += size;
    moment = sum(moment, scaled(sum(a, b), size / 3.0));
  }
  const double size = length(area);
  return {sum(middle, scaled(moment, 1.0 / total)), scaled(area, 1.0 / size), size};
}

CellMeasures measureCell(CellShape shape, std::span<const Vector3> corners) {
  const Extent extent = extentOf(shape, corners);
  CellMeasures measures;
  if (extent.isBox) {
    const Vector3 edges = difference(extent.upper, extent.lower);
    measures.centre = scaled(sum(extent.lower, extent.upper), 0.5);
    measures.size = edges[0] * edges[1] * (isPlane(shape) ? 1.0 : edges[2]);
  } else {
    measures = isPlane(shape) ? measurePolygon(corners) : measurePolyhedron(shape, corners);
  }
  measures.shape = shapeOf(shape, corners);
  return measures;
}

}  // namespace lampblack
