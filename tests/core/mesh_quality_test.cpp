// Measures of a mesh's quality, against what they are by hand, and the same on any number of ranks.
#include "core/mesh_quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/skewed_mesh.hpp"

namespace lampblack::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double degrees = 180.0 / std::numbers::pi;

// One cell, each side of the patch "side".
Mesh cellOf(CellShape shape, const std::vector<Vector3>& corners) {
  MeshBlock block;
  const bool isPlane = shape == CellShape::Triangle || shape == CellShape::Quadrilateral;
  block.dimension = isPlane ? 2 : 3;
  block.totalCells = 1;
  block.shapes = {shape};
  block.totalVertices = static_cast<std::int64_t>(corners.size());
  block.vertices = {corners.begin(), corners.end()};
  for (std::int64_t v = 0; v < block.totalVertices; ++v) block.corners.push_back(v);
  block.patches = {"side"};
  for (const CellSide& side : sidesOf(shape)) {
    MeshBlock::NamedFace face;
    for (int i = 0; i < side.corners; ++i) face.vertices[at(i)] = side.corner[at(i)];
    block.named.push_back(face);
  }
  return {MPI_COMM_SELF, block, Geometry::Planar};
}

TEST(MeshQuality, OfUnitCellsIsPerfectInOneLine) {
  const Mesh mesh(MPI_COMM_WORLD, unitBox(5, 4));
  const MeshQuality quality(mesh);
  EXPECT_THAT(quality.cells, ElementsAre(0, 20, 0, 0, 0, 0));
  EXPECT_EQ(quality.smallest.value, 1.0);
  EXPECT_EQ(quality.largest.value, 1.0);
  EXPECT_EQ(quality.growth.value, 1.0);
  EXPECT_EQ(quality.aspect.value, 1.0);
  EXPECT_EQ(quality.angle.value, 0.0);
  EXPECT_EQ(quality.meanAngle, 0.0);
  EXPECT_EQ(quality.skewness.value, 0.0);
  // Of equals the first.
  EXPECT_EQ(quality.smallest.number, 0);
  EXPECT_EQ(quality.largest.number, 0);
  EXPECT_EQ(quality.aspect.place, (Vector3{0.5, 0.5, 0.0}));
  EXPECT_THAT(quality.lines(), ElementsAre("mesh: 20 quadrilaterals of 1 to 1 m^2; all cells are perfect"));
  EXPECT_THAT(quality.warnings(), IsEmpty());
}

// Along x cells of 1, 2 and 8 m, along y of 1 m: areas as these, neighbours up to four times as large, and eight times
// as long as wide. Of an axisymmetric mesh the same, whatever the radius.
TEST(MeshQuality, OfAGradedBoxTellsGrowthAndAspectRatio) {
  for (const Geometry geometry : {Geometry::Planar, Geometry::Axisymmetric}) {
    MeshSpec spec = unitBox(3, 2);
    spec.geometry = geometry;
    spec.vertices[0] = {0.0, 1.0, 3.0, 11.0};
    const MeshQuality quality(Mesh(MPI_COMM_WORLD, spec));
    EXPECT_DOUBLE_EQ(quality.smallest.value, 1.0);
    EXPECT_DOUBLE_EQ(quality.largest.value, 8.0);
    EXPECT_EQ(quality.smallest.number, 0);
    EXPECT_EQ(quality.largest.number, 2);
    EXPECT_EQ(quality.largest.place, (Vector3{7.0, 0.5, 0.0}));
    EXPECT_DOUBLE_EQ(quality.growth.value, 4.0);
    EXPECT_EQ(quality.growth.place, (Vector3{3.0, 0.5, 0.0}));
    EXPECT_DOUBLE_EQ(quality.aspect.value, 8.0);
    EXPECT_EQ(quality.aspect.number, 2);
    EXPECT_EQ(quality.skewness.value, 0.0);
    EXPECT_THAT(quality.lines(),
                ElementsAre("mesh: 6 quadrilaterals of 1 to 8 m^2; neighbours differ by 4 at most; aspect ratio 8 at "
                            "most; all faces are orthogonal"));
  }
}

TEST(MeshQuality, OfABoxInSpaceIsByVolumesAndEdges) {
  MeshSpec spec = unitBox(3, 3);
  spec.vertices[2] = {0.0, 0.25, 1.0};
  spec.patches.push_back({"front", 2, false});
  spec.patches.push_back({"back", 2, true});
  const MeshQuality quality(Mesh(MPI_COMM_WORLD, spec));
  EXPECT_EQ(quality.cells[5], 18);
  EXPECT_DOUBLE_EQ(quality.smallest.value, 0.25);
  EXPECT_DOUBLE_EQ(quality.largest.value, 0.75);
  EXPECT_DOUBLE_EQ(quality.growth.value, 3.0);
  EXPECT_DOUBLE_EQ(quality.aspect.value, 4.0);
  EXPECT_THAT(quality.lines(), ElementsAre(HasSubstr("18 hexahedra of 0.25 to 0.75 m^3")));
}

// A square, and beside it a parallelogram that rises by as much as it is wide: from centre to centre 1 to the right and
// 0.5 up, through (1, 0.75) in place of (1, 0.5). The parallelogram's upper and lower faces are turned by 45 degrees
// more than steps from its centre lean: 0.5 right and 1.5 - 1 up against (-1, 1)/sqrt(2).
TEST(MeshQuality, OfALeaningCellTellsAngleAndSkewness) {
  MeshBlock block;
  block.totalCells = 2;
  block.shapes = {CellShape::Quadrilateral, CellShape::Quadrilateral};
  block.corners = {0, 1, 2, 3, 1, 4, 5, 2};
  block.totalVertices = 6;
  block.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 1, 0}, {2, 2, 0}};
  block.patches = {"side"};
  for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {3, 0}, {1, 4}, {4, 5}, {5, 2}})
    block.named.push_back({{a, b, -1, -1}, 0});
  const MeshQuality quality(Mesh(MPI_COMM_SELF, block, Geometry::Planar));
  EXPECT_NEAR(quality.skewness.value, 0.25, 1e-14);
  EXPECT_EQ(quality.skewness.place, (Vector3{1.0, 0.5, 0.0}));
  // From the parallelogram's centre (1.5, 1): to its upper face's (1.5, 1.5), up, whose normal is (-1, 1)/sqrt(2).
  EXPECT_NEAR(quality.angle.value, 45.0, 1e-12);
  EXPECT_TRUE(quality.angle.place == (Vector3{1.5, 0.5, 0.0}) || quality.angle.place == (Vector3{1.5, 1.5, 0.0}));
  // Faces: three of the square straight; the middle atan(0.5), the far side (2, 1.5) - (1.5, 1): 45; two of 45.
  EXPECT_NEAR(quality.meanAngle, (degrees * std::atan(0.5) + 3 * 45.0) / 7.0, 1e-12);
  EXPECT_NEAR(quality.growth.value, 1.0, 1e-14);
  // Longest edge sqrt(2), area 1.
  EXPECT_NEAR(quality.aspect.value, 2.0, 1e-14);
  EXPECT_THAT(quality.lines(), ElementsAre(testing::_, HasSubstr("by 45.0 degrees at most, at (1.5")));
}

TEST(MeshQuality, RegularCellsHaveTheAspectRatioOne) {
  const double h = std::sqrt(0.75), third = std::sqrt(2.0 / 3.0);
  const std::vector<Vector3> triangle{{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}};
  EXPECT_NEAR(MeshQuality(cellOf(CellShape::Triangle, triangle)).aspect.value, 1.0, 1e-14);
  std::vector<Vector3> tetrahedron = triangle;
  tetrahedron.push_back({0.5, h / 3, third});
  EXPECT_NEAR(MeshQuality(cellOf(CellShape::Tetrahedron, tetrahedron)).aspect.value, 1.0, 1e-14);
  const std::vector<Vector3> pyramid{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}};
  EXPECT_NEAR(MeshQuality(cellOf(CellShape::Pyramid, pyramid)).aspect.value, 1.0, 1e-14);
  std::vector<Vector3> prism = triangle;
  for (const Vector3& corner : triangle) prism.push_back({corner[0], corner[1], 1.0});
  EXPECT_NEAR(MeshQuality(cellOf(CellShape::Prism, prism)).aspect.value, 1.0, 1e-14);
  // A flat triangle of a long edge, though no edge is short: 4 m x 0.1 m.
  const std::vector<Vector3> flat{{0, 0, 0}, {4, 0, 0}, {2, 0.1, 0}};
  EXPECT_NEAR(MeshQuality(cellOf(CellShape::Triangle, flat)).aspect.value, 16.0 / 0.2 * std::sqrt(3.0) / 4.0, 1e-12);
}

class MeshQualityOfShapes : public testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, MeshQualityOfShapes,
                         testing::Values(Cells::Triangles, Cells::MixedPlane, Cells::Tetrahedra, Cells::MixedSpace));

TEST_P(MeshQualityOfShapes, IsTheSameOnAnyNumberOfRanks) {
  const bool isSpace = GetParam() >= Cells::Hexahedra;
  MeshSpec spec = unitBox(9, 8);
  if (isSpace) {
    spec.vertices[2] = {0.0, 1.0, 2.0, 3.5};
    spec.patches.push_back({"front", 2, false});
    spec.patches.push_back({"back", 2, true});
  }
  const auto of = [&](MPI_Comm comm) {
    const SkewedMesh skewed(comm, spec, GetParam(), 0.3);
    return MeshQuality(Mesh(comm, skewed.block(), Geometry::Planar));
  };
  const MeshQuality all = of(MPI_COMM_WORLD), alone = of(MPI_COMM_SELF);
  EXPECT_EQ(all.cells, alone.cells);
  EXPECT_NEAR(all.meanAngle, alone.meanAngle, 1e-12);
  EXPECT_GT(all.meanAngle, 1.0);
  EXPECT_GT(all.skewness.value, 0.01);
  for (const auto worst : {&MeshQuality::smallest, &MeshQuality::largest, &MeshQuality::growth, &MeshQuality::angle,
                           &MeshQuality::skewness, &MeshQuality::aspect}) {
    EXPECT_EQ((all.*worst).value, (alone.*worst).value);
    EXPECT_EQ((all.*worst).number, (alone.*worst).number);
    EXPECT_EQ((all.*worst).place, (alone.*worst).place);
  }
  EXPECT_EQ(all.lines(), alone.lines());
  EXPECT_EQ(all.lines().size(), 2U);
}

TEST(MeshQuality, WarnsOfWhatIsBad) {
  MeshSpec spec = unitBox(4, 3);
  spec.map = [](const Vector3& x) { return Vector3{x[0] + 5.0 * x[1], x[1], 0.0}; };
  // tan 79 degrees is 5; 31 faces as counted in mesh_shapes_test.
  EXPECT_THAT(MeshQuality(Mesh(MPI_COMM_WORLD, spec)).warnings(),
              ElementsAre(testing::AllOf(HasSubstr("31 of the mesh's 31 faces"), HasSubstr("more than 76 degrees"),
                                         HasSubstr("by 78.7 at most"))));
  spec.map = nullptr;
  spec.vertices[0] = {0.0, 1.0, 12.0, 13.0, 14.0};
  EXPECT_THAT(MeshQuality(Mesh(MPI_COMM_WORLD, spec)).warnings(),
              ElementsAre(HasSubstr("by a factor of 11, at (1, 0.5)")));
  spec.vertices[0] = {0.0, 1e-4, 2e-4, 3e-4, 4e-4};
  EXPECT_THAT(MeshQuality(Mesh(MPI_COMM_WORLD, spec)).warnings(), ElementsAre(HasSubstr("aspect ratio 1e+04")));
}

}  // namespace
}  // namespace lampblack::test
