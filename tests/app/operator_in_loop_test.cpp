// What the loop of a flow does for any operator: datasets of its own, tables of regions, and to hold the others.
#include <algorithm>

#include "app/problems/flow/flow_loop.hpp"
#include "core/modules.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using test::at;

// Counts its steps, and from a time on is alone in them.
class Holder final : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "holder"; }
  void advance(State& state, double time, double) override {
    ++steps;
    if (holdsOthers(time) && temperature.empty()) temperature = state.temperature;
    if (!holdsOthers(time)) heldFrom = steps;
    last = state.temperature;
  }
  [[nodiscard]] bool holdsOthers(double time) const override { return time >= 20e-6; }
  [[nodiscard]] std::vector<Dataset> datasets() const override {
    return {{{"/holder/edges", "m", "edges"}, {1.0, 4.0}}};
  }
  [[nodiscard]] std::vector<RegionTable> regionTables() const override {
    return {{"cells", {{"count", "1", "of cells"}}},
            {"halves", {{"part", "1", "first, second"}, {"volume", "m^3", ""}}}};
  }
  [[nodiscard]] std::vector<double> regionRows(std::size_t table, const MeshRegion& region) const override {
    if (table == 0) return {test::sumOverRanks(static_cast<double>(region.cells().size()))};
    return {1.0, 0.5 * region.volume(), 2.0, 0.5 * region.volume()};
  }
  void beginRun() override { ++begun; }

  int steps = 0, heldFrom = 0, begun = 0;
  std::vector<double> temperature, last;  // when it began to hold, and at the end
};

TEST(OperatorInLoop, HasDatasetsTablesOfRegionsAndMayHoldTheOthers) {
  const test::SharedScratchFolder scratch;
  FlowCase flowCase = readFlowCase(
      test::flameDeck({"time.end=40 us", "time.maximum_step=4 us", "output.interval=20 us", "mesh.refinement=0.5"}));
  flowCase.trajectories.reset();
  flowCase.output.tables.regions = {{"all", {-1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}}};
  FlowLoop loop(MPI_COMM_WORLD, std::move(flowCase));
  Holder holder;
  loop.addOperator(holder);
  const RunFolder folder = RunFolder::prepare(scratch.path() / "run", false, MPI_COMM_WORLD);
  loop.run(folder, {"test", "none", {}, "now"});
  EXPECT_EQ(holder.begun, 1);
  EXPECT_GT(holder.heldFrom, 0);
  EXPECT_GT(holder.steps, holder.heldFrom + 3);
  ASSERT_FALSE(holder.temperature.empty());
  EXPECT_EQ(holder.last, holder.temperature) << "nothing else went on";
  const Hdf5Reader results(folder.results());
  EXPECT_EQ(results.numbers("/holder/edges"), (std::vector<double>{1.0, 4.0}));
  const std::vector<double> volumes = results.numbers("/regions/all/halves/volume");
  const auto cells = static_cast<double>(loop.cells());
  EXPECT_EQ(results.numbers("/regions/all/cells/count"), std::vector<double>(3, cells));
  EXPECT_NEAR(results.numbers("/regions/all/cells/time").back(), 40e-6, 1e-15);
  EXPECT_EQ(results.numbers("/regions/all/halves/part"), (std::vector<double>{1.0, 2.0, 1.0, 2.0, 1.0, 2.0}));
  EXPECT_EQ(results.numbers("/regions/all/halves/step").at(1), 0.0);
  double volume = 0.0;
  for (int c = 0; c < loop.mesh().owned; ++c) volume += loop.mesh().volume[at(c)];
  volume = test::sumOverRanks(volume);
  for (const double half : volumes) EXPECT_NEAR(half, 0.5 * volume, 1e-12 * volume);
}

}  // namespace
}  // namespace lampblack::app
