// Faces of a mesh's surface that belong to no boundary: what is said of them, on any number of ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/mesh_connect.hpp"
#include "core/ranks.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Six unit squares in a row, each rank with its share. At x = 3 m, which is between two ranks, both sides have corners
// of their own where they are `doubled`, with coordinates that differ by rounding. There are no names.
std::string messageOfRow(bool doubled) {
  constexpr std::int64_t cells = 6;
  const std::int64_t columns = doubled ? 8 : 7, rank = rankIn(MPI_COMM_WORLD), ranks = ranksOf(MPI_COMM_WORLD);
  MeshBlock block;
  block.totalCells = cells;
  block.firstCell = cells * rank / ranks;
  for (std::int64_t c = block.firstCell; c < cells * (rank + 1) / ranks; ++c) {
    const std::int64_t column = doubled && c >= 3 ? c + 1 : c;
    block.shapes.push_back(CellShape::Quadrilateral);
    for (const std::int64_t corner : {0, 2, 3, 1}) block.corners.push_back(2 * column + corner);
  }
  block.totalVertices = 2 * columns;
  block.firstVertex = block.totalVertices * rank / ranks;
  for (std::int64_t v = block.firstVertex; v < block.totalVertices * (rank + 1) / ranks; ++v) {
    const auto column = static_cast<double>(v / 2);
    const bool isBehind = doubled && v / 2 > 3;
    block.vertices.push_back({isBehind ? (column - 1.0) * (1.0 + 2e-16) : column, v % 2 == 0 ? 0.0 : 1.0, 0.0});
  }
  return messageOf<InputError>([&] { connect(MPI_COMM_WORLD, block); });
}

TEST(MeshSurface, TheFirstFaceWithoutABoundaryIsSaidOnAnyRanks) {
  const std::string message = messageOfRow(false);
  EXPECT_EQ(message, "the boundary face at (0.5, 0) m belongs to no boundary");
  EXPECT_TRUE(sameOnAllRanks(message));
}

TEST(MeshSurface, CornersThatAreThereTwiceAreFoundBetweenRanks) {
  const std::string message = messageOfRow(true);
  EXPECT_THAT(message,
              testing::HasSubstr("the cells on both sides of the face at (3, 0.5) m have corners of their own"));
  EXPECT_TRUE(sameOnAllRanks(message));
}

}  // namespace
}  // namespace lampblack::test
