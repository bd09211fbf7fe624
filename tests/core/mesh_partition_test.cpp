// How cells are spread over the ranks: measured costs are balanced, and the smallest meshes work.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/halo_exchange.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/skewed_mesh.hpp"

namespace lampblack::test {
namespace {

const std::array everyPartitioner{Partitioner::Curve, Partitioner::Metis, Partitioner::PtScotch};

// Faces with a cell of another rank, each counted once.
double facesBetweenRanks(const Mesh& mesh) {
  double faces = 0.0;
  for (std::size_t f = 0; f < mesh.high.size(); ++f)
    if (mesh.high[f] >= 0 && (mesh.low[f] >= mesh.owned || mesh.high[f] >= mesh.owned)) faces += 0.5;
  return sumOverRanks(faces);
}

TEST(MeshPartition, GraphsBalanceCostAndCutFewFaces) {
  const MeshSpec spec = unitBox(40, 40);
  const SkewedMesh skewed(MPI_COMM_WORLD, spec, Cells::Triangles, 0.3);
  const MeshBlock& block = skewed.block();
  // A ring costs 20 times the rest.
  std::vector<double> weight;
  const Mesh whole(MPI_COMM_SELF, SkewedMesh(MPI_COMM_SELF, spec, Cells::Triangles, 0.3).block(), Geometry::Planar);
  const auto costOf = [&](std::int64_t cell) {
    const Vector3& x = whole.centre[static_cast<std::size_t>(cell)];
    return std::abs(std::hypot(x[0] - 0.4, x[1] - 0.5) - 0.3) < 0.03 ? 20.0 : 1.0;
  };
  for (std::size_t c = 0; c < block.shapes.size(); ++c)
    weight.push_back(costOf(block.firstCell + static_cast<std::int64_t>(c)));
  const Mesh curve(MPI_COMM_WORLD, block, Geometry::Planar, {Partitioner::Curve, weight});
  for (const Partitioner by : {Partitioner::Metis, Partitioner::PtScotch}) {
    const Mesh mesh(MPI_COMM_WORLD, block, Geometry::Planar, {by, weight});
    double own = 0.0;
    for (int c = 0; c < mesh.owned; ++c) own += costOf(mesh.naturalCell[at(c)]);
    EXPECT_LE(maxOverRanks(own), 1.06 * sumOverRanks(own) / mesh.ranks);
    // Few cells: a part that is grown at random cuts more here and there. A graph of wrong cells cuts most faces.
    EXPECT_LE(facesBetweenRanks(mesh), 1.3 * facesBetweenRanks(curve));
    for (int c = 0; c < mesh.cells; ++c)
      EXPECT_EQ(mesh.centre[at(c)], whole.centre[at(whole.findOwned(mesh.naturalCell[at(c)]))]);
  }
}

TEST(MeshPartition, MeasuredCostIsBalanced) {
  // A flame: a band of rows costs 20 times the rest, in seconds.
  const int columns = 40;
  const int rows = 36;
  std::vector<double> cost(at(columns * rows), 1e-4);
  for (int j = 10; j < 16; ++j)
    for (int i = 0; i < columns; ++i) cost[at(i + j * columns)] = 20e-4;
  const auto share = shareOf(cost);
  const Mesh mesh(MPI_COMM_WORLD, unitBox(columns, rows), {.weight = share});
  double own = 0.0;
  for (int c = 0; c < mesh.owned; ++c) own += cost[static_cast<std::size_t>(mesh.naturalCell[at(c)])];
  const double mean = std::accumulate(cost.begin(), cost.end(), 0.0) / mesh.ranks;
  // A cut of the curve cannot split a cell.
  EXPECT_LE(maxOverRanks(own) / mean, 1.0 + 20e-4 / mean + 1e-12);
}

TEST(MeshPartition, WeightsChangeWhoOwnsACellButNotWhatItIs) {
  std::vector<double> cost(20 * 20, 1.0);
  std::fill_n(cost.begin(), 100, 10.0);
  const auto share = shareOf(cost);
  const Mesh weighted(MPI_COMM_WORLD, unitBox(20, 20), {.weight = share});
  const Mesh whole(MPI_COMM_SELF, unitBox(20, 20));
  EXPECT_EQ(sumOverRanks(weighted.owned), 400.0);
  for (int c = 0; c < weighted.cells; ++c)
    EXPECT_EQ(weighted.centre[at(c)], whole.centre[at(whole.findOwned(weighted.naturalCell[at(c)]))]);
}

TEST(MeshPartition, CostsNotYetMeasuredCountAsEqual) {
  const auto none = shareOf(std::vector<double>(144, 0.0));
  const Mesh unknown(MPI_COMM_WORLD, unitBox(12, 12), {.weight = none});
  const Mesh equal(MPI_COMM_WORLD, unitBox(12, 12));
  EXPECT_EQ(unknown.naturalCell, equal.naturalCell);
}

// Whether the mesh owns every cell once, leaves no rank without, and can exchange a halo.
void expectWorkingMesh(const Mesh& mesh) {
  EXPECT_GE(mesh.owned, 1);
  auto all = gatherAll(std::vector<std::int64_t>(mesh.naturalCell.begin(), mesh.naturalCell.begin() + mesh.owned));
  std::sort(all.begin(), all.end());
  ASSERT_EQ(static_cast<std::int64_t>(all.size()), mesh.totalCells);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<std::int64_t>(i));
  const double surface = 2.0 * static_cast<double>(mesh.box->vertices[0].size() + mesh.box->vertices[1].size() - 2);
  EXPECT_EQ(sumOverRanks(mesh.boundaryFaces()), surface);
  for (int c = 0; c < mesh.owned; ++c) EXPECT_EQ(mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)], 4);

  HaloExchange halo(mesh);
  std::vector<double> values(at(mesh.cells), -1.0);
  for (int c = 0; c < mesh.owned; ++c) values[at(c)] = static_cast<double>(mesh.naturalCell[at(c)]);
  halo.update(values, 1);
  for (int c = 0; c < mesh.cells; ++c) EXPECT_EQ(values[at(c)], static_cast<double>(mesh.naturalCell[at(c)]));
}

TEST(MeshPartition, TinyMeshesWorkAndTooSmallOnesAreInputErrors) {
  for (int columns = 1; columns <= 5; ++columns) {
    for (int rows = 1; rows <= 4; ++rows) {
      SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
      if (columns * rows >= worldSize()) {
        for (const Partitioner by : everyPartitioner)
          expectWorkingMesh(Mesh(MPI_COMM_WORLD, unitBox(columns, rows), {.by = by}));
        continue;
      }
      const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, unitBox(columns, rows)); });
      EXPECT_THAT(message, testing::MatchesRegex("the mesh has . cells, fewer than the . ranks .*"));
      EXPECT_TRUE(sameOnAllRanks(message));
    }
  }
}

TEST(MeshPartition, OneCellThatOutweighsAllOthersLeavesNoRankWithoutCells) {
  for (const int columns : {2, 4, 9}) {
    std::vector<double> cost(at(columns * 4), 1.0);
    cost[5] = 1e6;
    const auto share = shareOf(cost);
    for (const Partitioner by : everyPartitioner)
      expectWorkingMesh(Mesh(MPI_COMM_WORLD, unitBox(columns, 4), {by, share}));
  }
}

TEST(MeshPartition, StripOneCellWideWorksAlongEitherAxis) {
  expectWorkingMesh(Mesh(MPI_COMM_WORLD, unitBox(50, 1)));
  expectWorkingMesh(Mesh(MPI_COMM_WORLD, unitBox(1, 50)));
}

}  // namespace
}  // namespace lampblack::test
