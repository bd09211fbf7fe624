// Decks with mesh files: boundaries and groups of a file by name or number, and what is wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/problems/flow/flow_checkpoint.hpp"
#include "app/problems/flow/flow_mesh.hpp"
#include "core/modules.hpp"
#include "tests/app/flow_mesh_decks.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using test::messageOf;
using test_mesh::caseOf;
using test_mesh::channel;
using test_mesh::channelSides;
using test_mesh::gas;
using test_mesh::Surface;
using test_mesh::volumeOf;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A square and two triangles in a row, in cm, whose boundaries stand in another order than in the deck.
constexpr const char* rowOfThree = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
5
1 11 "floor"
1 12 "out"
1 13 "top"
1 14 "in"
2 20 "gas"
$EndPhysicalNames
$Entities
0 4 1 0
1 0 0 0 2 0 0 1 11 0
2 2 0 0 2 1 0 1 12 0
3 0 1 0 2 1 0 1 13 0
4 0 0 0 0 1 0 1 14 0
1 0 0 0 2 1 0 1 20 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
6 9 1 9
1 1 1 2
1 1 2
2 2 3
1 2 1 1
3 3 6
1 3 1 2
4 4 5
5 5 6
1 4 1 1
6 1 4
2 1 3 1
7 1 2 5 4
2 1 2 2
8 2 3 6
9 2 6 5
$EndElements
)";

class MeshFileDeck {
 public:
  MeshFileDeck() { write(rowOfThree); }
  void write(const std::string& text) const {
    MPI_Barrier(MPI_COMM_WORLD);
    if (test::worldRank() == 0) std::ofstream(folder_.path() / "row.msh") << text;
    MPI_Barrier(MPI_COMM_WORLD);
  }
  [[nodiscard]] FlowCase read(const std::string& boundaries, const std::string& mesh = "geometry: planar, unit: 1 cm",
                              const std::string& more = "") const {
    return caseOf(mesh + ", file: row.msh", boundaries, more, folder_.path() / "deck.yaml");
  }
  [[nodiscard]] std::string error(const std::string& boundaries,
                                  const std::string& mesh = "geometry: planar, unit: 1 cm",
                                  const std::string& more = "") const {
    return messageOf<InputError>([&] {
      FlowCase flowCase = read(boundaries, mesh, more);
      makeMesh(MPI_COMM_WORLD, flowCase);
    });
  }

 private:
  test::SharedScratchFolder folder_;
};

const std::string rowSides = "  in: {type: inlet, velocity: 1 m/s, " + gas + "}\n  out: {type: outlet, " + gas +
                             "}\n  top: {type: wall}\n  floor: {type: wall}\n";

TEST(FlowMeshFile, AMeshFileHasTheDecksBoundariesInTheDecksOrder) {
  const MeshFileDeck deck;
  FlowCase flowCase = deck.read(rowSides);
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_EQ(mesh.totalCells, 3);
  EXPECT_NEAR(volumeOf(mesh), 2e-4, 1e-18);
  EXPECT_THAT(mesh.patches, ElementsAre("in", "out", "top", "floor"));
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(1, 1, 2, 2));
  for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
    const Vector3& n = mesh.normal[static_cast<std::size_t>(face)];
    const std::string& name = mesh.patchName(face);
    EXPECT_EQ(name, n[0] < -0.5 ? "in" : n[0] > 0.5 ? "out" : n[1] > 0.5 ? "top" : "floor");
  }
}

TEST(FlowMeshFile, AMeshFileAndTheDeckHaveTheSameNames) {
  const MeshFileDeck deck;
  const std::string withoutFloor = rowSides.substr(0, rowSides.find("  floor"));
  EXPECT_THAT(deck.error(withoutFloor), testing::AllOf(HasSubstr("deck.yaml"), HasSubstr("'floor' has no boundary"),
                                                       HasSubstr("floor, out, top, in")));
  EXPECT_THAT(deck.error(withoutFloor + "  flor: {type: wall}\n"),
              testing::AllOf(HasSubstr("boundaries.flor"), HasSubstr("floor, out, top, in"),
                             HasSubstr("did you mean 'floor'?")));
  for (const char* key : {"side: y-min", "from: 1 mm", "to: 1 mm", "solid: step"})
    EXPECT_THAT(deck.error(withoutFloor + "  floor: {type: wall, " + key + "}\n"),
                HasSubstr("go by the names in the file"));
  EXPECT_THAT(deck.error(withoutFloor + "  floor: {type: periodic}\n"), HasSubstr("belongs to no boundary"));
}

// A deck's names have neither points nor brackets, a file's may.
TEST(FlowMeshFile, ANameWithPointsOrBracketsGoesByUnderscores) {
  const MeshFileDeck deck;
  std::string file = rowOfThree;
  file.replace(file.find("\"floor\""), 7, "\"wall[1].low\"");
  deck.write(file);
  const std::string withoutFloor = rowSides.substr(0, rowSides.find("  floor"));
  FlowCase flowCase = deck.read(withoutFloor + "  wall_1__low: {type: wall}\n");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_THAT(mesh.patches, ElementsAre("in", "out", "top", "wall_1__low"));
  EXPECT_THAT(deck.error(withoutFloor + "  wall_1_low: {type: wall}\n"),
              AllOf(HasSubstr("no such part of the mesh"), testing::Not(HasSubstr("wall[1]")),
                    HasSubstr("did you mean 'wall_1__low'")));
  EXPECT_THAT(deck.error(withoutFloor), HasSubstr("'wall_1__low' has no boundary"));
  const std::string withoutTop = rowSides.substr(0, rowSides.find("  top"));
  for (const std::string other : {"\"wall.1].low\"", "\"wall_1__low\""}) {
    std::string twice = file;
    twice.replace(twice.find("\"top\""), 5, other);
    deck.write(twice);
    EXPECT_THAT(deck.error(withoutTop + "  wall_1__low: {type: wall}\n"),
                AllOf(HasSubstr("boundaries.wall_1__low"), HasSubstr("have this one name in a deck"),
                      HasSubstr("'wall[1].low'")));
  }
}

TEST(FlowMeshFile, AFileWithoutNamesSaysWhatNeedsThem) {
  const MeshFileDeck deck;
  std::string file = rowOfThree;
  file.replace(file.find("6 9 1 9"), file.find("2 1 3 1\n") - file.find("6 9 1 9"), "2 3 7 9\n");
  deck.write(file);
  EXPECT_THAT(deck.error(rowSides), HasSubstr("row.msh has no names: give the lines of its surface physical groups"));
}

// Of the two triangles the second has corners of its own beside the first.
TEST(FlowMeshFile, CornersThatAreThereTwiceAreSaid) {
  const MeshFileDeck deck;
  std::string file = rowOfThree;
  const auto change = [&](const std::string& from, const std::string& to) {
    file.replace(file.find(from), from.size(), to);
  };
  change("1 6 1 6\n2 1 0 6\n", "1 8 1 8\n2 1 0 8\n");
  change("5\n6\n0 0 0", "5\n6\n7\n8\n0 0 0");
  change("2 1 0\n$EndNodes", "2 1 0\n2 0 0\n1 1 0\n$EndNodes");
  change("9 2 6 5", "9 2 6 8");
  deck.write(file);
  EXPECT_THAT(deck.error(rowSides), HasSubstr("the cells on both sides of the face at (0.01, 0.005) m"));
}

TEST(FlowMeshFile, AMeshFileStandsAlone) {
  const MeshFileDeck deck;
  EXPECT_THAT(deck.error(rowSides, "geometry: planar, refinement: 2"), HasSubstr("mesh.refinement"));
  EXPECT_THAT(deck.error(rowSides, "geometry: planar, x: [{to: 1 mm, cells: 1}]"), HasSubstr("leave this out"));
  EXPECT_THAT(deck.error(rowSides, "geometry: planar, solids: {a: {x: [0 mm, 1 mm]}}"), HasSubstr("leave this out"));
  EXPECT_THAT(deck.error(rowSides, "geometry: planar, floor: {formula: \"0\"}"), HasSubstr("leave this out"));
  EXPECT_THAT(deck.error(rowSides, "geometry: space"),
              testing::AllOf(HasSubstr("lies in a plane"), HasSubstr("mesh.geometry")));
  EXPECT_THAT(messageOf<InputError>([] { caseOf(channel + ", unit: 1 mm", channelSides); }), HasSubstr("mesh.unit"));
}

// A plane of symmetry allows gravity along it, and none through it.
TEST(FlowMeshFile, GravityLiesInPlanesOfSymmetry) {
  const std::string box = "geometry: planar, x: [{to: 4 mm, cells: 4}], y: [{to: 2 mm, cells: 2}]";
  const std::string sides = "  in: {type: inlet, side: x-min, velocity: 1 m/s, " + gas +
                            "}\n  out: {type: outlet, side: x-max, " + gas +
                            "}\n  below: {type: symmetry, side: y-min}\n  above: {type: wall, side: y-max}\n";
  EXPECT_EQ(caseOf(box, sides, "gravity: {x: 2 m/s^2}\n").gravity[0], 2.0);
  EXPECT_NE(messageOf<InputError>([&] {
              caseOf(box, sides, "gravity: {y: 2 m/s^2}\n");
            }).find("gravity would point through 'below'"),
            std::string::npos);
}

// The left end is the axis in an axisymmetric flow.
TEST(FlowMeshFile, TheSurfaceOfAMeshFileHasToMakeSense) {
  const MeshFileDeck deck;
  EXPECT_THAT(deck.error(rowSides, "geometry: axisymmetric"), HasSubstr("lies on the axis"));
  const std::string axis = "  in: {type: symmetry}\n" + rowSides.substr(rowSides.find("  out"));
  EXPECT_EQ(deck.error(axis, "geometry: axisymmetric"), "");
  EXPECT_THAT(deck.error(axis, "geometry: axisymmetric", "gravity: {r: 1 m/s^2}\n"),
              HasSubstr("gravity would point through 'in'"));
  EXPECT_EQ(deck.error(axis, "geometry: axisymmetric", "gravity: {z: 1 m/s^2}\n"), "");
  EXPECT_THAT(deck.error("  in: {type: symmetry}\n  out: {type: wall, swirl_velocity: 1 m/s}\n  top: {type: wall}\n  "
                         "floor: {type: wall}\n",
                         "geometry: axisymmetric"),
              HasSubstr("a flow that swirls needs a mesh of rectangles"));
}

TEST(FlowMeshFile, APartInsideTheMeshIsNoBoundary) {
  const MeshFileDeck deck;
  std::string text = rowOfThree;
  const auto replace = [&](const std::string& before, const std::string& after) {
    text.replace(text.find(before), before.size(), after);
  };
  replace("$PhysicalNames\n5\n", "$PhysicalNames\n6\n1 15 \"inner\"\n");
  replace("0 4 1 0\n", "0 5 1 0\n");
  replace("1 0 0 0 2 1 0 1 20 0\n", "5 1 0 0 1 1 0 1 15 0\n1 0 0 0 2 1 0 1 20 0\n");
  replace("6 9 1 9\n", "7 10 1 10\n1 5 1 1\n10 2 5\n");
  deck.write(text);
  FlowCase passedOver = deck.read(rowSides);
  EXPECT_THAT(makeMesh(MPI_COMM_WORLD, passedOver).patches, ElementsAre("in", "out", "top", "floor"));
  EXPECT_THAT(passedOver.notes, ElementsAre(HasSubstr("the group 'inner' is no part of the surface")));
  EXPECT_THAT(deck.error(rowSides + "  inner: {type: symmetry}\n"),
              testing::AllOf(HasSubstr("boundaries.inner"), HasSubstr("cells on both sides"),
                             HasSubstr("'type: wall' (of no thickness)"), HasSubstr("Plugin(Crack)")));
  // A wall of no thickness across the row leaves one part without an outlet.
  EXPECT_THAT(deck.error(rowSides + "  inner: {type: wall}\n"),
              testing::AllOf(HasSubstr("mesh.file"), HasSubstr("the mesh has 2 parts that do not touch, 1 of them"),
                             HasSubstr("1 cells, one at (0.005, 0.005) m, without an outlet"),
                             HasSubstr("2 cells, one at (0.0166667, 0.00333333) m, with an outlet")));
  FlowCase open = deck.read("  in: {type: outlet, " + gas + "}" + rowSides.substr(rowSides.find("\n  out")) +
                            "  inner: {type: wall, temperature: 400 K}\n");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, open);
  EXPECT_THAT(open.notes, ElementsAre(HasSubstr("1 of the 1 faces of the wall 'inner' have cells on both sides")));
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(1, 1, 2, 2, 2));
  EXPECT_NEAR(Surface(mesh).area[4], 2e-2, 1e-14);
  EXPECT_EQ(mesh.totalFaces, 1 + 8);  // one between the triangles
}

// What is named on the surface is needed there, whatever of the group lies inside.
TEST(FlowMeshFile, AGroupMayBePartlyInside) {
  const MeshFileDeck deck;
  std::string text = rowOfThree;
  const auto replace = [&](const std::string& before, const std::string& after) {
    text.replace(text.find(before), before.size(), after);
  };
  replace("6 9 1 9\n1 1 1 2\n", "6 10 1 10\n1 1 1 3\n10 2 5\n");
  deck.write(text);
  const std::string openSides = "  in: {type: outlet, " + gas + "}" + rowSides.substr(rowSides.find("\n  out"));
  FlowCase wall = deck.read(openSides);
  EXPECT_THAT(Surface(makeMesh(MPI_COMM_WORLD, wall)).faces, ElementsAre(1, 1, 2, 4));
  EXPECT_THAT(wall.notes, ElementsAre(HasSubstr("1 of the 3 faces of the wall 'floor' have cells on both sides")));
  FlowCase outlet = deck.read(openSides.substr(0, openSides.find("  floor")) + "  floor: {type: symmetry}\n");
  EXPECT_THAT(Surface(makeMesh(MPI_COMM_WORLD, outlet)).faces, ElementsAre(1, 1, 2, 2));
  EXPECT_THAT(outlet.notes, ElementsAre(HasSubstr("1 of the 3 faces of 'floor' are no part of the surface")));
}

TEST(FlowMeshFile, GroupsWithoutANameGoByTheirNumbers) {
  const MeshFileDeck deck;
  std::string text = rowOfThree;
  text.erase(text.find("$PhysicalNames"), text.find("$Entities") - text.find("$PhysicalNames"));
  deck.write(text);
  const std::string sides = "  physical 14: {type: inlet, velocity: 1 m/s, " + gas + "}\n  12: {type: outlet, " + gas +
                            "}\n  13: {type: wall}\n  physical 11: {type: wall}\n";
  FlowCase flowCase = deck.read(sides, "geometry: planar, unit: 1 cm", "output: {boundaries: [all]}\n");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_THAT(mesh.patches, ElementsAre("physical 14", "12", "13", "physical 11"));
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(1, 1, 2, 2));
  EXPECT_EQ(flowCase.output.tables.boundaries.size(), 4U);
  EXPECT_EQ(flowcase::fileNameOf("physical 14"), "physical_14");
  EXPECT_THAT(deck.error(sides + "  physical 12: {type: wall}\n"),
              testing::AllOf(HasSubstr("boundaries.physical 12"), HasSubstr("has another boundary")));
  EXPECT_THAT(deck.error(sides + "  physical_14: {type: wall}\n", "geometry: planar",
                         "output: {boundaries: [physical_14, physical 14]}\n"),
              testing::AllOf(HasSubstr("output.boundaries"), HasSubstr("boundary_physical_14.csv")));
  EXPECT_THAT(deck.error(sides.substr(0, sides.find("  13"))), HasSubstr("'physical 11' has no boundary"));
}
TEST(FlowMeshFile, TheStartsLayersLieInTheMeshFile) {
  const MeshFileDeck deck;
  const auto error = [&](const std::string& position, const std::string& hotPosition) {
    return deck.error(
        rowSides, "geometry: planar, unit: 1 cm",
        "initial: {layer: hot, low: in, high: in, width: 1 mm, hot_width: 1 mm, temperature: 400 K, position: " +
            position + ", hot_position: " + hotPosition + "}\n");
  };
  EXPECT_EQ(error("5 mm", "1 cm"), "");
  EXPECT_THAT(error("11 mm", "5 mm"),
              testing::AllOf(HasSubstr("initial.position"), HasSubstr("from 0 to 0.01 m, found 0.011 m")));
  EXPECT_THAT(error("5 mm", "-1 mm"), HasSubstr("initial.hot_position"));
}

TEST(FlowMeshFile, ACheckpointKnowsTheMeshFile) {
  const MeshFileDeck deck;
  const auto fingerprint = [&](const std::string& mesh) {
    FlowCase flowCase = deck.read(rowSides, mesh);
    makeMesh(MPI_COMM_WORLD, flowCase);
    return flowFingerprint(flowCase, {});
  };
  const Fingerprint first = fingerprint("geometry: planar");
  EXPECT_EQ(fingerprint("geometry: planar"), first);
  EXPECT_NE(fingerprint("geometry: planar, unit: 1 cm"), first);
  std::string moved = rowOfThree;
  moved.replace(moved.find("1 1 0\n2 1 0"), 5, "1.1 1 0");
  deck.write(moved);
  EXPECT_NE(fingerprint("geometry: planar"), first);
}

}  // namespace
}  // namespace lampblack::app
