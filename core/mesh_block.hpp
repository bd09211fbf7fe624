// A mesh before it is partitioned: every rank has a share of consecutive cells and one of consecutive vertices, whoever
// makes it (a box, a reader of files). `Mesh` takes it from there. Cells and vertices have permanent numbers, which do
// not depend on the number of ranks: the share of rank r begins where that of rank r - 1 ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lampblack {

// Corners are numbered as in VTK and Gmsh.
enum class CellShape : std::uint8_t { Triangle, Quadrilateral, Tetrahedron, Pyramid, Prism, Hexahedron };

// A side by its corners, in an order in which its normal points outwards (right-hand rule; of a plane cell: the side
// from the first to the second corner, with the cell on its left).
struct CellSide {
  int corners = 0;
  std::array<int, 4> corner{};  // of the cell
};

int cornersOf(CellShape shape);
// Whether each side has one across the cell that shares no corner with it.
constexpr bool hasOppositeSides(CellShape shape) {
  return shape == CellShape::Quadrilateral || shape == CellShape::Hexahedron;
}
std::span<const CellSide> sidesOf(CellShape shape);
const char* nameOf(CellShape shape);

struct MeshBlock {
  int dimension = 2;  // 2: triangles and quadrilaterals in a plane; 3: the others

  std::int64_t totalCells = 0;
  std::int64_t firstCell = 0;         // permanent number of this rank's first
  std::vector<CellShape> shapes;      // of this rank's cells
  std::vector<std::int64_t> corners;  // their vertices, cell after cell, cornersOf() each

  std::int64_t totalVertices = 0;
  std::int64_t firstVertex = 0;
  std::vector<std::array<double, 3>> vertices;  // m, of this rank's share; the third is zero in a plane

  // Parts of the surface by name. Each boundary face stands here on one of the ranks, with its vertices in any order,
  // unused ones -1. A face without a name is an error unless it is periodic.
  struct NamedFace {
    std::array<std::int64_t, 4> vertices{-1, -1, -1, -1};
    int patch = 0;  // in `patches`
  };
  std::vector<std::string> patches;  // the same on all ranks
  // Of each patch, or empty for none: its faces that have a cell on both sides are walls of no thickness, two boundary
  // faces each. Other names of such faces count for nothing.
  std::vector<char> isThinWall;
  std::vector<NamedFace> named;

  // Vertices of one periodic side and the vertices of the other that they are one with, each pair on one of the ranks.
  std::vector<std::pair<std::int64_t, std::int64_t>> periodic;
};

}  // namespace lampblack
