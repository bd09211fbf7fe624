// Cells of a distributed mesh: numbering, halo, measures; and what makes a mesh wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/errors.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class MeshCells : public testing::TestWithParam<Geometry> {
 protected:
  Mesh mesh{MPI_COMM_WORLD, gradedBox(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Geometry, MeshCells, testing::Values(Geometry::Planar, Geometry::Axisymmetric),
                         [](const auto& tested) {
                           return tested.param == Geometry::Planar ? "Planar" : "Axisymmetric";
                         });

TEST_P(MeshCells, CountsAndArraySizesAgree) {
  EXPECT_EQ(mesh.rank, worldRank());
  EXPECT_EQ(mesh.ranks, worldSize());
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.totalVertices, 16 * 12);
  EXPECT_EQ(mesh.totalFaces, 16 * 11 + 15 * 12);
  EXPECT_EQ(mesh.totalCells, 165);
  EXPECT_EQ(sumOverRanks(mesh.owned), 165.0);
  EXPECT_GE(mesh.owned, 1);
  EXPECT_EQ(mesh.naturalCell.size(), at(mesh.cells));
  EXPECT_EQ(mesh.haloRank.size(), at(mesh.cells - mesh.owned));
  EXPECT_EQ(mesh.centre.size(), at(mesh.cells));
  EXPECT_EQ(mesh.volume.size(), at(mesh.cells));
  EXPECT_EQ(mesh.planarArea.size(), at(mesh.cells));
  EXPECT_EQ(mesh.cells == mesh.owned, mesh.ranks == 1);
}

TEST_P(MeshCells, RanksTogetherOwnEveryCellOnce) {
  auto all = gatherAll(std::vector<std::int64_t>(mesh.naturalCell.begin(), mesh.naturalCell.begin() + mesh.owned));
  std::sort(all.begin(), all.end());
  std::vector<std::int64_t> expected(165);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all, expected);
}

TEST_P(MeshCells, NaturalIndexIsColumnPlusRowTimesColumns) {
  const auto& x = mesh.box->vertices;
  for (int c = 0; c < mesh.cells; ++c) {
    const auto i = static_cast<std::size_t>(mesh.naturalCell[at(c)] % 15);
    const auto j = static_cast<std::size_t>(mesh.naturalCell[at(c)] / 15);
    EXPECT_EQ(mesh.centre[at(c)][0], 0.5 * (x[0][i] + x[0][i + 1]));
    EXPECT_EQ(mesh.centre[at(c)][1], 0.5 * (x[1][j] + x[1][j + 1]));
  }
}

TEST_P(MeshCells, OwnedCellsAreOrderedByNaturalIndexAndFound) {
  EXPECT_TRUE(std::is_sorted(mesh.naturalCell.begin(), mesh.naturalCell.begin() + mesh.owned));
  for (int c = 0; c < mesh.owned; ++c) EXPECT_EQ(mesh.findOwned(mesh.naturalCell[at(c)]), c);
  for (int c = mesh.owned; c < mesh.cells; ++c) EXPECT_EQ(mesh.findOwned(mesh.naturalCell[at(c)]), -1);
  EXPECT_EQ(mesh.findOwned(-1), -1);
  EXPECT_EQ(mesh.findOwned(165), -1);
}

TEST_P(MeshCells, HaloIsExactlyTheFaceNeighboursOfOwnedCellsUnderTheirOwners) {
  std::vector<std::int64_t> ownerOf(165, 0);
  for (int c = 0; c < mesh.owned; ++c) ownerOf[static_cast<std::size_t>(mesh.naturalCell[at(c)])] = mesh.rank;
  MPI_Allreduce(MPI_IN_PLACE, ownerOf.data(), 165, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);

  std::set<std::pair<std::int64_t, std::int64_t>> expected;  // (owner, natural): the order of the halo
  for (int c = 0; c < mesh.owned; ++c) {
    const std::int64_t natural = mesh.naturalCell[at(c)];
    const std::int64_t i = natural % 15;
    const std::int64_t j = natural / 15;
    const auto see = [&](std::int64_t ni, std::int64_t nj) {
      if (ni < 0 || ni >= 15 || nj < 0 || nj >= 11) return;
      const std::int64_t n = ni + nj * 15;
      if (mesh.findOwned(n) < 0) expected.emplace(ownerOf[static_cast<std::size_t>(n)], n);
    };
    see(i - 1, j);
    see(i + 1, j);
    see(i, j - 1);
    see(i, j + 1);
  }
  std::vector<std::pair<std::int64_t, std::int64_t>> halo;
  for (int c = mesh.owned; c < mesh.cells; ++c)
    halo.emplace_back(mesh.haloRank[at(c - mesh.owned)], mesh.naturalCell[at(c)]);
  EXPECT_EQ(halo, (std::vector<std::pair<std::int64_t, std::int64_t>>(expected.begin(), expected.end())));
}

TEST_P(MeshCells, TotalMeasuresAreTheBoxs) {
  double volume = 0.0;
  double planar = 0.0;
  for (int c = 0; c < mesh.owned; ++c) {
    volume += mesh.volume[at(c)];
    planar += mesh.planarArea[at(c)];
  }
  const double exactPlanar = 0.02 * 0.04;
  const double exactVolume = mesh.axisymmetric() ? 0.5 * 0.02 * 0.02 * 0.04 : exactPlanar;  // per radian
  // A sum of n positive terms is right to n epsilon; each term has at most 6 roundings.
  const double relative = (165.0 + 6.0) * epsilon;
  EXPECT_NEAR(sumOverRanks(planar), exactPlanar, relative * exactPlanar);
  EXPECT_NEAR(sumOverRanks(volume), exactVolume, relative * exactVolume);
}

TEST_P(MeshCells, EachVolumeIsTheExactIntegral) {
  const auto& x = mesh.box->vertices;
  for (int c = 0; c < mesh.cells; ++c) {
    const auto i = static_cast<std::size_t>(mesh.naturalCell[at(c)] % 15);
    const auto j = static_cast<std::size_t>(mesh.naturalCell[at(c)] / 15);
    const double height = x[1][j + 1] - x[1][j];
    const double inner = x[0][i];
    const double outer = x[0][i + 1];
    const double exact =
        mesh.axisymmetric() ? 0.5 * (outer * outer - inner * inner) * height : (outer - inner) * height;
    // The difference of squares cancels: its rounding is relative to outer^2.
    EXPECT_NEAR(mesh.volume[at(c)], exact,
                4.0 * epsilon * (exact + (mesh.axisymmetric() ? outer * outer * height : 0.0)));
  }
}

TEST(MeshInput, AxisWithoutCellsIsAnInputErrorOnAllRanks) {
  for (const std::size_t axis : {0u, 1u}) {
    for (const std::vector<double>& vertices : {std::vector<double>{}, {0.0}}) {
      MeshSpec spec = unitBox(4, 4);
      spec.vertices[axis] = vertices;
      const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, spec); });
      EXPECT_THAT(message, testing::HasSubstr("has no cells"));
      EXPECT_THAT(message, testing::Not(testing::StartsWith("other")));
      EXPECT_TRUE(sameOnAllRanks(message));
    }
  }
}

TEST(MeshInput, VerticesThatDoNotIncreaseOrAreNotFiniteAreInputErrors) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& vertices : {std::vector<double>{0.0, 1.0, 1.0},
                                              {0.0, 2.0, 1.0},
                                              {0.0, nan, 1.0},
                                              {0.0, 1.0, infinity},
                                              {-infinity, 0.0, 1.0}}) {
    MeshSpec spec = unitBox(4, 4);
    spec.vertices[1] = vertices;
    EXPECT_THROW(Mesh(MPI_COMM_WORLD, spec), InputError);
  }
}

TEST(MeshInput, NegativeRadiusIsAnInputErrorOnlyWhenAxisymmetric) {
  MeshSpec spec = unitBox(4, 4);
  spec.vertices[0] = {-1.0, 0.0, 1.0};
  EXPECT_NO_THROW(Mesh(MPI_COMM_WORLD, spec));
  spec.geometry = Geometry::Axisymmetric;
  EXPECT_THROW(Mesh(MPI_COMM_WORLD, spec), InputError);
}

TEST(MeshInput, CellWeightsOfTheWrongLengthAreRefusedOnAllRanksEvenIfOnlyOneRankHasThem) {
  std::vector<double> weight = shareOf(std::vector<double>(16, 1.0));
  const std::size_t count = weight.size();
  if (worldRank() == worldSize() - 1) weight.pop_back();
  EXPECT_THAT(messageOf<std::runtime_error>([&] { Mesh(MPI_COMM_WORLD, unitBox(4, 4), {.weight = weight}); }),
              testing::HasSubstr("cell weights for"));
  EXPECT_EQ(shareOf(std::vector<double>(16, 1.0)).size(), count);
}

}  // namespace
}  // namespace lampblack::test
