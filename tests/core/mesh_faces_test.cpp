// Faces of a distributed mesh: closed cells, metrics on graded axes, patches, and sameness on any number of ranks.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "core/mesh_parts.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class MeshFaces : public testing::TestWithParam<Geometry> {
 protected:
  // +1 when the face's normal points out of the cell.
  [[nodiscard]] double outward(int face, int cell) const {
    return (mesh.low[at(face)] == cell ? 1.0 : -1.0) * signOf(mesh, face);
  }
  // m, from the vertices of the cell that the face points out of.
  [[nodiscard]] double planarLength(int face) const {
    const auto along = at(1 - axisOf(mesh, face));
    const auto& v = mesh.box->vertices[along];
    const std::int64_t cell = mesh.naturalCell[at(mesh.low[at(face)])];
    const auto i = static_cast<std::size_t>(along == 0 ? cell % 15 : cell / 15);
    return v[i + 1] - v[i];
  }
  Mesh mesh{MPI_COMM_WORLD, gradedBox(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Geometry, MeshFaces, testing::Values(Geometry::Planar, Geometry::Axisymmetric),
                         [](const auto& tested) {
                           return tested.param == Geometry::Planar ? "Planar" : "Axisymmetric";
                         });

TEST_P(MeshFaces, CountsAndArraySizesAgree) {
  for (const auto& values : {mesh.low, mesh.high}) EXPECT_EQ(values.size(), at(mesh.faces));
  for (const auto& values : {mesh.normal, mesh.faceCentre, mesh.step}) EXPECT_EQ(values.size(), at(mesh.faces));
  for (const auto& values : {mesh.area, mesh.distance, mesh.lowWeight}) EXPECT_EQ(values.size(), at(mesh.faces));
  EXPECT_FALSE(mesh.isOblique());
  EXPECT_FALSE(mesh.isSkewed());
  EXPECT_EQ(mesh.patch.size(), at(mesh.boundaryFaces()));
  EXPECT_EQ(sumOverRanks(mesh.boundaryFaces()), 2.0 * (15 + 11));
  // A face between two ranks is on both, counted by half.
  double interior = 0.0;
  for (int f = 0; f < mesh.interiorFaces; ++f)
    interior += mesh.low[at(f)] < mesh.owned && mesh.high[at(f)] < mesh.owned ? 1.0 : 0.5;
  EXPECT_EQ(sumOverRanks(interior), 14.0 * 11 + 15.0 * 10);
}

TEST_P(MeshFaces, EveryFaceTouchesAnOwnedCellAndPointsFromTheSmallerNaturalIndex) {
  for (int f = 0; f < mesh.faces; ++f) {
    const int low = mesh.low[at(f)];
    const int high = mesh.high[at(f)];
    if (f >= mesh.interiorFaces) {
      EXPECT_EQ(high, -1);
      EXPECT_LT(low, mesh.owned);
      continue;
    }
    ASSERT_GE(high, 0);
    EXPECT_TRUE(low < mesh.owned || high < mesh.owned);
    EXPECT_EQ(signOf(mesh, f), 1.0);
    EXPECT_EQ(mesh.naturalCell[at(high)] - mesh.naturalCell[at(low)], axisOf(mesh, f) == 0 ? 1 : 15);
  }
}

TEST_P(MeshFaces, SurfaceOfEveryOwnedCellIsClosed) {
  for (int c = 0; c < mesh.owned; ++c) {
    double planar[2] = {0.0, 0.0};
    double metric[2] = {0.0, 0.0};
    double largest = 0.0;
    ASSERT_EQ(mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)], 4);
    for (int k = mesh.faceStart[at(c)]; k < mesh.faceStart[at(c) + 1]; ++k) {
      const int f = mesh.faceOfCell[at(k)];
      const auto axis = at(axisOf(mesh, f));
      planar[axis] += outward(f, c) * planarLength(f);
      metric[axis] += outward(f, c) * mesh.area[at(f)];
      largest = std::max(largest, mesh.area[at(f)]);
    }
    // Opposite faces are differences of the same two vertices: exactly equal.
    EXPECT_EQ(planar[0], 0.0);
    EXPECT_EQ(planar[1], 0.0);
    EXPECT_EQ(metric[1], 0.0);
    // The integral of n_r r dl around a cell is its planar area (the hoop term); two products and a sum are rounded.
    EXPECT_NEAR(metric[0], mesh.axisymmetric() ? mesh.planarArea[at(c)] : 0.0, 4.0 * epsilon * largest);
  }
}

TEST_P(MeshFaces, AreasAreLengthsTimesRadius) {
  for (int f = 0; f < mesh.faces; ++f) {
    const double radius = mesh.axisymmetric() ? mesh.faceCentre[at(f)][0] : 1.0;
    EXPECT_EQ(mesh.area[at(f)], planarLength(f) * radius);
    const bool onAxis = mesh.faceCentre[at(f)][0] == 0.0;
    if (mesh.axisymmetric()) {
      EXPECT_EQ(mesh.area[at(f)] == 0.0, onAxis);
    }
  }
}

TEST_P(MeshFaces, DistancesRunBetweenCentresAndWeightsReproduceALinearField) {
  for (int f = 0; f < mesh.faces; ++f) {
    const auto axis = at(axisOf(mesh, f));
    const double face = mesh.faceCentre[at(f)][axis];
    const double low = mesh.centre[at(mesh.low[at(f)])][axis];
    // Coordinates are at most 0.03 m and so are known to 0.03 epsilon; a few of them are combined.
    const double tolerance = 6.0 * 0.03 * epsilon;
    EXPECT_GT(mesh.distance[at(f)], 0.0);
    if (f >= mesh.interiorFaces) {
      EXPECT_NEAR(mesh.distance[at(f)], std::abs(face - low), tolerance);
      EXPECT_EQ(mesh.lowWeight[at(f)], 0.0);
      continue;
    }
    const double high = mesh.centre[at(mesh.high[at(f)])][axis];
    const double weight = mesh.lowWeight[at(f)];
    EXPECT_NEAR(mesh.distance[at(f)], high - low, tolerance);
    EXPECT_GT(weight, 0.0);
    EXPECT_LT(weight, 1.0);
    EXPECT_NEAR(weight * low + (1.0 - weight) * high, face, tolerance);
  }
}

TEST_P(MeshFaces, FaceCentreLiesOnBothCellsOutline) {
  const auto& x = mesh.box->vertices;
  for (int f = 0; f < mesh.faces; ++f) {
    const int c = mesh.low[at(f)];
    const auto axis = at(axisOf(mesh, f));
    const std::int64_t natural = mesh.naturalCell[at(c)];
    const std::int64_t index[2] = {natural % 15, natural / 15};
    const auto layer = static_cast<std::size_t>(index[axis]) + (signOf(mesh, f) > 0 ? 1 : 0);
    EXPECT_EQ(mesh.faceCentre[at(f)][axis], x[axis][layer]);
    EXPECT_EQ(mesh.faceCentre[at(f)][1 - axis], mesh.centre[at(c)][1 - axis]);
  }
}

TEST_P(MeshFaces, BoundaryFacesHaveTheFirstPatchThatHoldsThem) {
  double fuelFaces = 0.0;
  for (int f = mesh.interiorFaces; f < mesh.faces; ++f) {
    const auto [x, y, z] = mesh.faceCentre[at(f)];
    EXPECT_EQ(z, 0.0);
    std::string expected = x < 0.01 ? "fuel" : "coflow";
    if (y == 0.03) expected = "outlet";
    if (x == 0.0) expected = "inner";
    if (x == 0.02) expected = "outer";
    EXPECT_EQ(mesh.patchName(f), expected) << "at " << x << ", " << y;
    fuelFaces += expected == "fuel" ? 1.0 : 0.0;
  }
  EXPECT_EQ(sumOverRanks(fuelFaces), 9.0);
}

TEST_P(MeshFaces, RowsListEachFaceOnceUnderEachOfItsCells) {
  ASSERT_EQ(mesh.faceStart.size(), at(mesh.cells) + 1);
  std::vector<int> seen(at(mesh.faces), 0);
  for (int c = 0; c < mesh.cells; ++c) {
    for (int k = mesh.faceStart[at(c)]; k < mesh.faceStart[at(c) + 1]; ++k) {
      const int f = mesh.faceOfCell[at(k)];
      EXPECT_TRUE(mesh.low[at(f)] == c || mesh.high[at(f)] == c);
      ++seen[at(f)];
    }
  }
  for (int f = 0; f < mesh.faces; ++f) EXPECT_EQ(seen[at(f)], f < mesh.interiorFaces ? 2 : 1);
}

TEST_P(MeshFaces, OwnedCellSeesTheSameFacesInTheSameOrderAsOnOneRank) {
  const Mesh whole(MPI_COMM_SELF, gradedBox(GetParam()));
  for (int c = 0; c < mesh.owned; ++c) {
    const int alone = whole.findOwned(mesh.naturalCell[at(c)]);
    ASSERT_GE(alone, 0);
    EXPECT_EQ(mesh.volume[at(c)], whole.volume[at(alone)]);
    for (int k = 0; k < 4; ++k) {
      const auto f = at(mesh.faceOfCell[at(mesh.faceStart[at(c)] + k)]);
      const auto g = at(whole.faceOfCell[at(whole.faceStart[at(alone)] + k)]);
      EXPECT_EQ(mesh.faceCentre[f], whole.faceCentre[g]);
      EXPECT_EQ(mesh.naturalCell[at(mesh.low[f])], whole.naturalCell[at(whole.low[g])]);
      EXPECT_EQ(mesh.area[f], whole.area[g]);
      EXPECT_EQ(mesh.distance[f], whole.distance[g]);
      EXPECT_EQ(mesh.lowWeight[f], whole.lowWeight[g]);
    }
  }
}

// A flux with rounding in every operation, of a field known from the natural index alone.
double fluxOf(const Mesh& mesh, int face) {
  const auto value = [&](int cell) { return std::sin(0.7 * static_cast<double>(mesh.naturalCell[at(cell)])) + 1.1; };
  const auto f = at(face);
  const double low = value(mesh.low[f]);
  if (mesh.high[f] < 0) return signOf(mesh, face) * low * mesh.area[f] / mesh.distance[f];
  const double high = value(mesh.high[f]);
  const double middle = mesh.lowWeight[f] * low + (1.0 - mesh.lowWeight[f]) * high;
  return middle * (low - high) / mesh.distance[f] * mesh.area[f];
}

TEST_P(MeshFaces, TwoRanksFluxesThroughASharedFaceAgreeToTheLastBit) {
  struct Record {
    std::int64_t face;
    double flux;
  };
  std::vector<Record> own;
  for (int f = 0; f < mesh.interiorFaces; ++f)
    own.push_back({mesh.naturalCell[at(mesh.low[at(f)])] * 2 + axisOf(mesh, f), fluxOf(mesh, f)});
  auto all = gatherAll(own);
  std::sort(all.begin(), all.end(), [](const Record& a, const Record& b) { return a.face < b.face; });
  int shared = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].face != all[i - 1].face) continue;
    ++shared;
    EXPECT_EQ(std::memcmp(&all[i].flux, &all[i - 1].flux, sizeof(double)), 0) << "face " << all[i].face;
  }
  EXPECT_EQ(static_cast<int>(all.size()) - shared, 14 * 11 + 15 * 10);
  if (mesh.ranks > 1) {
    EXPECT_GE(shared, 11);  // no straight cut of 15 x 11 cells is shorter
  }
}

TEST_P(MeshFaces, FaceFluxLoopConserves) {
  std::vector<double> gain(at(mesh.cells), 0.0);
  double throughBoundary = 0.0;
  double size = 0.0;
  for (int f = 0; f < mesh.faces; ++f) {
    const double flux = fluxOf(mesh, f);
    size += std::abs(flux);
    gain[at(mesh.low[at(f)])] -= flux;
    if (mesh.high[at(f)] >= 0)
      gain[at(mesh.high[at(f)])] += flux;
    else
      throughBoundary += flux;
  }
  double total = 0.0;
  for (int c = 0; c < mesh.owned; ++c) total += gain[at(c)];
  // Each flux is added twice, in sums of at most as many terms as there are faces.
  const double tolerance = 2.0 * 400.0 * epsilon * sumOverRanks(size);
  EXPECT_NEAR(sumOverRanks(total), -sumOverRanks(throughBoundary), tolerance);
}

TEST(MeshPatches, FaceWithoutAPatchIsTheSameInputErrorOnAllRanks) {
  MeshSpec spec = gradedBox(Geometry::Planar);
  // One face of one cell (of one rank) is left out: the last of the split side.
  const auto& x = spec.vertices[0];
  spec.patches[1].to = x[x.size() - 2];
  const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, spec); });
  EXPECT_THAT(message, testing::StartsWith("the boundary face at (0.0"));
  EXPECT_THAT(message, testing::EndsWith("-0.01) m belongs to no boundary"));
  EXPECT_TRUE(sameOnAllRanks(message));
}

TEST(MeshPatches, SideWithoutAPatchIsAnInputErrorOnAllRanks) {
  for (std::size_t side = 0; side < 4; ++side) {
    MeshSpec spec = unitBox(5, 4);
    spec.patches.erase(spec.patches.begin() + static_cast<std::ptrdiff_t>(side));
    const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, spec); });
    EXPECT_THAT(message, testing::HasSubstr("belongs to no boundary"));
    EXPECT_TRUE(sameOnAllRanks(message));
  }
}

// Three columns of a box of 7 x 5 cells, of which two are left out; the same on any number of ranks.
TEST(MeshParts, AreCountedWithTheirPatches) {
  MeshSpec spec;
  spec.geometry = Geometry::Planar;
  spec.vertices = {gradedAxis(0.0, {{0.7, 7, 1.0}}), gradedAxis(0.0, {{0.5, 5, 1.0}})};
  spec.patches = {{"left", 0, false}, {"right", 0, true}, {"low", 1, false}, {"high", 1, true}};
  for (const double from : {0.2, 0.5}) {
    MeshSpec::LeftOut part;
    part.lower.fill(-1e300);
    part.upper.fill(1e300);
    part.lower[0] = from;
    part.upper[0] = from + 0.1;
    spec.leftOut.push_back(part);
    BoundaryPatch wall;
    wall.name = fmt::format("wall {}", from);
    wall.leftOut = static_cast<int>(spec.leftOut.size()) - 1;
    spec.patches.push_back(wall);
  }
  const std::vector<MeshPart> parts = partsOf(Mesh(MPI_COMM_WORLD, spec));
  ASSERT_EQ(parts.size(), 3U);
  const double places[3] = {0.05, 0.35, 0.65};
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(parts[p].cells, p == 2 ? 5 : 10);
    EXPECT_NEAR(parts[p].place[0], places[p], 1e-12);
    EXPECT_NEAR(parts[p].place[1], 0.05, 1e-12);
  }
  EXPECT_THAT(parts[0].patches, testing::ElementsAre(1, 0, 1, 1, 1, 0));
  EXPECT_THAT(parts[1].patches, testing::ElementsAre(0, 0, 1, 1, 1, 1));
  EXPECT_THAT(parts[2].patches, testing::ElementsAre(0, 1, 1, 1, 0, 1));
  spec.leftOut.resize(1);
  spec.patches.pop_back();
  spec.leftOut[0].upper[1] = 0.45;  // a gap above
  EXPECT_EQ(partsOf(Mesh(MPI_COMM_WORLD, spec)).size(), 1U);
}

}  // namespace
}  // namespace lampblack::test
