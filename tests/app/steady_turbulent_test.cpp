// Half of a turbulent channel whose cells do not resolve the wall, driven along periodic sides, at a friction Reynolds
// number of 2003, in steady mode.
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

Deck halfChannel(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
transport:
  model: unity_lewis
  sutherland: {viscosity: 1.68e-5 Pa s, temperature: 273 K, constant: 110.5 K, prandtl_number: 0.71}
turbulence: {model: k_epsilon, eddy_viscosity_ratio: 30, energy: 0.8 m^2/s^2}
mesh: {geometry: planar, x: [{to: 6 m, cells: 3}], y: [{to: 5 cm, cells: 10}]}
boundaries:
  left: {type: periodic, side: x-min}
  right: {type: periodic, side: x-max}
  wall: {type: wall, side: y-min, temperature: 300 K}
  middle: {type: symmetry, side: y-max}
driving_acceleration: {x: 8.10175 m/s^2}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K, formula: {velocity_x: "15.2*(y/0.05)^0.125"}}
output: {boundaries: [wall]}
)",
                        overrides);
}

// Its start would be slow enough for cells that are too thin, but it is driven to other speeds.
TEST(SteadyMode, ADrivenStartTellsNothingOfCellsBesideWalls) {
  FlowLoop loop(MPI_COMM_WORLD, readFlowCase(halfChannel({"time.end=1 s", "initial.formula.velocity_x=0.1"})));
  testing::internal::CaptureStderr();
  loop.warnOfStart();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// By wall functions: the mean velocity over the friction velocity is that of a program of its own for the same
// equations in one dimension (docs/verification.md); the first cell's by the logarithmic law, whose mean is below its
// value at the centre.
TEST(SteadyMode, FindsATurbulentChannel) {
  const test::SharedScratchFolder scratch;
  const auto run = [&](const char* name, const std::vector<std::string>& overrides, const char* from = nullptr) {
    std::optional<std::filesystem::path> restart;
    if (from != nullptr) restart = scratch.path() / from;
    test::runFlow(halfChannel(overrides), scratch.path() / name, restart);
  };
  run("found", {"time.mode=steady", "time.first_step=1 ms", "time.maximum_step=1 ms", "checkpoint.at_end=true"});
  const Hdf5Reader found(scratch.path() / "found/results.h5");
  const std::vector<double> velocity = test::lastOf(found, "velocity");
  double bulk = 0.0;
  for (std::size_t i = 0; i < velocity.size(); i += 3) bulk += velocity[i] / 30.0;
  const double friction = std::sqrt(8.10175 * 0.05);
  EXPECT_NEAR(bulk / friction - 0.1 * (1.0 - std::log(2.0)) / 0.41, 22.2784, 2e-4);
  // The wall takes what drives the gas; the table has it face by face, and the cell's y+.
  const double shear = test::lastOf(found, "density").front() * friction * friction;
  EXPECT_NEAR(found.numbers("/walls/wall/friction_x").back() / shear, 1.0, 1e-6);
  EXPECT_NEAR(found.numbers("/history/y_plus_max").back(), 100.15, 0.01);
  EXPECT_NEAR(found.numbers("/walls/wall/y_plus").back(), 100.15, 0.01);
  EXPECT_NEAR(found.numbers("/walls/wall/heat_flux").back(), 0.0, 1e-3);
  EXPECT_LT(found.numbers("/history/iteration").back(), 300.0);
  EXPECT_EQ(found.numbers("/history/held_cells").back(), 0.0);
  const std::vector<double> pressure = test::lastOf(found, "pressure"),
                            isStatic = test::lastOf(found, "static_pressure"),
                            energy = test::lastOf(found, "turbulent_kinetic_energy"),
                            density = test::lastOf(found, "density");
  for (std::size_t c = 0; c < pressure.size(); ++c)
    EXPECT_NEAR(isStatic[c], pressure[c] - 2.0 / 3.0 * density[c] * energy[c], 1e-12 * density[c]);
  // In time it stays as it is.
  const double time = found.numbers("/history/time").back();
  run("on", {"time.end=" + std::to_string(time + 0.1) + " s", "time.maximum_step=4 ms"}, "found");
  const Hdf5Reader on(scratch.path() / "on/results.h5");
  for (const char* field : {"velocity", "turbulent_kinetic_energy", "turbulent_dissipation", "eddy_viscosity"}) {
    const std::vector<double> a = test::lastOf(found, field), b = test::lastOf(on, field);
    const auto [low, high] = std::ranges::minmax(b);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-5 * (high - low)) << field << ' ' << i;
  }
}

class FailsInTheMiddle : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "fault"; }
  void advance(State&, double time, double) override {
    if (time > 2.5e-3) collectively(MPI_COMM_WORLD, [] { throw NumericsError("made to fail"); });
  }
};

// Where a run fails whose cells at walls are not what its model is for, that is told.
TEST(StepRetry, FailuresTellOfCellsThatAreTooThinForTheLawOfTheWall) {
  const test::SharedScratchFolder scratch;
  FailsInTheMiddle fault;
  const auto told = [&](const char* name, const std::string& cells) {
    return test::messageOf<NumericsError>([&] {
      test::runFlow(halfChannel({cells, "time={end: 1 s, first_step: 1 ms, maximum_step: 1 ms, retries: 1}"}),
                    scratch.path() / name, {}, &fault);
    });
  };
  EXPECT_THAT(told("thin", "mesh.y=[{to: 5 cm, cells: 20, ratio: 400}]"),
              testing::AllOf(testing::HasSubstr("made to fail"), testing::HasSubstr("holds from 30 to 300")));
  EXPECT_THAT(told("thick", "mesh.y=[{to: 5 cm, cells: 20}]"),
              testing::AllOf(testing::HasSubstr("made to fail"), testing::Not(testing::HasSubstr("law of the wall"))));
}

// The same by a k-omega model and both layers of the law of the wall at once, cells of y+ 100: the wall takes what
// drives the gas, and the velocity beyond the first cell is that of resolved walls (cases/flow/turbulent_channel).
TEST(SteadyModeLong, AModelOfOmegaMeetsWallsByBothLayers) {
  const test::SharedScratchFolder scratch;
  test::runFlow(halfChannel({"time.mode=steady", "turbulence.model=sst", "turbulence.walls=automatic",
                             "time.first_step=1 ms", "time.maximum_step=1 ms"}),
                scratch.path() / "found");
  const Hdf5Reader found(scratch.path() / "found/results.h5");
  const std::vector<double> velocity = test::lastOf(found, "velocity");
  const double friction = std::sqrt(8.10175 * 0.05),
               shear = test::lastOf(found, "density").front() * friction * friction;
  EXPECT_NEAR(found.numbers("/walls/wall/friction_x").back() / shear, 1.0, 1e-6);
  EXPECT_NEAR(found.numbers("/walls/wall/y_plus").back(), 100.15, 0.01);
  // Of the table sst: half way to the middle, y+ 1001.5, between two cells' centres.
  EXPECT_NEAR(0.5 * (velocity[3 * 12] + velocity[3 * 15]) / friction, 22.382, 0.015 * 22.382);
}

}  // namespace
}  // namespace lampblack::app
