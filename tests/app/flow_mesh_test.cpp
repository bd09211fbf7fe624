// Decks that ask for meshes of every kind get them, and are told what is wrong with them.
#include "app/problems/flow/flow_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/problems/flow/flow_checkpoint.hpp"
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
using testing::ElementsAre;
using testing::HasSubstr;

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

  MPI_Barrier(MPI_COMM_WORLD);
  if (test::worldRank() == 0) std::ofstream(folder.path() / "start.csv") << "r,velocity_y\n0,1\n";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(messageOf<InputError>([&] {
                caseOf(spaceMesh, spacePeriodic,
                       "initial: {layer: none, composition: \"GAS: 1\", temperature: 300 K, table: start.csv}\n",
                       folder.path() / "deck.yaml");
              }),
              HasSubstr("start.csv: 'r' cannot be given here; expected one of: temperature, velocity_x, velocity_y, "
                        "velocity_z, or X_ and the name of a species; places and times are columns x, y, z, t"));
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

TEST(FlowMesh, TheAxisNeedsNoBoundary) {
  const std::string sides = "  in: {type: inlet, side: z-min, velocity: 1 m/s, " + gas +
                            "}\n  out: {type: outlet, side: z-max, " + gas + "}\n  wall: {type: wall, side: r-max}\n";
  const std::string tube = "geometry: axisymmetric, r: [{to: 4 mm, cells: 4}], z: [{to: 6 mm, cells: 3}]";
  FlowCase given = caseOf(tube, sides + "  axis: {type: symmetry, side: r-min}\n"), without = caseOf(tube, sides);
  const Mesh a = makeMesh(MPI_COMM_WORLD, given), b = makeMesh(MPI_COMM_WORLD, without);
  EXPECT_EQ(a.patches, b.patches);
  EXPECT_EQ(Surface(a).faces, Surface(b).faces);
  EXPECT_EQ(without.boundaries.back().kind, flow::BoundaryKind::Symmetry);
  FlowCase aroundRod = caseOf(tube + ", solids: {rod: {r: [0 mm, 1 mm]}}", sides + "  rod: {type: wall, solid: rod}\n");
  EXPECT_THAT(makeMesh(MPI_COMM_WORLD, aroundRod).patches, ElementsAre("in", "out", "wall", "rod"));
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
}  // namespace
}  // namespace lampblack::app
