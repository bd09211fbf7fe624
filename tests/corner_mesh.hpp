// A mesh of which one rank has next to nothing: whatever is as long as the mesh stands out there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/box_mesh.hpp"
#include "core/grading.hpp"
#include "core/mesh_block.hpp"
#include "tests/every_module.hpp"
#include "tests/world.hpp"

namespace lampblack::test {

// Of four ranks the one that is given a corner of a few cells.
inline constexpr int smallRank = 3;

// A box in shares of which rank 3 has none.
struct CornerMesh {
  MeshBlock block;
  std::vector<double> weight;
};

inline CornerMesh cornerMesh(int dimension, int along, const char* patch = "surface") {
  MeshSpec spec;
  for (int axis = 0; axis < dimension; ++axis) {
    spec.vertices[static_cast<std::size_t>(axis)] = gradedAxis(0.0, {{1.0, along, 1.0}});
    for (const bool atMax : {false, true}) spec.patches.push_back({patch, axis, atMax});
  }
  const MeshBlock whole = boxBlock(MPI_COMM_SELF, spec);
  const auto corners = static_cast<std::size_t>(cornersOf(whole.shapes[0]));
  const auto shareOfTotal = [](std::int64_t total) {
    const std::int64_t first = total * std::min(worldRank(), smallRank) / smallRank;
    return std::pair{first, total * std::min(worldRank() + 1, smallRank) / smallRank};
  };
  CornerMesh mesh;
  MeshBlock& block = mesh.block;
  block.dimension = dimension;
  block.patches = whole.patches;
  if (worldRank() == 0) block.named = whole.named;
  block.totalCells = whole.totalCells;
  block.totalVertices = whole.totalVertices;
  const auto [first, end] = shareOfTotal(whole.totalCells);
  block.firstCell = first;
  // The curve ends in the corner of the highest first coordinate and the lowest others: a few cells there weigh as much
  // as each of the other three ranks.
  const auto isInCorner = [&](std::size_t cell) {
    for (std::size_t c = 0; c < corners; ++c) {
      const Vector3& x = whole.vertices[static_cast<std::size_t>(whole.corners[cell * corners + c])];
      if (x[0] < 0.97 || x[1] > 0.03 || x[2] > 0.03) return false;
    }
    return true;
  };
  double inCorner = 0.0;
  for (std::size_t cell = 0; cell < whole.shapes.size(); ++cell) inCorner += isInCorner(cell) ? 1.0 : 0.0;
  for (auto cell = static_cast<std::size_t>(first); cell < static_cast<std::size_t>(end); ++cell) {
    block.shapes.push_back(whole.shapes[cell]);
    for (std::size_t c = 0; c < corners; ++c) block.corners.push_back(whole.corners[cell * corners + c]);
    mesh.weight.push_back(isInCorner(cell) ? (static_cast<double>(whole.totalCells) - inCorner) / smallRank / inCorner
                                           : 1.0);
  }
  const auto [firstVertex, endVertex] = shareOfTotal(whole.totalVertices);
  block.firstVertex = firstVertex;
  block.vertices.assign(whole.vertices.begin() + firstVertex, whole.vertices.begin() + endVertex);
  return mesh;
}

}  // namespace lampblack::test
