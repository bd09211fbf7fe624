// What stands in a mesh file of Gmsh stands in the block, in every encoding and whatever the size of the portions.
#include "io/gmsh_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/every_module.hpp"
#include "tests/io/gmsh_model.hpp"
#include "tests/io/whole_mesh.hpp"
#include "tests/shared_scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Cells = std::vector<std::vector<std::int64_t>>;
using Place = std::array<double, 3>;
using Face = std::pair<std::string, std::vector<std::int64_t>>;
using Pair = std::pair<std::int64_t, std::int64_t>;

class GmshReader : public ::testing::Test {
 protected:
  test::WholeMesh read(const std::string& text, double scale = 1, std::size_t portion = 1U << 17U) {
    const std::filesystem::path file = scratch_.path() / "mesh.msh";
    MPI_Barrier(MPI_COMM_WORLD);
    if (test::worldRank() == 0) std::ofstream(file, std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
    return test::wholeOf(readGmsh(MPI_COMM_WORLD, file, scale, portion, &notes_));
  }
  // Calls check(mesh) for every encoding and for portions of one value, of some and of all.
  template <typename Check>
  void inAllWays(const test::GmshModel& model, double scale, const Check& check) {
    for (const test::GmshEncoding& encoding : test::gmshEncodings()) {
      for (const std::size_t portion : {1U, 7U, 20U, 100000U}) {
        SCOPED_TRACE(fmt::format("{} {} {} bytes, portions of {}", encoding.version(),
                                 encoding.binary ? "binary" : "text", encoding.sizeBytes, portion));
        check(read(gmshText(model, encoding), scale, portion));
      }
    }
  }
  test::SharedScratchFolder scratch_;
  std::vector<std::string> notes_;
};

// Two unit squares side by side at z = 0.25, the left one of two triangles. Tags are sparse and in no order, a node in
// the middle belongs to no cell, the second triangle and the square are clockwise.
test::GmshModel planeModel() {
  test::GmshModel model;
  model.names = {R"(1 11 "fuel inlet")", R"(1 12 "wall")", R"(2 21 "gas")"};
  model.entities = {{0, 1, {}}, {1, 1, {11}}, {1, 2, {12}}, {1, 3, {-12}}, {1, 4, {14}}, {1, 5, {}}, {2, 7, {21, 22}}};
  model.nodes = {{0, 1, true, {{900, {0, 0, 0.25}}}},
                 {1, 1, true, {{5, {0, 1, 0.25}}}},
                 {1, 5, false, {{37888, {0.25, 0.5, 0.25}}}},
                 {1, 2, true, {{2000000000, {1, 0, 0.25}}, {1, {1, 1, 0.25}}}},
                 {2, 7, true, {{77, {2, 0, 0.25}}, {78, {2, 1, 0.25}}}}};
  model.elements = {{0, 1, 15, {{1, 900}}},
                    {1, 1, 1, {{50, 5, 900}}},
                    {1, 2, 1, {{3, 900, 2000000000}, {4, 2000000000, 77}}},
                    {1, 3, 1, {{6, 5, 1}, {7, 1, 78}}},
                    {1, 4, 1, {{8, 77, 78}}},
                    {1, 5, 1, {{9, 2000000000, 1}}},
                    {2, 7, 2, {{100, 900, 2000000000, 5}, {22, 2000000000, 5, 1}}},
                    {2, 7, 3, {{23, 2000000000, 1, 78, 77}}}};
  model.links = {
      {0, 2, 1, true, {{77, 900}}}, {0, 3, 1, false, {{78, 5}}}, {1, 4, 1, true, {{77, 900}, {78, 5}, {37888, 37888}}}};
  return model;
}

TEST_F(GmshReader, APlaneMeshIsReadInEveryEncoding) {
  inAllWays(planeModel(), 1e-3, [](const test::WholeMesh& mesh) {
    EXPECT_EQ(mesh.dimension, 2);
    EXPECT_THAT(mesh.shapes, ElementsAre(CellShape::Triangle, CellShape::Triangle, CellShape::Quadrilateral));
    EXPECT_EQ(
        mesh.vertices,
        (std::vector<Place>{{0, 0, 0}, {0, 1e-3, 0}, {1e-3, 0, 0}, {1e-3, 1e-3, 0}, {2e-3, 0, 0}, {2e-3, 1e-3, 0}}));
    EXPECT_EQ(mesh.cells, (Cells{{0, 2, 1}, {2, 3, 1}, {2, 4, 5, 3}}));
    EXPECT_THAT(mesh.patches, ElementsAre("fuel inlet", "wall", "physical 14"));
    EXPECT_THAT(mesh.named,
                UnorderedElementsAre(Face("fuel inlet", {0, 1}), Face("wall", {0, 2}), Face("wall", {2, 4}),
                                     Face("wall", {1, 3}), Face("wall", {3, 5}), Face("physical 14", {4, 5})));
    EXPECT_THAT(mesh.periodic, UnorderedElementsAre(Pair(4, 0), Pair(5, 1)));
  });
}

// A hexahedron, a prism at its side, a pyramid on it, a tetrahedron at the pyramid; behind them a tetrahedron that no
// physical group has, with a face in the group "left out".
test::GmshModel spaceModel(bool mirrored) {
  test::GmshModel model;
  model.names = {R"(2 1 "air "inlet"")", R"(2 2 "left out")", R"(2 3 "air "inlet"")", R"(1 4 "an edge")"};
  model.entities = {{2, 1, {1}}, {2, 2, {2}}, {2, 3, {3}}, {2, 4, {}}, {1, 1, {4}}, {3, 1, {9}}, {3, 2, {}}};
  model.nodes = {
      {3, 1, true, {{108, {9, 9, 8}}, {101, {0, 0, 0}}, {103, {1, 0, 0}}, {102, {1, 1, 0}}, {104, {0, 1, 0}}}},
      {3, 2, false, {{8, {9, 9, 9}}}},
      {3, 1, false, {{15, {0, 0, 1}}, {14, {1, 0, 1}}, {13, {1, 1, 1}}, {12, {0, 1, 1}}, {3, {2, 0, 0}}}},
      {3, 1, true, {{2, {2, 0, 1}}, {40, {0.5, 0.5, 2}}, {41, {2, 0.5, 2}}}}};
  // Corners as they should be, then mirrored about the cell's own directions.
  const std::vector<std::int64_t> hexahedron = mirrored
                                                   ? std::vector<std::int64_t>{1, 101, 104, 102, 103, 15, 12, 13, 14}
                                                   : std::vector<std::int64_t>{1, 101, 103, 102, 104, 15, 14, 13, 12};
  const std::vector<std::int64_t> prism = mirrored ? std::vector<std::int64_t>{2, 103, 102, 3, 14, 13, 2}
                                                   : std::vector<std::int64_t>{2, 103, 3, 102, 14, 2, 13};
  const std::vector<std::int64_t> pyramid =
      mirrored ? std::vector<std::int64_t>{3, 15, 12, 13, 14, 40} : std::vector<std::int64_t>{3, 15, 14, 13, 12, 40};
  const std::vector<std::int64_t> tetrahedron =
      mirrored ? std::vector<std::int64_t>{5, 14, 13, 41, 40} : std::vector<std::int64_t>{5, 14, 41, 13, 40};
  model.elements = {{2, 1, 3, {{20, 101, 104, 102, 103}}},
                    {1, 1, 1, {{30, 101, 103}}},
                    {2, 3, 2, {{21, 103, 102, 3}}},
                    {2, 2, 2, {{22, 8, 108, 41}}},
                    {2, 4, 2, {{23, 14, 13, 2}}},
                    {3, 1, 7, {pyramid}},
                    {3, 2, 4, {{10, 40, 41, 8, 108}}},
                    {3, 1, 5, {hexahedron}},
                    {3, 1, 4, {tetrahedron}},
                    {3, 1, 6, {prism}}};
  return model;
}

TEST_F(GmshReader, AllShapesOfSpaceAreReadAndTurned) {
  for (const bool mirrored : {false, true}) {
    inAllWays(spaceModel(mirrored), 1, [&](const test::WholeMesh& mesh) {
      EXPECT_EQ(mesh.dimension, 3);
      EXPECT_THAT(mesh.shapes,
                  ElementsAre(CellShape::Pyramid, CellShape::Hexahedron, CellShape::Tetrahedron, CellShape::Prism));
      ASSERT_EQ(mesh.vertices.size(), 12U);
      EXPECT_EQ(mesh.vertices[0], (Place{0, 0, 0}));
      EXPECT_EQ(mesh.vertices[7], (Place{0, 1, 1}));
      EXPECT_EQ(mesh.vertices[11], (Place{2, 0.5, 2}));
      EXPECT_EQ(mesh.cells, (Cells{{4, 5, 6, 7, 10}, {0, 1, 2, 3, 4, 5, 6, 7}, {5, 11, 6, 10}, {1, 8, 2, 5, 9, 6}}));
      EXPECT_THAT(mesh.patches, ElementsAre("air \"inlet\""));
      EXPECT_THAT(mesh.named,
                  UnorderedElementsAre(Face("air \"inlet\"", {0, 1, 2, 3}), Face("air \"inlet\"", {1, 2, 8})));
      EXPECT_THAT(mesh.periodic, IsEmpty());
    });
  }
}

TEST_F(GmshReader, WithoutPhysicalGroupsAllCellsAreKept) {
  test::GmshModel model = spaceModel(false);
  for (auto& entity : model.entities) entity.groups.clear();
  inAllWays(model, 1, [](const test::WholeMesh& mesh) {
    EXPECT_EQ(mesh.cells.size(), 5U);
    EXPECT_EQ(mesh.vertices.size(), 14U);
    EXPECT_THAT(mesh.named, IsEmpty());
    EXPECT_EQ(mesh.vertices[0], (Place{9, 9, 8}));
  });
  model.entities.clear();  // a file need not have the section
  inAllWays(model, 1, [](const test::WholeMesh& mesh) { EXPECT_EQ(mesh.cells.size(), 5U); });
}

TEST_F(GmshReader, FewerCellsThanRanksIsNoTrouble) {
  test::GmshModel model;
  model.nodes = {{2, 1, false, {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {0, 1, 0}}}}};
  model.elements = {{2, 1, 2, {{1, 1, 2, 3}}}};
  inAllWays(model, 2, [](const test::WholeMesh& mesh) {
    EXPECT_EQ(mesh.cells, (Cells{{0, 1, 2}}));
    EXPECT_EQ(mesh.vertices[2], (Place{0, 2, 0}));
  });
}

// Nodes between the corners are passed over, on faces and in cells.
TEST_F(GmshReader, ElementsOfHigherOrderAreReadByTheirCorners) {
  test::GmshModel model = planeModel();
  const auto lengthen = [&](int from, int to, std::size_t nodes) {
    for (auto& block : model.elements) {
      if (block.type != from) continue;
      block.type = to;
      for (auto& element : block.elements) element.resize(nodes + 1, 37888);
    }
  };
  lengthen(1, 8, 3);
  lengthen(2, 9, 6);
  lengthen(3, 10, 9);
  inAllWays(model, 1, [&](const test::WholeMesh& mesh) {
    EXPECT_EQ(mesh.cells, (Cells{{0, 2, 1}, {2, 3, 1}, {2, 4, 5, 3}}));
    EXPECT_EQ(mesh.vertices.size(), 6U);
    EXPECT_THAT(mesh.patches, ElementsAre("fuel inlet", "wall", "physical 14"));
    EXPECT_EQ(mesh.named.size(), 6U);
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("3 elements of order 2 are read by their corners")));
  });
  lengthen(10, 37, 25);
  EXPECT_EQ(read(gmshText(model, {})).cells, (Cells{{0, 2, 1}, {2, 3, 1}, {2, 4, 5, 3}}));
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("2 elements of order 2"), HasSubstr("1 elements of order 4")));

  model = spaceModel(false);
  for (const auto& [from, to, nodes] :
       {std::array{4, 11, 10}, {5, 12, 27}, {6, 13, 18}, {7, 14, 14}, {2, 9, 6}, {3, 16, 8}, {1, 8, 3}})
    lengthen(from, to, static_cast<std::size_t>(nodes));
  for (auto& block : model.elements)
    for (auto& element : block.elements) std::ranges::replace(element, 37888, 8);
  inAllWays(model, 1, [](const test::WholeMesh& mesh) {
    EXPECT_EQ(mesh.cells, (Cells{{4, 5, 6, 7, 10}, {0, 1, 2, 3, 4, 5, 6, 7}, {5, 11, 6, 10}, {1, 8, 2, 5, 9, 6}}));
    EXPECT_EQ(mesh.named.size(), 2U);
  });
}

TEST_F(GmshReader, NamesOfVersionTwoNeedNoDimension) {
  test::GmshModel model = planeModel();
  model.names = {R"(11 "fuel inlet")", R"(12 "wall")"};
  std::string text = gmshText(model, {false, false, 8, true});
  EXPECT_THAT(read(text.replace(text.find("2.2"), 3, "2")).patches, ElementsAre("fuel inlet", "wall", "physical 14"));
}

TEST_F(GmshReader, TextMayHaveOtherWhiteSpace) {
  std::string text = gmshText(planeModel(), {});
  std::string other;
  for (const char c : text) other += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(other).cells, (Cells{{0, 2, 1}, {2, 3, 1}, {2, 4, 5, 3}}));
  text.insert(text.find("$Elements"), "\n  \n\t");
  EXPECT_EQ(read(text).cells, (Cells{{0, 2, 1}, {2, 3, 1}, {2, 4, 5, 3}}));
}

// Volume of all cells by the divergence of the position, and area of each patch.
double volumeOf(const test::WholeMesh& mesh, std::size_t cell) {
  double volume = 0;
  for (const CellSide& side : sidesOf(mesh.shapes[cell])) {
    const auto at = [&](int k) {
      return mesh.vertices[static_cast<std::size_t>(
          mesh.cells[cell][static_cast<std::size_t>(side.corner[static_cast<std::size_t>(k)])])];
    };
    for (int k = 1; k + 1 < side.corners; ++k) {
      const Place a = at(0), b = at(k), c = at(k + 1);
      volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                 a[2] * (b[0] * c[1] - b[1] * c[0])) /
                6;
    }
  }
  return volume;
}

// tests/io/gmsh/box.msh was made by Gmsh 4.8.4 from box.geo beside it: a box of 2 by 1 by 1, binary.
TEST_F(GmshReader, AMeshThatGmshWroteIsWhole) {
  for (const std::size_t portion : {50U, 1U << 17U}) {
    const test::WholeMesh mesh =
        test::wholeOf(readGmsh(MPI_COMM_WORLD, test::sourceFolder / "tests/io/gmsh/box.msh", 0.5, portion));
    EXPECT_EQ(mesh.dimension, 3);
    EXPECT_GT(mesh.cells.size(), 100U);
    double volume = 0;
    std::map<std::vector<std::int64_t>, int> sides;  // by sorted vertices, how often
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
      EXPECT_GT(volumeOf(mesh, cell), 0);
      volume += volumeOf(mesh, cell);
      for (const CellSide& side : sidesOf(mesh.shapes[cell])) {
        std::vector<std::int64_t> vertices;
        for (int k = 0; k < side.corners; ++k)
          vertices.push_back(mesh.cells[cell][static_cast<std::size_t>(side.corner[static_cast<std::size_t>(k)])]);
        std::sort(vertices.begin(), vertices.end());
        ++sides[vertices];
      }
    }
    EXPECT_NEAR(volume, 2 * 0.125, 1e-12);  // coordinates have 16 digits
    EXPECT_THAT(mesh.patches, ElementsAre("fuel inlet", "far away", "physical 7"));
    std::map<std::string, int> faces;
    for (const auto& [name, vertices] : mesh.named) {
      EXPECT_EQ(sides[vertices], 1);
      ++faces[name];
    }
    for (const auto& [vertices, times] : sides) EXPECT_LE(times, 2);
    const auto outer = std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 1; });
    EXPECT_EQ(outer, static_cast<std::ptrdiff_t>(mesh.named.size()));
    EXPECT_EQ(mesh.periodic.size(), 12U);
    for (const auto& [a, b] : mesh.periodic) {
      const Place &x = mesh.vertices[static_cast<std::size_t>(a)], &y = mesh.vertices[static_cast<std::size_t>(b)];
      EXPECT_NEAR(std::abs(x[0] - y[0]), 1.0, 1e-12);
      EXPECT_NEAR(std::hypot(x[1] - y[1], x[2] - y[2]), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace lampblack::io
