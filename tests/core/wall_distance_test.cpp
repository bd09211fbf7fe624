// Distances from walls: faces one by one, and all cells of meshes against all faces of their walls.
#include "core/wall_distance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "core/wall_tree.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/nearest_wall.hpp"
#include "tests/skewed_mesh.hpp"

namespace lampblack::test {
namespace {

using Corners = std::vector<Vector3>;

MeshSpec boxOf(int dimension, int columns, double ratio) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.0, {{2.0, columns, ratio}}), gradedAxis(0.0, {{1.0, 11, 1.0 / ratio}}), {}};
  if (dimension == 3) spec.vertices[2] = gradedAxis(0.0, {{1.5, 7, ratio}});
  for (int axis = 0; axis < dimension; ++axis)
    for (const bool atMax : {false, true})
      spec.patches.push_back({std::string(1, "xyz"[axis]) + (atMax ? "-max" : "-min"), axis, atMax});
  return spec;
}

// The nearest of points spread over the face is at most half their spacing farther than the face, and never nearer.
TEST(DistanceToFace, IsThatOfItsNearestPoint) {
  constexpr int points = 60;
  for (int draw = 0; draw < 60; ++draw) {
    const auto place = [&](int k) {
      return Vector3{noise(draw, 3 * k), noise(draw, 3 * k + 1), noise(draw, 3 * k + 2)};
    };
    const Vector3 a = place(0), b = place(1), c = place(2), from = scaled(place(3), 1.5);
    double ofSegment = 1e300, ofTriangle = 1e300;
    for (int i = 0; i <= points; ++i)
      for (int j = 0; i + j <= points; ++j) {
        const double u = static_cast<double>(i) / points, v = static_cast<double>(j) / points;
        const Vector3 on = sum(a, sum(scaled(difference(b, a), u), scaled(difference(c, a), v)));
        ofTriangle = std::min(ofTriangle, length(difference(from, on)));
        if (j == 0) ofSegment = std::min(ofSegment, length(difference(from, on)));
      }
    const double spacing = 2.0 * std::numbers::sqrt3 / points;  // edges are that long at most
    for (const auto& [found, sampled] : {std::pair{distanceToFace(from, Corners{a, b}), ofSegment},
                                         std::pair{distanceToFace(from, Corners{a, b, c}), ofTriangle}}) {
      EXPECT_LE(found, sampled + 1e-14);
      EXPECT_GE(found, sampled - spacing);
    }
    // A parallelogram is two triangles.
    const Vector3 d = sum(a, difference(c, b));
    EXPECT_NEAR(distanceToFace(from, Corners{a, b, c, d}),
                std::min(distanceToFace(from, Corners{a, b, c}), distanceToFace(from, Corners{a, c, d})), 1e-14);
  }
}

TEST(DistanceToFace, OfASquareByRegions) {
  const Corners square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_DOUBLE_EQ(distanceToFace({0.5, 1.2, -3.0}, square), 3.0);
  EXPECT_DOUBLE_EQ(distanceToFace({5.0, 1.0, 4.0}, square), 5.0);
  EXPECT_DOUBLE_EQ(distanceToFace({-2.0, -3.0, 6.0}, square), 7.0);
}

TEST(WallDistance, InAChannelIsThatFromTheNearerSide) {
  const MeshSpec spec = boxOf(2, 30, 8.0);
  const Mesh mesh(MPI_COMM_WORLD, spec);
  HaloExchange halo(mesh);
  const auto both = wallDistance(mesh, halo, patchesCalled(mesh, {"y-min", "y-max"}));
  const auto one = wallDistance(mesh, halo, patchesCalled(mesh, {"x-max"}));
  for (int c = 0; c < mesh.owned; ++c) {
    const Vector3& x = mesh.centre[at(c)];
    EXPECT_NEAR(both[at(c)], std::min(x[1], 1.0 - x[1]), 1e-14);
    EXPECT_NEAR(one[at(c)], 2.0 - x[0], 1e-14);
  }
}

// A step at the floor and a block in the middle; the sides are no walls.
TEST(WallDistance, AroundSolidsIsThatFromTheNearestOfAllFaces) {
  for (const double ratio : {1.0, 12.0}) {
    MeshSpec spec = boxOf(2, 40, ratio);
    spec.leftOut = {{{-1, -1, -1}, {0.5, 0.4, 1}}, {{1.0, 0.6, -1}, {1.3, 0.9, 1}}};
    spec.patches.push_back({"step", 0, false, -1e300, 1e300, 0});
    spec.patches.push_back({"block", 0, false, -1e300, 1e300, 1});
    const Mesh mesh(MPI_COMM_WORLD, spec);
    expectNearestOfAll(mesh, patchesCalled(mesh, {"step", "block"}));
    expectNearestOfAll(mesh, patchesCalled(mesh, {"block", "y-max"}));
    expectNearestOfAll(mesh, patchesCalled(mesh, {"step"}));
  }
}

// Cells above a block that is no wall itself have their nearest faces straight through it, below: these come by no way
// from cell to cell, and with several ranks from another rank.
TEST(WallDistance, GoesStraightThroughWhatIsNoWall) {
  for (const int dimension : {2, 3}) {
    MeshSpec spec = boxOf(dimension, 40, 1.0);
    spec.leftOut = {{{0.3, 0.2, -1}, {1.7, 0.5, 9}}};
    spec.patches.push_back({"block", 0, false, -1e300, 1e300, 0});
    const Mesh lying(MPI_COMM_WORLD, spec);
    expectNearestOfAll(lying, patchesCalled(lying, {"y-min"}));
    spec.leftOut = {{{0.6, 0.1, -1}, {1.0, 0.9, 9}}};
    const Mesh standing(MPI_COMM_WORLD, spec);
    expectNearestOfAll(standing, patchesCalled(standing, {"x-min"}));
  }
}

class WallDistanceOfShapes : public testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, WallDistanceOfShapes,
                         testing::Values(Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane, Cells::Hexahedra,
                                         Cells::Tetrahedra, Cells::Prisms, Cells::MixedSpace));

TEST_P(WallDistanceOfShapes, IsThatFromTheNearestOfAllFaces) {
  const int dimension = GetParam() >= Cells::Hexahedra ? 3 : 2;
  for (const double ratio : {1.0, 6.0}) {
    const MeshSpec spec = boxOf(dimension, 16, ratio);
    const SkewedMesh skewed(MPI_COMM_WORLD, spec, GetParam(), GetParam() == Cells::MixedSpace ? 0.1 : 0.25);
    const Mesh mesh(MPI_COMM_WORLD, skewed.block(), Geometry::Planar);
    expectNearestOfAll(mesh, patchesCalled(mesh, {"x-min", "y-max"}));
    expectNearestOfAll(mesh, patchesCalled(mesh, {"x-min", "y-min", "y-max", "x-max"}));
  }
}

// A wall that waves, so that cells far away have their nearest faces in several places.
TEST(WallDistance, FromAWavyWallIsThatFromTheNearestOfAllFaces) {
  for (const int dimension : {2, 3}) {
    MeshSpec spec = boxOf(dimension, 24, 1.0);
    spec.map = [](const Vector3& x) {
      return Vector3{x[0], x[1] + (1.0 - x[1]) * 0.3 * std::sin(9.0 * x[0] + 3.0 * x[2]), x[2]};
    };
    const Mesh mesh(MPI_COMM_WORLD, spec);
    expectNearestOfAll(mesh, patchesCalled(mesh, {"y-min"}));
  }
}

// On strongly graded cells the image that comes first need not be the nearer one.
TEST(WallDistance, GoesThroughPeriodicSides) {
  for (const double ratio : {1.0, 3.0, 40.0}) {
    MeshSpec spec;
    spec.vertices = {gradedAxis(0.0, {{2.0, 20, ratio}}), gradedAxis(0.0, {{1.0, 10, 1.0 / ratio}})};
    spec.periodic = {true, true, false};
    spec.leftOut = {{{0.1, 0.2, -1}, {0.4, 0.5, 1}}};
    spec.patches = {{"block", 0, false, -1e300, 1e300, 0}};
    const Mesh mesh(MPI_COMM_WORLD, spec);
    std::vector<Vector3> shifts;
    for (const double x : {-2.0, 0.0, 2.0})
      for (const double y : {-1.0, 0.0, 1.0}) shifts.push_back({x, y, 0.0});
    expectNearestOfAll(mesh, patchesCalled(mesh, {"block"}), shifts);
  }
}

TEST(WallDistance, IsTheSameOnAnyNumberOfRanks) {
  const MeshSpec spec = boxOf(2, 25, 4.0);
  const auto of = [&](MPI_Comm comm) {
    const SkewedMesh skewed(comm, spec, Cells::Triangles, 0.3);
    const Mesh mesh(comm, skewed.block(), Geometry::Planar);
    HaloExchange halo(mesh);
    const auto distances = wallDistance(mesh, halo, patchesCalled(mesh, {"x-min", "y-max"}));
    std::map<std::int64_t, double> byNumber;
    for (int c = 0; c < mesh.owned; ++c) byNumber[mesh.naturalCell[at(c)]] = distances[at(c)];
    return byNumber;
  };
  const auto alone = of(MPI_COMM_SELF);
  for (const auto& [cell, distance] : of(MPI_COMM_WORLD)) EXPECT_EQ(distance, alone.at(cell)) << cell;
}

TEST(WallDistance, WithoutWallsIsAnInputErrorOfAllRanks) {
  const Mesh mesh(MPI_COMM_WORLD, boxOf(2, 8, 1.0));
  HaloExchange halo(mesh);
  const auto message = messageOf<InputError>([&] { wallDistance(mesh, halo, {}); });
  EXPECT_THAT(message, testing::HasSubstr("cell 0 of the mesh"));
  EXPECT_TRUE(sameOnAllRanks(message));
}

}  // namespace
}  // namespace lampblack::test
