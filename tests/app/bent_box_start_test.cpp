// A start from a coarser mesh of a box that is bent: places go by the columns and by the share of the height.
#include <cmath>

#include "app/problems/flow/box_places.hpp"
#include "app/problems/flow/coarser_meshes.hpp"
#include "app/problems/flow/initial_flow.hpp"
#include "core/errors.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using flowcase::BoxPlaces;
using testing::HasSubstr;

// Gas creeps over a hill, whose cells at the floor are thinner than what the floor bends by between columns.
Deck overAHill(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
mesh:
  geometry: planar
  x: [{to: 40 cm, cells: 8}]
  y: [{to: 10 cm, cells: 8, ratio: 60}]
  floor: {formula: "0.01+0.03*sin(pi*x/0.4)^2"}
boundaries:
  in: {type: inlet, side: x-min, velocity: 2 cm/s, temperature: 300 K, composition: "GAS: 1"}
  out: {type: outlet, side: x-max, temperature: 300 K, composition: "GAS: 1"}
  floor: {type: wall, side: y-min, temperature: 300 K}
  top: {type: wall, side: y-max, temperature: 300 K}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K}
time: {mode: steady, steady: {residual: 1e-3}}
output: {species: [all]}
)",
                        overrides);
}

// Of a box whose floor is bent, or whose ceiling is.
void placesGoByColumnsAndHeights(bool isFloor) {
  MeshSpec mesh;
  mesh.vertices[0] = {0.0, 1.0, 3.0};
  mesh.vertices[1] = {1.0, 1.5, 3.0};
  const auto low = [&](double x) { return isFloor ? 0.25 * x * x : 1.0; };
  const auto high = [&](double x) { return isFloor ? 4.0 : 4.0 + 0.5 * x * x; };
  mesh.map = [&](const std::array<double, 3>& place) {
    const double x = place[0];
    return std::array{x, low(x) + 0.5 * (place[1] - 1.0) * (high(x) - low(x)), place[2]};
  };
  std::vector<double> vertices;
  for (const double y : mesh.vertices[1])
    for (const double x : mesh.vertices[0])
      for (const double coordinate : mesh.map({x, y, 0.0})) vertices.push_back(coordinate);
  for (const BoxPlaces& places : {BoxPlaces(mesh), BoxPlaces(vertices)}) {
    // Half way between the last columns floor and ceiling are at the means of their heights there.
    const double floor = 0.5 * (low(1.0) + low(3.0)), ceiling = 0.5 * (high(1.0) + high(3.0));
    const auto [x, share] = places.of(2.0, floor + 0.4 * (ceiling - floor));
    EXPECT_DOUBLE_EQ(x, 2.0);
    EXPECT_NEAR(share, 0.4, 1e-15);
    EXPECT_EQ(places.middle(2.9, isFloor ? 2.3 : 2.0), (std::array{2.0, 0.125}));
    EXPECT_EQ(places.middle(0.1, 3.0), (std::array{0.5, 0.625}));
    EXPECT_DOUBLE_EQ(places.rise(), isFloor ? 2.25 : 4.5);
  }
  MeshSpec other = mesh;
  other.vertices[0] = {0.0, 3.0};
  EXPECT_DOUBLE_EQ(BoxPlaces(mesh).apart(BoxPlaces(other)), isFloor ? 0.5 : 1.0);
  EXPECT_DOUBLE_EQ(BoxPlaces(other).apart(BoxPlaces(mesh)), 0.0);
  // Behind the end of the other box there is nothing to compare with.
  MeshSpec shorter = mesh;
  shorter.vertices[0] = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(BoxPlaces(mesh).apart(BoxPlaces(shorter)), 0.0);
  vertices.resize(15);
  EXPECT_THROW((BoxPlaces(vertices)), InputError);
}

TEST(BentBoxStart, PlacesGoByColumnsAndHeights) {
  for (const bool isFloor : {true, false}) placesGoByColumnsAndHeights(isFloor);
}

TEST(BentBoxStart, IsTheCoarserMeshCellByCell) {
  const test::SharedScratchFolder scratch;
  const Deck deck = overAHill({"mesh.refinement=2"});
  const FlowCase fine =
      caseFromCoarserMeshes(MPI_COMM_WORLD, deck, 1, RunFolder::prepare(scratch.path() / "hill", false, MPI_COMM_WORLD),
                            {"test", "none", deck.resolved(), "now"});
  const std::filesystem::path file = scratch.path() / "hill/coarser_1/results.h5";
  const Hdf5Reader coarse(file);
  const std::vector<double> velocity = test::lastOf(coarse, "velocity");
  const FlowCase own = readFlowCase(overAHill({}));
  ASSERT_EQ(velocity.size(), 3 * 64U);
  double fastest = 0.0;
  for (std::size_t j = 0; j < 8; ++j)
    for (std::size_t i = 0; i < 8; ++i) {
      const auto middle = [&](std::size_t axis, std::size_t at) {
        return 0.5 * (own.mesh.vertices[axis][at] + own.mesh.vertices[axis][at + 1]);
      };
      // A column of the finer mesh.
      const std::array<double, 3> place = fine.mesh.map({middle(0, i), middle(1, j), 0.0});
      for (std::size_t axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(fine.initialFields.velocity[axis]({place[0], place[1], 0.0}, 0.0), velocity[3 * (i + 8 * j) + axis],
                    1e-12);
      fastest = std::max(fastest, velocity[3 * (i + 8 * j)]);
    }
  EXPECT_GT(fastest, 0.02);
  const auto refused = [&](const std::vector<std::string>& overrides) {
    FlowCase other = readFlowCase(overAHill(overrides));
    return test::messageOf<InputError>(
        [&] { flowcase::readEarlierFlow(file, {}, other, flowcase::EarlierDeck::AnyOther); });
  };
  EXPECT_THAT(refused({"mesh.floor.formula='0.01+0.02*sin(pi*x/0.4)^2'"}), HasSubstr("another floor or ceiling"));
  // Also where they are apart on the columns of one of the meshes only.
  EXPECT_THAT(refused({"mesh.refinement=2", "mesh.floor.formula='0.01+0.03*sin(pi*x/0.4)^2+0.006*sin(pi*x/0.05)'"}),
              HasSubstr("another floor or ceiling"));
  EXPECT_THAT(refused({"mesh.x=[{to: 40 cm, cells: 4}]"}), HasSubstr("another floor or ceiling"));
  EXPECT_THAT(refused({"mesh.x=[{to: 50 cm, cells: 8}]"}), HasSubstr("reaches from"));
  FlowCase even = readFlowCase(overAHill({}));
  even.mesh.map = nullptr;
  EXPECT_THAT(
      test::messageOf<InputError>([&] { flowcase::readEarlierFlow(file, {}, even, flowcase::EarlierDeck::AnyOther); }),
      HasSubstr("of a box with a floor"));
}

// A step of the floor within a column of the coarser mesh, which has half of its rise where the finer one has all.
TEST(BentBoxStart, IsOfTheSameBoxHoweverTheFloorRunsBetweenColumns) {
  const test::SharedScratchFolder scratch;
  const Deck deck = overAHill({"mesh.refinement=2", "mesh.floor.formula='0.015*(1+tanh((x-0.2125)/0.005))'"});
  const FlowCase fine =
      caseFromCoarserMeshes(MPI_COMM_WORLD, deck, 1, RunFolder::prepare(scratch.path() / "step", false, MPI_COMM_WORLD),
                            {"test", "none", deck.resolved(), "now"});
  EXPECT_TRUE(fine.time.search->coarser.front().isStart);
  EXPECT_NEAR(fine.initialFields.gas.temperature(fine.mesh.map({0.225, 0.05, 0.0}), 0.0), 300.0, 1e-6);
  // Of another deck the same two boxes do not meet.
  FlowCase other = readFlowCase(deck);
  EXPECT_THAT(test::messageOf<InputError>([&] {
                flowcase::readEarlierFlow(scratch.path() / "step/coarser_1/results.h5", {}, other,
                                          flowcase::EarlierDeck::AnyOther);
              }),
              HasSubstr("another floor or ceiling"));
}

}  // namespace
}  // namespace lampblack::app
