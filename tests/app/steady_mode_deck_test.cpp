// What a deck with `time: {mode: steady}` is read as, and refused for; its coarser meshes.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/problems/flow/coarser_meshes.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/app/steady_mode_decks.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

using steadymode::channel;
using steadymode::hydrogenBesideAir;
using steadymode::steady;

struct Refused {
  const char* name;
  std::vector<std::string> settings;
  const char* message;
};
class SteadyModeRefuses : public testing::TestWithParam<Refused> {};

TEST_P(SteadyModeRefuses, SayingWhatIsExpected) {
  std::vector<std::string> settings{steady};
  settings.insert(settings.end(), GetParam().settings.begin(), GetParam().settings.end());
  EXPECT_THAT(test::messageOf<InputError>([&] { readFlowCase(channel(settings)); }), HasSubstr(GetParam().message));
}

const char* const closed = "boundaries.out={type: wall, side: y-max}";
const char* const noInlet = "boundaries.in={type: wall, side: y-min, tangential_velocity: 1 m/s}";
const char* const noCold = "boundaries.cold={type: wall, side: x-min}";

INSTANTIATE_TEST_SUITE_P(
    Decks, SteadyModeRefuses,
    testing::Values(
        Refused{"AnEnd", {"time.end=1 s"}, "time.end: 'time.mode: steady' does not have this"},
        Refused{"Sweeps", {"time.sweeps=2"}, "time.sweeps: 'time.mode: steady' does not have this"},
        Refused{"AToleranceOfTime", {"time.steady.tolerance=0.1"}, "time.steady.tolerance: 'time.mode: steady'"},
        Refused{"Outputs", {"output.interval=1 s"}, "output.interval: 'time.mode: steady' does not have this"},
        Refused{"CentralConvection", {"convection.velocity=central"}, "convection.velocity: a steady state is sought"},
        Refused{"AFormulaOfTime",
                {"boundaries.cold.formula.tangential_velocity='0.1*sin(t)'"},
                "boundaries.cold: what this boundary has depends on the time t"},
        Refused{"ABranchThatEndsBeforeItBegins",
                {"time.steady.continuation.highest_load=0.5"},
                "time.steady.continuation: the branch begins with a load of one"},
        Refused{"ABranchOfNoBoundary",
                {"time.steady.continuation.key=boundaries.inn.velocity"},
                "there is no boundary 'inn'; did you mean 'in'?"},
        Refused{"ABranchOfAnOutletsGas",
                {"time.steady.continuation.key=boundaries.out.temperature"},
                "'out' is no inlet, nor a wall that has a temperature"},
        Refused{
            "ABranchOfTheMesh", {"time.steady.continuation.key=mesh.refinement"}, "expected 'pressure', or a value"},
        Refused{"StepsOfOneTimeWithoutEddies",
                {"time.steady.one_time=true"},
                "time.steady.one_time: steps of one time are for a gas that reacts in eddies"},
        Refused{"AVesselThatIsFilled", {closed}, "time.mode: a vessel without an outlet"},
        Refused{"AVesselThatIsCooled", {closed, noInlet, "boundaries.cold.temperature=299 K"}, "a vessel without"},
        Refused{
            "AVesselThatIsHeated", {closed, noInlet, noCold, "boundaries.adiabatic.heat_flux=1 W/m^2"}, "a vessel"}),
    [](const auto& refused) { return std::string(refused.param.name); });

TEST(SteadyMode, TakesWhatHasASteadyState) {
  EXPECT_NO_THROW(readFlowCase(channel({steady, "boundaries.cold.formula.tangential_velocity='0.1*sin(y)'"})));
  // Stirred gas of one temperature keeps its pressure.
  const FlowCase stirred = readFlowCase(channel({steady, closed, noInlet, "time.steady.time=1 s"}));
  EXPECT_EQ(stirred.time.steadyTime(), 1.0);
  EXPECT_TRUE(std::isinf(stirred.time.end));
  const FlowCase usual = readFlowCase(channel({steady, "time.steady={}"}));
  EXPECT_EQ(usual.time.search->residual, SteadySearch::Options().residual);
  EXPECT_EQ(usual.time.search->iterations, SteadySearch::Options().iterations);
  EXPECT_EQ(readFlowCase(channel({"time.end=1 s"})).time.search, std::nullopt);
}

TEST(SteadyMode, SeeksFlamesOfManyCellsOnCoarserMeshesFirst) {
  const auto meshes = [](const Deck& deck) { return readFlowCase(deck).time.search->coarserMeshes; };
  const std::string few = "mesh.refinement=6.8", more = "mesh.refinement=7", many = "mesh.refinement=14";
  EXPECT_EQ(meshes(hydrogenBesideAir({})), 0);
  EXPECT_EQ(meshes(hydrogenBesideAir({few})), 0);  // 54 by 54
  EXPECT_EQ(meshes(hydrogenBesideAir({more})), 1);
  EXPECT_EQ(meshes(hydrogenBesideAir({many})), 2);
  EXPECT_EQ(meshes(hydrogenBesideAir({many, "time.steady.coarser_meshes=0"})), 0);
  EXPECT_EQ(meshes(hydrogenBesideAir({"time.steady.coarser_meshes=3"})), 3);
  EXPECT_EQ(meshes(channel({steady, "mesh.refinement=20"})), 0);
}

TEST(SteadyMode, TakesStepsOfOneTimeOfAFlameInEddiesAlone) {
  const auto search = [](const std::vector<std::string>& settings) {
    std::vector<std::string> all{
        "turbulence={model: sst, wall_distance: infinite, eddy_viscosity_ratio: 1, energy: 0.01 m^2/s^2}"};
    for (const char* inlet : {"fuel", "air"})
      for (const char* what : {"turbulence_intensity=0.05", "eddy_viscosity_ratio=1"})
        all.push_back(fmt::format("boundaries.{}.{}", inlet, what));
    all.insert(all.end(), settings.begin(), settings.end());
    return *readFlowCase(hydrogenBesideAir(all)).time.search;
  };
  const std::string oneTime = "time.steady.one_time=true";
  EXPECT_FALSE(search({}).oneTime);
  EXPECT_TRUE(search({oneTime}).oneTime);
  EXPECT_GT(search({oneTime}).patience, search({}).patience);
  EXPECT_THAT(test::messageOf<InputError>([&] {
                search({oneTime, "time.steady.continuation={maximum_points: 2, key: pressure}"});
              }),
              HasSubstr("do not know a load that is sought"));
}

TEST(SteadyMode, StartsFromACoarserMeshThatBurns) {
  const test::SharedScratchFolder scratch;
  const auto seek = [&](const char* name, const std::vector<std::string>& settings) {
    const RunFolder folder = RunFolder::prepare(scratch.path() / name, false, MPI_COMM_WORLD);
    const Deck deck = hydrogenBesideAir(settings);
    return caseFromCoarserMeshes(MPI_COMM_WORLD, deck, 1, folder, {"test", "none", deck.resolved(), "now"});
  };
  const std::vector<std::string> twice{"mesh.refinement=2", "time.steady.steps=60", "time.steady.coarser_meshes=1",
                                       "checkpoint={steps: 45}"};
  const FlowCase burns = seek("burns", twice);
  ASSERT_EQ(burns.time.search->coarser.size(), 1U);
  const TimeControl::Search::Coarser& coarser = burns.time.search->coarser.front();
  EXPECT_EQ(coarser.cells, 64);
  EXPECT_TRUE(coarser.isSteady);
  EXPECT_TRUE(coarser.isStart);
  EXPECT_GT(coarser.iterations, 0);
  EXPECT_GE(coarser.steps, 60);
  EXPECT_EQ(burns.time.search->steps, 50);
  const Hdf5Reader results(scratch.path() / "burns/coarser_1/results.h5");
  const Vector3 firstCentre{5e-4, 7.5e-4, 0.0};
  EXPECT_NEAR(burns.initialFields.gas.temperature(firstCentre, 0.0), test::lastOf(results, "temperature")[0], 1e-6);
  // A run that goes on from a checkpoint among the steps takes no more of them.
  FlowLoop whole(MPI_COMM_WORLD, burns);
  whole.run(RunFolder::prepare(scratch.path() / "whole", false, MPI_COMM_WORLD), {"test", "none", {}, "now"});
  EXPECT_EQ(whole.searchAsCoarser().steps, 50);
  FlowLoop restarted(MPI_COMM_WORLD, readFlowCase(hydrogenBesideAir(twice)));
  restarted.load(newestCheckpoint(MPI_COMM_WORLD, scratch.path() / "whole"));
  EXPECT_LT(restarted.searchAsCoarser().steps, 50);
  restarted.run(RunFolder::prepare(scratch.path() / "restarted", false, MPI_COMM_WORLD), {"test", "none", {}, "now"});
  EXPECT_EQ(restarted.searchAsCoarser().steps, 50);
  EXPECT_EQ(restarted.searchAsCoarser().iterations, whole.searchAsCoarser().iterations);
  RunRecord record;
  restarted.report(1.0, record);
  EXPECT_THAT(record.resultsJson, ContainsRegex("\"coarser_meshes\": \\[[^]]*\"cells\": 64"));
  // Nothing burns there: the start is the deck's own.
  const FlowCase dark = seek("dark", {"mesh.refinement=2", "time.steady.light=false"});
  EXPECT_FALSE(dark.time.search->coarser.front().isStart);
  EXPECT_NEAR(dark.initialFields.gas.temperature({5e-4, 0.011, 0.0}, 0.0), 1198.0, 1e-6);
}

}  // namespace
}  // namespace lampblack::app
