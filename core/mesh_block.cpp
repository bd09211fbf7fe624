#include "core/mesh_block.hpp"

namespace lampblack {
namespace {

constexpr CellSide line(int a, int b) {
  return {2, {a, b, 0, 0}};
}
constexpr CellSide triangle(int a, int b, int c) {
  return {3, {a, b, c, 0}};
}
constexpr CellSide quadrilateral(int a, int b, int c, int d) {
  return {4, {a, b, c, d}};
}

constexpr std::array triangleSides{line(0, 1), line(1, 2), line(2, 0)};
constexpr std::array quadrilateralSides{line(0, 1), line(1, 2), line(2, 3), line(3, 0)};
constexpr std::array tetrahedronSides{triangle(0, 2, 1), triangle(0, 1, 3), triangle(1, 2, 3), triangle(0, 3, 2)};
constexpr std::array pyramidSides{quadrilateral(0, 3, 2, 1), triangle(0, 1, 4), triangle(1, 2, 4), triangle(2, 3, 4),
                                  triangle(3, 0, 4)};
constexpr std::array prismSides{triangle(0, 2, 1), triangle(3, 4, 5), quadrilateral(0, 1, 4, 3),
                                quadrilateral(1, 2, 5, 4), quadrilateral(2, 0, 3, 5)};
constexpr std::array hexahedronSides{quadrilateral(0, 3, 2, 1), quadrilateral(4, 5, 6, 7), quadrilateral(0, 1, 5, 4),
                                     quadrilateral(1, 2, 6, 5), quadrilateral(2, 3, 7, 6), quadrilateral(3, 0, 4, 7)};

struct Shape {
  const char* name;
  int corners;
  std::span<const CellSide> sides;
};

const Shape& shapeOf(CellShape shape) {
  static const std::array<Shape, 6> shapes{{{"triangle", 3, triangleSides},
                                            {"quadrilateral", 4, quadrilateralSides},
                                            {"tetrahedron", 4, tetrahedronSides},
                                            {"pyramid", 5, pyramidSides},
                                            {"prism", 6, prismSides},
                                            {"hexahedron", 8, hexahedronSides}}};
  return shapes.at(static_cast<std::size_t>(shape));
}

}  // namespace

int cornersOf(CellShape shape) {
  return shapeOf(shape).corners;
}
std::span<const CellSide> sidesOf(CellShape shape) {
  return shapeOf(shape).sides;
}
const char* nameOf(CellShape shape) {
  return shapeOf(shape).name;
}

}  // namespace lampblack
