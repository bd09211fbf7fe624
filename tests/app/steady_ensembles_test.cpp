// `time: {mode: steady}` with ensembles in the cells: the gas and they in turn.
#include <algorithm>
#include <cmath>

#include "core/modules.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/flow_results.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Hot gas with naphthalene, which nothing burns, along a channel.
Deck pipe(const std::vector<std::string>& overrides) {
  return test::flowDeck("ethylene_bisetti2012_47.yaml", R"(
mesh: {geometry: planar, x: [{to: 1 mm, cells: 1}], y: [{to: 8 mm, cells: 8}]}
boundaries:
  in: {type: inlet, side: y-min, velocity: 2 m/s, temperature: 1500 K, composition: "N2: 0.9, H2: 0.1, A2: 1e-4"}
  out: {type: outlet, side: y-max, temperature: 1500 K, composition: "N2: 1"}
  left: {type: symmetry, side: x-min}
  right: {type: symmetry, side: x-max}
initial: {layer: none, composition: "N2: 0.9, H2: 0.1", temperature: 1500 K}
output: {species: [A2], boundaries: [all], history_steps: 50}
particles: {description: ensemble, pah: [A2], number: 60, keep_hydrogen: false, split_tolerance: 0.2, statistics: {block: 1 ms, drift: 0.05}}
)",
                        overrides);
}

RunRecord runPipe(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                  const std::optional<std::filesystem::path>& restart = {}) {
  return test::runFlow(pipe(overrides), path, restart);
}

const std::vector<std::string> inTurn{"time.mode=steady", "time.steady.blocks=20", "time.steady.residual=1e-6"};

TEST(SteadyEnsembles, EndWhereARunInTimeWithBothHasItsMean) {
  const test::SharedScratchFolder scratch;
  const RunRecord record = runPipe(scratch.path() / "turns", inTurn);
  EXPECT_THAT(record.resultsJson, AllOf(HasSubstr("\"steady\": true"), HasSubstr("\"rounds\":")));
  runPipe(scratch.path() / "march",
          {"time.end=60 ms", "particles.statistics.start=20 ms", "particles.averaging_time=2 ms"});
  const Hdf5Reader turns(scratch.path() / "turns/results.h5"), march(scratch.path() / "march/results.h5");
  for (const char* field : {"soot_number_density", "soot_volume_fraction"}) {
    const std::string mean = std::string(field) + "_mean", interval = std::string(field) + "_interval";
    const std::vector<double> a = test::lastOf(turns, mean), b = test::lastOf(march, mean),
                              da = test::lastOf(turns, interval), db = test::lastOf(march, interval);
    for (std::size_t c = 0; c < a.size(); ++c)
      EXPECT_LT(std::abs(a[c] - b[c]), 2.0 * std::hypot(da[c], db[c]) + 0.01 * b[c]) << field << ' ' << c;
    EXPECT_GT(b.back(), 0.0);
  }
  // The gas lacks what the particles take.
  const std::vector<double> a = test::lastOf(turns, "X_A2"), b = test::lastOf(march, "X_A2");
  EXPECT_LT(a.back(), 0.8e-4);
  for (std::size_t c = 0; c < a.size(); ++c) EXPECT_NEAR(a[c] / b[c], 1.0, 0.02) << c;
}

// In a turn of the particles, in their averages, and in the iterations of a later turn of the gas.
TEST(SteadyEnsembles, GoOnFromACheckpointAsIfTheyHadNotStopped) {
  if (test::worldSize() > 1) GTEST_SKIP() << "pieces of the mesh may be others behind a restart";
  const test::SharedScratchFolder scratch;
  std::vector<std::string> settings = inTurn;
  settings.insert(settings.end(), {"time.steady.rounds=2", "time.steady.blocks=5", "output.history_steps=1",
                                   "chemistry.share_work=false"});
  int stands = 0, goes = 0;
  for (const std::size_t step : {130U, 170U, 195U}) {
    const std::filesystem::path all = scratch.path() / fmt::format("all_{}", step),
                                on = scratch.path() / fmt::format("on_{}", step);
    std::vector<std::string> saving = settings;
    saving.push_back(fmt::format("checkpoint.steps={}", step));
    runPipe(all, saving);
    const test::Ran whole = test::readBack(all / "results.h5");
    const std::vector<double>& time = whole.history.at("time");
    ASSERT_LT(step + 1, time.size());
    ++(time[step + 1] == time[step] ? stands : goes);
    runPipe(on, saving, all / fmt::format("checkpoint/step_{:06}.h5", step));
    test::expectSameBits(test::readBack(on / "results.h5"), whole);
  }
  EXPECT_EQ(stands, 1);
  EXPECT_EQ(goes, 2);
}

// Then one round is all, and the gas is what it is without particles.
TEST(SteadyEnsembles, HaveOneRoundInAGasThatDoesNotKnowOfThem) {
  const test::SharedScratchFolder scratch;
  std::vector<std::string> settings = inTurn;
  settings.insert(settings.end(), {"particles.exchange=one_way", "time.steady.blocks=5"});
  runPipe(scratch.path() / "one_way", settings);
  test::runFlow(pipe({"time.mode=steady", "time.steady.residual=1e-6", "particles={description: none}"}),
                scratch.path() / "alone");
  const Hdf5Reader found(scratch.path() / "one_way/results.h5"), expected(scratch.path() / "alone/results.h5");
  for (const char* field : {"temperature", "X_A2"})
    EXPECT_EQ(test::lastOf(found, field), test::lastOf(expected, field)) << field;
  EXPECT_GT(test::lastOf(found, "soot_number_density_mean").back(), 0.0);
  // What the state then has of the particles is the mean of the averages, but for the weight of each block.
  const double mean = test::lastOf(found, "soot_volume_fraction_mean").back();
  EXPECT_NEAR(test::lastOf(found, "soot_volume_fraction").back() / mean, 1.0, 0.01);
}

}  // namespace
}  // namespace lampblack::app
