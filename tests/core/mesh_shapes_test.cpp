// Meshes of any cells: measures, closed surfaces, neighbours, numbers, and what is wrong with a mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/halo_exchange.hpp"
#include "core/hilbert.hpp"
#include "core/rank_exchange.hpp"
#include "core/sorted_numbers.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/skewed_mesh.hpp"

namespace lampblack::test {
namespace {

MeshSpec smallBox(Cells cells) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.5, {{2.0, 6, 2.0}}), gradedAxis(-1.0, {{1.0, 5, 0.5}}), {}};
  const bool isSpace = cells >= Cells::Hexahedra;
  if (isSpace) spec.vertices[2] = gradedAxis(0.0, {{1.5, 4, 1.5}});
  for (int axis = 0; axis < (isSpace ? 3 : 2); ++axis)
    for (const bool atMax : {false, true})
      spec.patches.push_back({std::string(1, "xyz"[axis]) + (atMax ? "-max" : "-min"), axis, atMax});
  return spec;
}

class MeshShapes : public testing::TestWithParam<Cells> {
 protected:
  MeshSpec spec = smallBox(GetParam());
  SkewedMesh skewed{MPI_COMM_WORLD, spec, GetParam(), 0.2};
  Mesh mesh{MPI_COMM_WORLD, skewed.block(), Geometry::Planar};
};

INSTANTIATE_TEST_SUITE_P(Cells, MeshShapes,
                         testing::Values(Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane, Cells::Hexahedra,
                                         Cells::Tetrahedra, Cells::Prisms, Cells::MixedSpace));

TEST_P(MeshShapes, VolumesAddUpAndRanksOwnEveryCellOnce) {
  double volume = 0.0;
  for (int c = 0; c < mesh.owned; ++c) volume += mesh.volume[at(c)];
  EXPECT_NEAR(sumOverRanks(volume), 3.0 * (mesh.dimension == 3 ? 1.5 : 1.0), 1e-12);
  auto all = gatherAll(std::vector<std::int64_t>(mesh.naturalCell.begin(), mesh.naturalCell.begin() + mesh.owned));
  std::ranges::sort(all);
  std::vector<std::int64_t> expected(static_cast<std::size_t>(mesh.totalCells));
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all, expected);
}

TEST_P(MeshShapes, SurfacesAreClosedAndPointFromLowToHigh) {
  for (int c = 0; c < mesh.owned; ++c) {
    Vector3 total{};
    double volume = 0.0;
    for (int k = mesh.faceStart[at(c)]; k < mesh.faceStart[at(c) + 1]; ++k) {
      const auto f = at(mesh.faceOfCell[at(k)]);
      const double sign = mesh.low[f] == c ? 1.0 : -1.0;
      const Vector3 outwards = scaled(mesh.normal[f], sign * mesh.area[f]);
      total = sum(total, outwards);
      const Vector3 from = difference(mesh.faceCentre[f], mesh.centre[at(c)]);
      EXPECT_GT(dot(from, outwards), 0.0);
      volume += dot(from, outwards) / mesh.dimension;
    }
    EXPECT_LT(length(total), 1e-14);
    // Divergence of the place vector; exact where faces are plane.
    EXPECT_NEAR(volume, mesh.volume[at(c)], (mesh.dimension == 2 ? 1e-13 : 2e-2) * mesh.volume[at(c)]);
  }
  for (int f = 0; f < mesh.faces; ++f) {
    EXPECT_GT(mesh.distance[at(f)], 0.0);
    EXPECT_NEAR(dot(mesh.step[at(f)], mesh.normal[at(f)]), mesh.distance[at(f)], 1e-14);
    if (mesh.high[at(f)] < 0) continue;
    const Vector3 step = difference(mesh.centre[at(mesh.high[at(f)])], mesh.centre[at(mesh.low[at(f)])]);
    EXPECT_LT(length(difference(step, mesh.step[at(f)])), 1e-13);
    EXPECT_LT(mesh.naturalCell[at(mesh.low[at(f)])], mesh.naturalCell[at(mesh.high[at(f)])]);
  }
}

TEST_P(MeshShapes, LinearFieldsAreRightAtTheFacesWithObliqueAndOffset) {
  const Vector3 slope{2.0, -3.0, mesh.dimension == 3 ? 0.7 : 0.0};
  for (int face = 0; face < mesh.interiorFaces; ++face) {
    const auto f = at(face);
    const double low = dot(slope, mesh.centre[at(mesh.low[f])]), high = dot(slope, mesh.centre[at(mesh.high[f])]);
    const double along = (high - low) / mesh.distance[f] + dot(slope, mesh.oblique[f]);
    if (length(mesh.oblique[f]) < Mesh::mostOblique * (1.0 - 1e-12)) {
      EXPECT_NEAR(along, dot(slope, mesh.normal[f]), 1e-12);
    } else {
      EXPECT_LT(mesh.distance[f] * std::hypot(1.0, Mesh::mostOblique), 1.02 * mesh.spacing(face));
    }
    const double value = mesh.lowWeight[f] * low + (1.0 - mesh.lowWeight[f]) * high + dot(slope, mesh.offset[f]);
    EXPECT_NEAR(value, dot(slope, mesh.faceCentre[f]), 1e-12);
  }
}

TEST_P(MeshShapes, PatchesStandWhereTheBoxHasThem) {
  double faces = 0.0, area = 0.0;
  for (int f = mesh.interiorFaces; f < mesh.faces; ++f) {
    const Vector3& n = mesh.normal[at(f)];
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(n[at(i)]) > std::abs(n[at(axis)])) axis = i;
    EXPECT_EQ(mesh.patchName(f), std::string(1, "xyz"[axis]) + (n[at(axis)] > 0.0 ? "-max" : "-min"));
    area += mesh.area[at(f)];
    faces += 1.0;
  }
  EXPECT_GT(sumOverRanks(faces), 0.0);
  EXPECT_NEAR(sumOverRanks(area), mesh.dimension == 2 ? 7.0 : 2.0 * (3.0 + 1.5 * 1.5 + 2.0 * 1.5), 1e-12);
}

TEST_P(MeshShapes, FacesHaveTheSameNumbersAndMeasuresOnAnyNumberOfRanks) {
  const SkewedMesh alone(MPI_COMM_SELF, spec, GetParam(), 0.2);
  const Mesh whole(MPI_COMM_SELF, alone.block(), Geometry::Planar);
  EXPECT_EQ(mesh.totalFaces, whole.totalFaces);
  EXPECT_EQ(whole.totalFaces, whole.faces);
  EXPECT_EQ(mesh.totalVertices, whole.totalVertices);
  EXPECT_EQ(static_cast<std::size_t>(whole.totalVertices), whole.vertex.size());
  std::vector<int> byNumber(at(whole.faces));
  for (int f = 0; f < whole.faces; ++f) byNumber[static_cast<std::size_t>(whole.faceNumber[at(f)])] = f;
  for (int f = 0; f < mesh.faces; ++f) {
    const auto g = at(byNumber[static_cast<std::size_t>(mesh.faceNumber[at(f)])]);
    EXPECT_EQ(mesh.naturalCell[at(mesh.low[at(f)])], whole.naturalCell[at(whole.low[g])]);
    EXPECT_EQ(mesh.high[at(f)] < 0, whole.high[g] < 0);
    EXPECT_EQ(mesh.area[at(f)], whole.area[g]);
    EXPECT_EQ(mesh.normal[at(f)], whole.normal[g]);
    EXPECT_EQ(mesh.step[at(f)], whole.step[g]);
    EXPECT_EQ(mesh.lowWeight[at(f)], whole.lowWeight[g]);
    EXPECT_EQ(mesh.lowSide[at(f)], whole.lowSide[g]);
    EXPECT_EQ(mesh.highSide[at(f)], whole.highSide[g]);
  }
  for (int c = 0; c < mesh.owned; ++c) {
    const int other = whole.findOwned(mesh.naturalCell[at(c)]);
    ASSERT_EQ(mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)],
              whole.faceStart[at(other) + 1] - whole.faceStart[at(other)]);
    for (int k = 0; k < mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)]; ++k)
      EXPECT_EQ(mesh.faceNumber[at(mesh.faceOfCell[at(mesh.faceStart[at(c)] + k)])],
                whole.faceNumber[at(whole.faceOfCell[at(whole.faceStart[at(other)] + k)])]);
    for (int k = mesh.cornerStart[at(c)], j = whole.cornerStart[at(other)]; k < mesh.cornerStart[at(c) + 1]; ++k, ++j) {
      EXPECT_EQ(mesh.vertexNumber[at(mesh.corner[at(k)])], whole.vertexNumber[at(whole.corner[at(j)])]);
      EXPECT_EQ(mesh.vertex[at(mesh.corner[at(k)])], whole.vertex[at(whole.corner[at(j)])]);
    }
  }
}

TEST_P(MeshShapes, HaloIsExchanged) {
  HaloExchange halo(mesh);
  std::vector<double> values(at(mesh.cells), -1.0);
  for (int c = 0; c < mesh.owned; ++c) values[at(c)] = static_cast<double>(mesh.naturalCell[at(c)]);
  halo.update(values, 1);
  for (int c = 0; c < mesh.cells; ++c) EXPECT_EQ(values[at(c)], static_cast<double>(mesh.naturalCell[at(c)]));
}

TEST(MeshOfBlocks, CellsAndVerticesThatAreLeftOutAreNotCounted) {
  MeshSpec spec = unitBox(6, 4);
  spec.leftOut = {{{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}}, {{4.0, 3.0, 0.0}, {5.0, 4.0, 0.0}}};
  spec.patches.push_back({"step", 0, false, 0.0, 0.0, 0});
  spec.patches.push_back({"lip", 0, false, 0.0, 0.0, 1});
  const Mesh mesh(MPI_COMM_WORLD, spec);
  EXPECT_EQ(mesh.totalCells, 21);
  EXPECT_EQ(mesh.totalVertices, 35 - 2);
  EXPECT_EQ(sumOverRanks(mesh.owned), 21.0);
  std::map<std::string, double> length;
  for (int f = mesh.interiorFaces; f < mesh.faces; ++f) length[mesh.patchName(f)] += mesh.area[at(f)];
  EXPECT_EQ(sumOverRanks(length["step"]), 3.0);
  EXPECT_EQ(sumOverRanks(length["lip"]), 3.0);
  EXPECT_EQ(sumOverRanks(length["bottom"]), 4.0);
  EXPECT_EQ(sumOverRanks(length["left"]), 3.0);
  EXPECT_EQ(sumOverRanks(length["top"]), 5.0);
  spec.leftOut = {{{-1.0, -1.0, 0.0}, {7.0, 7.0, 0.0}}};
  EXPECT_THAT(messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, spec); }), testing::HasSubstr("left out"));
}

TEST(MeshOfBlocks, AMapBendsTheBox) {
  MeshSpec spec = unitBox(8, 4);
  spec.map = [](const Vector3& x) {
    return Vector3{x[0], x[1] + 0.5 * std::sin(0.4 * x[0]) * (4.0 - x[1]) / 4.0, 0.0};
  };
  const Mesh mesh(MPI_COMM_WORLD, spec);
  EXPECT_TRUE(mesh.isOblique());
  double floor = 0.0;
  for (int f = mesh.interiorFaces; f < mesh.faces; ++f)
    if (mesh.patchName(f) == "bottom") floor += mesh.area[at(f)];
  double exact = 0.0;
  for (int i = 0; i < 8; ++i) exact += std::hypot(1.0, 0.5 * (std::sin(0.4 * (i + 1)) - std::sin(0.4 * i)));
  EXPECT_NEAR(sumOverRanks(floor), exact, 1e-13);
}

TEST(MeshOfBlocks, AShearedBoxIsObliqueButItsFacesAreMetInTheMiddle) {
  MeshSpec spec = unitBox(8, 5);
  spec.map = [](const Vector3& x) { return Vector3{x[0] + 0.25 * x[1], x[1], 0.0}; };
  const Mesh mesh(MPI_COMM_WORLD, spec);
  EXPECT_FALSE(mesh.isSkewed());
  ASSERT_EQ(mesh.oblique.size(), at(mesh.faces));
  // The angle between the lines along an axis and the normals of the faces they pass is that of the shear.
  for (int f = 0; f < mesh.interiorFaces; ++f) EXPECT_NEAR(length(mesh.oblique[at(f)]), 0.25, 1e-14);
}

// More cells than travel at once (valuesInPortion), so that faces meet and cells move in several portions.
TEST(MeshOfBlocks, ALargeMeshIsMadeInPortions) {
  const int columns = 400, rows = 600;
  ASSERT_GT(4U * at(columns * rows), 3U * valuesInPortion);
  const Mesh mesh(MPI_COMM_WORLD, unitBox(columns, rows));
  EXPECT_EQ(mesh.totalFaces, columns * (rows + 1) + rows * (columns + 1));
  EXPECT_EQ(mesh.totalVertices, (columns + 1) * (rows + 1));
  EXPECT_EQ(sumOverRanks(mesh.owned), columns * rows);
  EXPECT_EQ(sumOverRanks(mesh.boundaryFaces()), 2 * (columns + rows));
  int wrong = 0;
  for (int f = 0; f < mesh.faces; ++f) {
    const std::int64_t low = mesh.naturalCell[at(mesh.low[at(f)])], column = low % columns, row = low / columns;
    // The cell's middle, and half a cell further where the face is.
    const Vector3 middle{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, 0.0};
    wrong += mesh.centre[at(mesh.low[at(f)])] == middle ? 0 : 1;
    wrong += mesh.faceCentre[at(f)] == sum(middle, scaled(mesh.normal[at(f)], 0.5)) ? 0 : 1;
    if (mesh.high[at(f)] < 0) {
      const std::string side = mesh.normal[at(f)][0] < 0.0   ? "left"
                               : mesh.normal[at(f)][0] > 0.0 ? "right"
                               : mesh.normal[at(f)][1] < 0.0 ? "bottom"
                                                             : "top";
      wrong += mesh.patchName(f) == side ? 0 : 1;
      continue;
    }
    const std::int64_t step = mesh.naturalCell[at(mesh.high[at(f)])] - low;
    wrong += step == (mesh.normal[at(f)][0] > 0.5 ? 1 : columns) ? 0 : 1;
    if (f > 0) wrong += mesh.faceNumber[at(f)] > mesh.faceNumber[at(f) - 1] ? 0 : 1;
  }
  for (int c = 0; c < mesh.owned; ++c) wrong += mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)] == 4 ? 0 : 1;
  EXPECT_EQ(wrong, 0);
}

// What each side asks, of numbers that many ranks ask for and that nobody has asked for, in two portions.
TEST(RankExchange, AnswersComeInTheOrderOfTheQuestions) {
  const std::int64_t total = 1000;
  const Shares shares(total, worldSize());
  std::vector<std::int64_t> numbers(worldRank() == 0 ? valuesInPortion + 5 : 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int64_t>(i * 7919) % total;
  const auto answers = ask<std::array<std::int64_t, 2>>(MPI_COMM_WORLD, shares, numbers, [&](std::int64_t number) {
    return std::array<std::int64_t, 2>{number * number, worldRank()};
  });
  ASSERT_EQ(answers.size(), numbers.size());
  int wrong = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    wrong += answers[i] == std::array<std::int64_t, 2>{numbers[i] * numbers[i], shares.rankOf(numbers[i])} ? 0 : 1;
  EXPECT_EQ(wrong, 0);
}

TEST(SortedNumbers, EachStandsOnceAndIsFoundFromAnyHint) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < 200000; ++i) numbers.push_back(3 * (i * 7919 % 70000));
  const std::vector<std::int64_t> sorted = sortedOnce(numbers);
  ASSERT_EQ(sorted.size(), 70000U);
  for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<std::int64_t>(3 * i));
  CornerFinder finder(sorted);
  for (std::size_t i = 0; i < 20000; ++i)
    ASSERT_EQ(finder.indexOf(i % 8, numbers[i]), static_cast<std::size_t>(numbers[i] / 3));
  EXPECT_EQ(indexIn(sorted, 4), 2U);
}

// Of 4 x 3 cells sheared along x by five times their height, the faces across y and their steps are 79 degrees apart;
// those across x lean as much.
TEST(MeshOfBlocks, FacesTurnedTooFarAreCutAndCounted) {
  MeshSpec spec = unitBox(4, 3);
  spec.map = [](const Vector3& x) { return Vector3{x[0] + 5.0 * x[1], x[1], 0.0}; };
  const Mesh mesh(MPI_COMM_WORLD, spec);
  // All of them: 5 x 3 across x and 4 x 4 across y.
  EXPECT_EQ(mesh.facesBeyond, 31);
  for (const Vector3& oblique : mesh.oblique) EXPECT_NEAR(length(oblique), Mesh::mostOblique, 1e-12);
  spec.map = [](const Vector3& x) { return Vector3{x[0] + 3.5 * x[1], x[1], 0.0}; };
  const Mesh less(MPI_COMM_WORLD, spec);
  EXPECT_EQ(less.facesBeyond, 0);
  for (const Vector3& oblique : less.oblique) EXPECT_NEAR(length(oblique), 3.5, 1e-12);
}

TEST(MeshOfBlocks, AFoldedCellIsAnInputErrorThatSaysWhere) {
  MeshSpec spec = unitBox(3, 3);
  spec.map = [](const Vector3& x) { return x[0] == 1.0 && x[1] == 1.0 ? Vector3{2.5, 2.5, 0.0} : x; };
  const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, spec); });
  EXPECT_THAT(message, testing::HasSubstr("is folded"));
  EXPECT_THAT(message, testing::HasSubstr("quadrilateral at ("));
  EXPECT_TRUE(sameOnAllRanks(message));
}

TEST(MeshOfBlocks, ThreeCellsAtOneFaceAreAnInputError) {
  SkewedMesh skewed(MPI_COMM_WORLD, smallBox(Cells::Quadrilaterals), Cells::Quadrilaterals, 0.0);
  MeshBlock block = skewed.block();
  // The last rank has its last cell twice.
  const bool isLast = worldRank() == worldSize() - 1;
  ++block.totalCells;
  if (isLast) {
    block.shapes.push_back(block.shapes.back());
    for (int i = 0; i < 4; ++i) block.corners.push_back(block.corners[block.corners.size() - 4]);
  }
  const auto message = messageOf<InputError>([&] { Mesh(MPI_COMM_WORLD, block, Geometry::Planar); });
  EXPECT_THAT(message, testing::HasSubstr("three cells"));
  EXPECT_TRUE(sameOnAllRanks(message));
}

TEST(Hilbert, NeighboursAlongTheCurveAreNeighboursInSpace) {
  for (const int dimension : {2, 3}) {
    const int n = 8, all = dimension == 2 ? n * n : n * n * n;
    std::vector<std::pair<std::uint64_t, std::array<int, 3>>> cells;
    for (int c = 0; c < all; ++c) {
      const std::array<int, 3> index{c % n, c / n % n, c / (n * n)};
      Vector3 place{};
      for (std::size_t i = 0; i < 3; ++i) place[i] = (index[i] + 0.5) / n;
      cells.emplace_back(hilbertIndex(place, dimension), index);
    }
    std::ranges::sort(cells);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      EXPECT_NE(cells[i].first, cells[i - 1].first);
      int steps = 0;
      for (std::size_t a = 0; a < 3; ++a) steps += std::abs(cells[i].second[a] - cells[i - 1].second[a]);
      EXPECT_EQ(steps, 1);
    }
  }
}

}  // namespace
}  // namespace lampblack::test
