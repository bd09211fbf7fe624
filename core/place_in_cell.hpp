// A place in a cell between the cell's centre and its corners: the cell is cut into triangles or tetrahedra around its
// centre, of each side, and in each the values at its corners make one linear function. What stands at centres and
// vertices becomes so continuous over the whole mesh, and a linear field is met exactly.
#pragma once

#include <array>
#include <span>

#include "core/mesh.hpp"

namespace lampblack {

struct PlaceInCell {
  int cell = -1;
  double centreWeight = 1.0;
  int corners = 0;
  std::array<int, 4> vertex{};  // in Mesh::vertex
  std::array<double, 4> weight{};

  // The value there, of one of several components a cell and a vertex.
  [[nodiscard]] double of(std::span<const double> cells, std::span<const double> vertices, int components = 1,
                          int component = 0) const {
    const auto at = [&](int i) { return static_cast<std::size_t>(i) * components + component; };
    double sum = centreWeight * cells[at(cell)];
    for (int i = 0; i < corners; ++i) sum += weight[i] * vertices[at(vertex[i])];
    return sum;
  }
};

// Of an owned cell. A place that is a little outside goes by the part it is nearest to.
PlaceInCell placeInCell(const Mesh& mesh, int cell, const Vector3& place);

// Where a straight piece that begins in a local cell leaves it.
struct CellExit {
  int face = -1;       // -1: it ends in the cell
  double share = 1.0;  // of the piece, up to there
};
CellExit exitOf(const Mesh& mesh, int cell, const Vector3& from, const Vector3& to);

}  // namespace lampblack
