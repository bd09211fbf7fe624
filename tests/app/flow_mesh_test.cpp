// Decks that ask for meshes of every kind get them, and are told what is wrong with them.
#include "app/flow/flow_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/flow/flow_case_parts.hpp"
#include "app/flow/flow_checkpoint.hpp"
#include "core/modules.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

using test::messageOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string gas = R"(temperature: 300 K, composition: "GAS: 1")";

// A flow of one gas on this mesh, with these boundaries; `more`: other sections.
FlowCase caseOf(const std::string& mesh, const std::string& boundaries, const std::string& more = "",
                const std::filesystem::path& path = "deck.yaml") {
  const std::string text =
      "problem: flow\nmechanism: " + test::sourcePath("cases/mechanisms/perfect_gas_1.yaml") +
      "\ntransport: {model: unity_lewis, sutherland: {viscosity: 1.68e-5 Pa s, temperature: 273 K, "
      "constant: 110.5 K, prandtl_number: 0.71}}\nmesh: {" +
      mesh + "}\nboundaries:\n" + boundaries + "time: {end: 1 ms}\n" +
      (more.find("initial:") == std::string::npos
           ? "initial: {layer: none, temperature: 300 K, composition: \"GAS: 1\"}\n"
           : "") +
      more;
  return readFlowCase(Deck::parse(text, path, {}, flowSchema()));
}

// Faces of each boundary and the sum of their areas, over all ranks.
struct Surface {
  std::vector<double> faces, area;
  explicit Surface(const Mesh& mesh) : faces(mesh.patches.size()), area(mesh.patches.size()) {
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
      const auto patch = static_cast<std::size_t>(mesh.patch[static_cast<std::size_t>(face - mesh.interiorFaces)]);
      faces[patch] += 1;
      area[patch] += mesh.area[static_cast<std::size_t>(face)];
    }
    const auto n = static_cast<int>(faces.size());
    MPI_Allreduce(MPI_IN_PLACE, faces.data(), n, MPI_DOUBLE, MPI_SUM, mesh.comm);
    MPI_Allreduce(MPI_IN_PLACE, area.data(), n, MPI_DOUBLE, MPI_SUM, mesh.comm);
  }
};

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (int c = 0; c < mesh.owned; ++c) volume += mesh.volume[static_cast<std::size_t>(c)];
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, mesh.comm);
  return volume;
}

const std::string spaceMesh =
    "geometry: space, x: [{to: 4 mm, cells: 4}], y: [{to: 3 mm, cells: 3}], z: [{to: 5 mm, cells: 5}]";
const std::string spaceSides = "  in: {type: inlet, side: x-min, velocity: 1 m/s, " + gas +
                               "}\n  out: {type: outlet, side: x-max, " + gas +
                               "}\n  low: {type: wall, side: y-min}\n  high: {type: wall, side: y-max}\n";
const std::string spacePeriodic =
    spaceSides + "  front: {type: periodic, side: z-min}\n  back: {type: periodic, side: z-max}\n";

TEST(FlowMesh, InSpaceHasThreeAxes) {
  FlowCase flowCase = caseOf(spaceMesh, spacePeriodic,
                             "gravity: {z: -9.81 m/s^2}\n"
                             "initial: {layer: none, composition: \"GAS: 1\", temperature: 300 K, "
                             "formula: {velocity_z: \"x + 10*y + 100*z + 1000*t\"}}\n");
  EXPECT_EQ(flowCase.dimension, 3);
  EXPECT_EQ(flowCase.gravity[2], -9.81);
  ASSERT_TRUE(flowCase.initialFields.velocity[2]);
  EXPECT_DOUBLE_EQ(flowCase.initialFields.velocity[2]({1, 2, 3}, 4), 4321);
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_EQ(mesh.totalCells, 4 * 3 * 5);
  EXPECT_THAT(mesh.patches, ElementsAre("in", "out", "low", "high"));
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(15, 15, 20, 20));
  EXPECT_NEAR(volumeOf(mesh), 60e-9, 1e-20);
}

TEST(FlowMesh, InSpaceATableMayDependOnAllAxes) {
  const test::SharedScratchFolder folder;
  if (test::worldRank() == 0) {
    std::ofstream table(folder.path() / "start.csv");
    table << "x,y,z [mm],velocity_y\n";
    for (const int x : {0, 1})
      for (const int y : {0, 1})
        for (const int z : {0, 1}) table << x << "," << y << "," << z * 1000 << "," << x + 10 * y + 100 * z << "\n";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const FlowCase flowCase =
      caseOf(spaceMesh, spacePeriodic,
             "initial: {layer: none, composition: \"GAS: 1\", temperature: 300 K, table: start.csv}\n",
             folder.path() / "deck.yaml");
  EXPECT_NEAR(flowCase.initialFields.velocity[1]({0.5, 0.25, 0.125}, 0), 15.5, 1e-12);
}

TEST(FlowMesh, InSpaceRefusesWhatHasNoMeaning) {
  EXPECT_THAT(messageOf<InputError>([] { caseOf(spaceMesh, spaceSides); }),
              HasSubstr("the side z-min belongs to no boundary"));
  EXPECT_THAT(messageOf<InputError>([] {
                caseOf("geometry: space, x: [{to: 4 mm, cells: 4}], y: [{to: 3 mm, cells: 3}]", spacePeriodic);
              }),
              HasSubstr("no cells along z"));
  EXPECT_THAT(messageOf<InputError>([] {
                caseOf(spaceMesh, spaceSides +
                                      "  front: {type: wall, side: z-min, tangential_velocity: 1 m/s}\n  back: {type: "
                                      "wall, side: z-max}\n");
              }),
              HasSubstr("no direction"));
  EXPECT_THAT(messageOf<InputError>([] {
                caseOf(spaceMesh, spaceSides +
                                      "  front: {type: wall, side: z-min, swirl_velocity: 1 m/s}\n  back: {type: "
                                      "wall, side: z-max}\n");
              }),
              HasSubstr("no axis to swirl about"));
  EXPECT_THAT(messageOf<InputError>([] {
                caseOf(spaceMesh,
                       spaceSides + "  front: {type: symmetry, side: z-min}\n  back: {type: wall, side: z-max}\n",
                       "gravity: {z: 1 m/s^2}\n");
              }),
              HasSubstr("gravity would point through 'front'"));
  EXPECT_THAT(messageOf<InputError>([] {
                caseOf(
                    "geometry: space, x: [{to: 4 mm, cells: 4}], y: [{to: 3 mm, cells: 3}], z: [{to: 5 mm, cells: 2}]",
                    spacePeriodic);
              }),
              HasSubstr("3 cells or more"));
}

const std::string channel = "geometry: planar, x: [{to: 6 mm, cells: 6}], y: [{to: 4 mm, cells: 4}]";
const std::string channelSides = "  in: {type: inlet, side: x-min, velocity: 1 m/s, " + gas +
                                 "}\n  out: {type: outlet, side: x-max, " + gas +
                                 "}\n  floor: {type: wall, side: y-min}\n  top: {type: wall, side: y-max}\n";

TEST(FlowMesh, SolidsLeaveCellsOut) {
  FlowCase flowCase =
      caseOf(channel + ", solids: {step: {x: [0 mm, 2 mm], y: [0 mm, 1 mm]}, rod: {x: [3 mm, 5 mm], y: [2 mm, 3 mm]}}",
             channelSides + "  rod: {type: wall, solid: rod}\n  step: {type: wall, solid: step}\n");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_EQ(mesh.totalCells, 24 - 2 - 2);
  EXPECT_THAT(mesh.patches, ElementsAre("in", "out", "floor", "top", "rod", "step"));
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(3, 4, 4, 6, 6, 3));
}

TEST(FlowMesh, ASolidThatNamesOneAxisGoesThroughTheMesh) {
  FlowCase flowCase = caseOf(spaceMesh + ", solids: {step: {x: [1 mm, 2 mm], y: [0 mm, 1 mm]}}",
                             spacePeriodic + "  step: {type: wall, solid: step}\n");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_EQ(mesh.totalCells, 60 - 5);
  EXPECT_THAT(Surface(mesh).faces, ElementsAre(15, 15, 15, 20, 15));
}

// The part of a side that a solid covers needs no boundary; the rest does.
TEST(FlowMesh, SolidsCoverSides) {
  const std::string sides = "  out: {type: outlet, side: x-max, " + gas +
                            "}\n  top: {type: wall, side: y-max}\n  step: {type: wall, solid: step}\n";
  const std::string solids = ", solids: {step: {x: [0 mm, 2 mm], y: [0 mm, 2 mm]}}";
  const auto with = [&](const std::string& inFrom, const std::string& floorFrom) {
    FlowCase flowCase =
        caseOf(channel + solids, "  in: {type: inlet, side: x-min, from: " + inFrom + ", velocity: 1 m/s, " + gas +
                                     "}\n  floor: {type: wall, side: y-min, from: " + floorFrom + "}\n" + sides);
    return makeMesh(MPI_COMM_WORLD, flowCase);
  };
  EXPECT_THAT(Surface(with("2 mm", "2 mm")).faces, ElementsAre(2, 4, 4, 6, 4));
  EXPECT_THAT(Surface(with("0 mm", "1 mm")).faces, ElementsAre(2, 4, 4, 6, 4));
  EXPECT_THAT(messageOf<InputError>([&] { with("3 mm", "2 mm"); }),
              HasSubstr("the side x-min belongs to no boundary from 0.002 to 0.003 m"));
  EXPECT_THAT(messageOf<InputError>([&] { with("2 mm", "4 mm"); }),
              HasSubstr("the side y-min belongs to no boundary from 0.002 to 0.004 m"));
}

TEST(FlowMesh, SolidsThatCannotBe) {
  const auto with = [](const std::string& solids, const std::string& boundaries) {
    return messageOf<InputError>([&] { caseOf(channel + ", solids: {" + solids + "}", channelSides + boundaries); });
  };
  EXPECT_THAT(with("rod: {x: [3 mm, 5 mm], y: [2 mm, 3 mm]}", ""), HasSubstr("its surface belongs to no boundary"));
  EXPECT_THAT(with("rod: {x: [3.1 mm, 3.2 mm]}", "  rod: {type: wall, solid: rod}\n"),
              HasSubstr("no cell of the mesh has its centre between 0.0031 and 0.0032 m along x"));
  EXPECT_THAT(with("rod: {x: [5 mm, 3 mm]}", "  rod: {type: wall, solid: rod}\n"), HasSubstr("the lower end"));
  EXPECT_THAT(with("rod: {r: [3 mm, 5 mm]}", "  rod: {type: wall, solid: rod}\n"),
              HasSubstr("the axes of this mesh are x and y"));
  EXPECT_THAT(with("rod: {x: [3 mm, 4 mm]}", "  rod: {type: wall, solid: rad}\n"),
              testing::AllOf(HasSubstr("has no 'rad'"), HasSubstr("'rod'")));
  EXPECT_THAT(with("rod: {x: [3 mm, 4 mm]}", "  rod: {type: wall, solid: rod, side: y-min}\n"),
              HasSubstr("leave this out"));
  EXPECT_THAT(with("rod: {x: [3 mm, 4 mm]}", "  rod: {type: wall, solid: rod}\n  bar: {type: wall, solid: rod}\n"),
              HasSubstr("is that of the boundary 'rod', too"));
  EXPECT_THAT(with("rod: {x: [3 mm, 4 mm]}", "  rod: {type: periodic, solid: rod}\n"), HasSubstr("no partner"));
  EXPECT_THAT(with("rod: {x: [3 mm, 4 mm]}", "  rod: {type: wall}\n"), HasSubstr("'side' or 'solid'"));
  // All of the floor.
  EXPECT_THAT(with("rod: {y: [0 mm, 1 mm]}", "  rod: {type: wall, solid: rod}\n"), HasSubstr("solids cover all of it"));
}

// A nozzle: floor 1 + x/6 mm, ceiling 4 - x/6 mm, whose area is that of a trapezium whatever the number of cells.
TEST(FlowMesh, FloorAndCeilingBendTheMesh) {
  const test::SharedScratchFolder folder;
  if (test::worldRank() == 0) std::ofstream(folder.path() / "ceiling.csv") << "x [mm],y [mm]\n0,4\n6,3\n";
  MPI_Barrier(MPI_COMM_WORLD);
  const auto make = [&](const std::string& bend) {
    return caseOf(channel + bend, channelSides, "", folder.path() / "deck.yaml");
  };
  FlowCase flowCase = make(", floor: {formula: \"0.001 + x/6\"}, ceiling: {table: ceiling.csv}");
  const Mesh mesh = makeMesh(MPI_COMM_WORLD, flowCase);
  EXPECT_NEAR(volumeOf(mesh), 6e-3 * 0.5 * (3e-3 + 1e-3), 1e-15);
  const std::vector<double> area = Surface(mesh).area;
  EXPECT_NEAR(area[0], 3e-3, 1e-14);
  EXPECT_NEAR(area[1], 1e-3, 1e-14);
  EXPECT_NEAR(area[2], std::hypot(6e-3, 1e-3), 1e-14);
  EXPECT_NE(flowFingerprint(flowCase, {}),
            flowFingerprint(make(", floor: {formula: \"0.001 + x/7\"}, ceiling: {table: ceiling.csv}"), {}));
  EXPECT_THAT(messageOf<InputError>([&] { make(", floor: {formula: \"0.001 + x\"}"); }),
              HasSubstr("the floor would meet the ceiling: at x = 0.003 m"));
  EXPECT_THAT(messageOf<InputError>([&] { make(", floor: {formula: \"0.001 + z\"}"); }),
              HasSubstr("mesh.floor.formula"));
  EXPECT_THAT(messageOf<InputError>([&] { make(", floor: {formula: \"0\", table: ceiling.csv}"); }),
              HasSubstr("either 'formula' or 'table'"));
  EXPECT_THAT(messageOf<InputError>([&] { caseOf(spaceMesh + ", floor: {formula: \"0.001\"}", spacePeriodic); }),
              HasSubstr("does not have this"));
}

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

TEST(FlowMesh, AMeshFileHasTheDecksBoundariesInTheDecksOrder) {
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

TEST(FlowMesh, AMeshFileAndTheDeckHaveTheSameNames) {
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

TEST(FlowMesh, AMeshFileStandsAlone) {
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
TEST(FlowMesh, GravityLiesInPlanesOfSymmetry) {
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
TEST(FlowMesh, TheSurfaceOfAMeshFileHasToMakeSense) {
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

TEST(FlowMesh, APartInsideTheMeshIsNoBoundary) {
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
TEST(FlowMesh, AGroupMayBePartlyInside) {
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

TEST(FlowMesh, GroupsWithoutANameGoByTheirNumbers) {
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

TEST(FlowMesh, PartsOfABoxThatSolidsCutOffNeedAnOutlet) {
  const std::string dam = channel + ", solids: {dam: {x: [2 mm, 3 mm]}}", wall = "  dam: {type: wall, solid: dam}\n";
  EXPECT_THAT(messageOf<InputError>([&] {
                FlowCase flowCase = caseOf(dam, channelSides + wall);
                makeMesh(MPI_COMM_WORLD, flowCase);
              }),
              testing::AllOf(HasSubstr("mesh: the mesh has 2 parts that do not touch"),
                             HasSubstr("8 cells, one at (0.0005, 0.0005) m, without an outlet"),
                             HasSubstr("12 cells, one at (0.0035, 0.0005) m, with an outlet")));
  FlowCase open = caseOf(
      dam, "  in: {type: outlet, side: x-min, " + gas + "}" + channelSides.substr(channelSides.find("\n  out")) + wall);
  EXPECT_EQ(makeMesh(MPI_COMM_WORLD, open).totalCells, 20);
}

TEST(FlowMesh, TheStartsLayersLieInTheMeshFile) {
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

TEST(FlowMesh, ACheckpointKnowsTheMeshFile) {
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
