// The blocks of all ranks put together, on every rank.
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh_block.hpp"
#include "tests/every_module.hpp"
#include "tests/world.hpp"

namespace lampblack::test {

struct WholeMesh {
  int dimension = 0;
  std::vector<CellShape> shapes;
  std::vector<std::vector<std::int64_t>> cells;
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::string> patches;
  std::multiset<std::pair<std::string, std::vector<std::int64_t>>> named;  // patch, vertices in order of number
  std::multiset<std::pair<std::int64_t, std::int64_t>> periodic;
};

template <typename T>
std::vector<T> gatherAll(const std::vector<T>& mine, MPI_Datatype type) {
  const auto ranks = static_cast<std::size_t>(worldSize());
  const auto count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (std::size_t r = 1; r < ranks; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<T> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), starts.data(), type, MPI_COMM_WORLD);
  return all;
}

// Checks the numbering of the shares on the way.
inline WholeMesh wholeOf(const MeshBlock& block) {
  WholeMesh whole{block.dimension, {}, {}, {}, block.patches, {}, {}};
  std::vector<std::int64_t> numbers, faces, pairs;
  std::vector<double> places;
  for (const CellShape shape : block.shapes) numbers.push_back(static_cast<std::int64_t>(shape));
  for (const auto& x : block.vertices) places.insert(places.end(), x.begin(), x.end());
  for (const auto& face : block.named) {
    faces.push_back(face.patch);
    faces.insert(faces.end(), face.vertices.begin(), face.vertices.end());
  }
  for (const auto& [a, b] : block.periodic) pairs.insert(pairs.end(), {a, b});
  numbers = gatherAll(numbers, MPI_INT64_T);
  places = gatherAll(places, MPI_DOUBLE);
  faces = gatherAll(faces, MPI_INT64_T);
  pairs = gatherAll(pairs, MPI_INT64_T);
  const std::vector<std::int64_t> corners = gatherAll(block.corners, MPI_INT64_T);
  std::size_t at = 0;
  for (const std::int64_t number : numbers) {
    whole.shapes.push_back(static_cast<CellShape>(number));
    const auto n = static_cast<std::size_t>(cornersOf(whole.shapes.back()));
    whole.cells.emplace_back(corners.begin() + static_cast<std::ptrdiff_t>(at),
                             corners.begin() + static_cast<std::ptrdiff_t>(at + n));
    at += n;
  }
  EXPECT_EQ(at, corners.size());
  for (std::size_t i = 0; i < places.size(); i += 3)
    whole.vertices.push_back({places[i], places[i + 1], places[i + 2]});
  for (std::size_t i = 0; i < faces.size(); i += 5) {
    std::vector<std::int64_t> vertices;
    for (std::size_t k = 1; k < 5; ++k)
      if (faces[i + k] >= 0) vertices.push_back(faces[i + k]);
    std::sort(vertices.begin(), vertices.end());
    whole.named.emplace(block.patches.at(static_cast<std::size_t>(faces[i])), vertices);
  }
  for (std::size_t i = 0; i < pairs.size(); i += 2) whole.periodic.emplace(pairs[i], pairs[i + 1]);

  std::int64_t before[2] = {0, 0};
  const std::int64_t mine[2] = {static_cast<std::int64_t>(block.shapes.size()),
                                static_cast<std::int64_t>(block.vertices.size())};
  MPI_Exscan(mine, before, 2, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  if (worldRank() == 0) before[0] = before[1] = 0;
  EXPECT_EQ(block.firstCell, before[0]);
  EXPECT_EQ(block.firstVertex, before[1]);
  EXPECT_EQ(block.totalCells, static_cast<std::int64_t>(whole.cells.size()));
  EXPECT_EQ(block.totalVertices, static_cast<std::int64_t>(whole.vertices.size()));
  EXPECT_LE(mine[0], block.totalCells / worldSize() + 1);
  return whole;
}

}  // namespace lampblack::test
