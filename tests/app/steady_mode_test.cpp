// A deck with `time: {mode: steady}`: what is found, what is written, how it ends where nothing is found, and that a
// run goes on from a checkpoint as if it had not stopped.
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/problems/flow/coarser_meshes.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/models/radiation.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

// Warm gas into a channel with a cold wall.
Deck channel(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
mesh: {geometry: planar, x: [{to: 4 mm, cells: 5}], y: [{to: 8 mm, cells: 8}]}
boundaries:
  in: {type: inlet, side: y-min, velocity: 30 cm/s, temperature: 400 K, composition: "GAS: 1"}
  out: {type: outlet, side: y-max, temperature: 300 K, composition: "GAS: 1"}
  cold: {type: wall, side: x-min, temperature: 300 K}
  adiabatic: {type: wall, side: x-max}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K}
)",
                        overrides);
}

// Fails in the step, or the iteration, of this number.
class FailsFrom : public Operator {
 public:
  explicit FailsFrom(double time) : time_(time) {}
  [[nodiscard]] const char* name() const override { return "fault"; }
  void advance(State&, double time, double) override {
    if (time < time_) return;
    collectively(MPI_COMM_WORLD, [] { throw NumericsError("made to fail"); });
  }

 private:
  double time_;
};

// Evaluates so many states, and fails in the next two: that of an iteration, and that which it goes back to.
class FailsTwice : public Operator {
 public:
  explicit FailsTwice(int evaluations) : left_(evaluations) {}
  [[nodiscard]] const char* name() const override { return "fault"; }
  void advance(State&, double, double) override {}
  void addRates(const State&, State::Balance&) override {
    if (--left_ < 0 && left_ >= -2) collectively(MPI_COMM_WORLD, [] { throw NumericsError("made to fail"); });
  }

 private:
  int left_;
};

// `restart`: the folder of a run, or a checkpoint.
RunRecord runChannel(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                     const std::optional<std::filesystem::path>& restart = {}, Operator* more = nullptr) {
  return test::runFlow(channel(overrides), path, restart, more);
}

const std::string steady = "time.mode=steady", boundaries = "output.boundaries=[all]";

TEST(SteadyMode, FindsTheStateThatALongRunInTimeEndsIn) {
  const test::SharedScratchFolder scratch;
  const RunRecord found = runChannel(scratch.path() / "found", {steady, "time.steady.residual=1e-9", boundaries});
  runChannel(scratch.path() / "marched", {"time.end=0.3 s", "output.history_steps=100", boundaries});
  const Hdf5Reader results(scratch.path() / "found/results.h5"), marched(scratch.path() / "marched/results.h5");
  for (const char* field : {"temperature", "velocity", "viscosity", "conductivity"}) {
    const std::vector<double> a = test::lastOf(results, field), b = test::lastOf(marched, field);
    const auto [low, high] = std::ranges::minmax(b);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-6 * (high - low)) << field << ' ' << i;
  }
  const auto crosses = [&](const Hdf5Reader& of, const std::string& what) {
    return of.numbers("/boundaries/" + what).back();
  };
  for (const char* what :
       {"in/mass_flow", "out/mass_flow", "out/enthalpy_flow", "cold/heat_flow", "cold/viscous_force_y"})
    EXPECT_NEAR(crosses(results, what) / crosses(marched, what), 1.0, 1e-6) << what;
  // In less time than the flow needs: 0.028 s are a residence time.
  const std::vector<double> time = results.numbers("/history/time"), iteration = results.numbers("/history/iteration"),
                            dt = results.numbers("/history/dt"),
                            enthalpy = results.numbers("/history/residual_enthalpy");
  EXPECT_LT(time.back(), 0.1);
  EXPECT_GT(iteration.back(), 0.0);
  EXPECT_LE(enthalpy.back(), 1e-9);
  for (std::size_t row = 1; row < time.size(); ++row) {
    // A row is a step in time or an iteration.
    const double iterations = iteration[row] - iteration[row - 1];
    EXPECT_TRUE(iterations == 0.0 || iterations == 1.0) << row;
    EXPECT_EQ(iterations == 1.0, time[row] == time[row - 1]) << row;
    EXPECT_EQ(iterations == 1.0, dt[row] == 0.0) << row;
  }
  EXPECT_EQ(results.names("/steps").size(), 2U);
  EXPECT_THAT(found.resultsJson, AllOf(HasSubstr("\"steady\": true"), HasSubstr("\"iterations\": "),
                                       HasSubstr("\"residual_before_iterations\": ")));
}

TEST(SteadyMode, WhereNothingIsFoundTheStateIsKeptToGoOnFrom) {
  const test::SharedScratchFolder scratch;
  const auto out = scratch.path() / "out";
  const std::string message = test::messageOf<NumericsError>([&] {
    runChannel(out, {steady, "time.steady.residual=1e-9", "time.steady.iterations=2", "time.steady.attempts=0"});
  });
  EXPECT_THAT(message, AllOf(HasSubstr("no steady state with residuals below 1e-09 was found in 50 steps in time and 2 "
                                       "iterations"),
                             HasSubstr("the largest residual is that of "), HasSubstr("time.steady.iterations"),
                             HasSubstr("time.mode: transient"), HasSubstr("--restart goes on from ")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
  const Hdf5Reader kept(out / "results.h5.part");
  EXPECT_EQ(kept.numbers("/history/iteration").back(), 2.0);
  EXPECT_EQ(kept.names("/steps").size(), 2U);
  // In time too, whose history has not the same columns.
  const double time = kept.numbers("/history/time").back();
  runChannel(scratch.path() / "on", {"time.end=" + std::to_string(time + 1e-3) + " s"}, out);
  const Hdf5Reader on(scratch.path() / "on/results.h5");
  EXPECT_FALSE(on.has("/history/iteration"));
  EXPECT_EQ(on.numbers("/history/time").at(51), time);
}

void expectSameRun(const std::filesystem::path& found, const std::filesystem::path& expected) {
  const Hdf5Reader a(found / "results.h5"), b(expected / "results.h5");
  EXPECT_EQ(test::lastOf(a, "temperature"), test::lastOf(b, "temperature"));
  EXPECT_EQ(test::lastOf(a, "velocity"), test::lastOf(b, "velocity"));
  for (const std::string& column : b.names("/history")) {
    const std::vector<double> one = a.numbers("/history/" + column), other = b.numbers("/history/" + column);
    ASSERT_EQ(one.size(), other.size()) << column;
    for (std::size_t row = 0; row < one.size(); ++row)
      ASSERT_TRUE(one[row] == other[row] || (std::isnan(one[row]) && std::isnan(other[row]))) << column << ' ' << row;
  }
}

TEST(SteadyMode, GoesOnFromACheckpointAsIfItHadNotStopped) {
  const test::SharedScratchFolder scratch;
  const std::vector<std::string> settings{steady, "time.steady.residual=1e-6", "time.steady.attempts=0",
                                          "chemistry.share_work=false"};
  runChannel(scratch.path() / "whole", settings);
  // Stopped in the steps in time.
  std::vector<std::string> failing = settings;
  failing.emplace_back("time.retries=0");
  FailsFrom fault(1e-3);
  EXPECT_THROW(runChannel(scratch.path() / "steps", failing, {}, &fault), NumericsError);
  runChannel(scratch.path() / "steps on", settings, scratch.path() / "steps");
  expectSameRun(scratch.path() / "steps on", scratch.path() / "whole");
  // And in the iterations.
  std::vector<std::string> few = settings;
  few.emplace_back("time.steady.iterations=3");
  EXPECT_THROW(runChannel(scratch.path() / "iterations", few), NumericsError);
  runChannel(scratch.path() / "iterations on", settings, scratch.path() / "iterations");
  expectSameRun(scratch.path() / "iterations on", scratch.path() / "whole");
}

// Of states along the load; the run's own state is the first.
TEST(SteadyMode, FollowsABranchAndKeepsTheStateThatWasFound) {
  const test::SharedScratchFolder scratch;
  const std::string branch = "time.steady.continuation={first_step: 0.2, maximum_points: 4}";
  const RunRecord followed = runChannel(scratch.path() / "branch", {steady, branch, boundaries});
  runChannel(scratch.path() / "alone", {steady, boundaries});
  const Hdf5Reader a(scratch.path() / "branch/results.h5"), b(scratch.path() / "alone/results.h5");
  for (const char* field : {"temperature", "velocity", "viscosity"})
    EXPECT_EQ(test::lastOf(a, field), test::lastOf(b, field));
  const std::vector<double> load = a.numbers("/continuation/load"), residual = a.numbers("/continuation/residual");
  ASSERT_EQ(load.size(), 4U);
  EXPECT_EQ(load[0], 1.0);
  EXPECT_NEAR(load[1], 1.2, 1e-12);
  EXPECT_GT(load[3], load[2]);
  EXPECT_LE(std::ranges::max(residual), 1e-7);
  EXPECT_TRUE(a.numbers("/continuation/turning_points/load").empty());
  EXPECT_THAT(followed.resultsJson, AllOf(HasSubstr("\"branch\": "), HasSubstr("\"reason\": \"4 points\"")));
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "branch/branch.csv"));
  // At the load of the second state, by itself; the same by the key of the only inlet.
  const std::string ofKey =
      "time.steady.continuation={first_step: 0.2, maximum_points: 2, key: boundaries.in.velocity}";
  runChannel(scratch.path() / "key", {steady, ofKey, boundaries});
  const Hdf5Reader key(scratch.path() / "key/results.h5");
  EXPECT_NEAR(key.numbers("/continuation/value")[1], 0.36, 1e-12);
  EXPECT_NEAR(key.numbers("/continuation/maximum_temperature")[1], a.numbers("/continuation/maximum_temperature")[1],
              1e-3);
  runChannel(scratch.path() / "second", {steady, "boundaries.in.velocity=36 cm/s"});
  const Hdf5Reader second(scratch.path() / "second/results.h5");
  EXPECT_NEAR(a.numbers("/continuation/maximum_temperature")[1], std::ranges::max(test::lastOf(second, "temperature")),
              1e-4);
}

// Whose velocities and mass fluxes are round-off.
TEST(SteadyMode, FindsGasAtRest) {
  const test::SharedScratchFolder scratch;
  const std::vector<std::string> still{steady, "boundaries.in={type: wall, side: y-min}", "time.steady.returns=0",
                                       "time.steady.attempts=2"};
  for (const char* out : {"boundaries.out={type: outlet, side: y-max, temperature: 300 K, composition: 'GAS: 1'}",
                          "boundaries.out={type: wall, side: y-max}"}) {
    std::vector<std::string> settings = still;
    settings.emplace_back(out);
    const RunRecord found = runChannel(scratch.path() / (out[22] == 'o' ? "open" : "closed"), settings);
    // After ten steps where little is left of the equations, else by the attempt after twenty.
    EXPECT_THAT(found.resultsJson,
                AllOf(HasSubstr("\"steady\": true"), testing::ContainsRegex("\"steps_in_time\": [12]0,")))
        << out;
  }
}

// A hot spot in nitrogen, far from where hydrogen and air come in and meet: it lights nothing.
Deck hydrogenBesideAir(const std::vector<std::string>& overrides) {
  return test::flowDeck("hydrogen_h2o2_10.yaml", R"deck(
mesh: {geometry: planar, x: [{to: 8 mm, cells: 8}], y: [{to: 12 mm, cells: 8}]}
boundaries:
  fuel: {type: inlet, side: y-min, to: 4 mm, velocity: 30 cm/s, temperature: 298 K, composition: "H2: 0.3, N2: 0.7"}
  air: {type: inlet, side: y-min, from: 4 mm, velocity: 30 cm/s, temperature: 298 K, composition: "O2: 0.21, N2: 0.79"}
  out: {type: outlet, side: y-max, temperature: 298 K, composition: "N2: 1"}
  axis: {type: symmetry, side: x-min}
  shroud: {type: wall, side: x-max, slip: true}
initial: {layer: none, composition: "N2: 1", temperature: 298 K, formula: {temperature: "298 + 900*exp(-((y-0.011)/0.001)^2)"}}
time: {mode: steady, steady: {steps: 40, residual: 1e-4}}
)deck",
                        overrides);
}

// Field and history tell what the state that was found radiates, not the last step in time.
void expectRadiationOfItsState(const std::filesystem::path& run) {
  const Hdf5Reader results(run / "results.h5");
  const Mechanism mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/hydrogen_h2o2_10.yaml"));
  const ThinRadiation radiation(mechanism, 320.0);
  const std::vector<double> T = test::lastOf(results, "temperature"), water = test::lastOf(results, "X_H2O"),
                            loss = test::lastOf(results, "radiation_loss");
  std::vector<double> X(mechanism.numSpecies(), 0.0);
  double power = 0.0;  // W/m, on even cells
  for (std::size_t c = 0; c < T.size(); ++c) {
    X[mechanism.speciesIndex("H2O")] = water[c];
    const double expected = radiation.loss(radiation.absorption(T[c], 101325.0, X), T[c]);
    EXPECT_NEAR(loss[c], expected, 1e-9 * std::abs(expected)) << c;
    power += 8e-3 * 12e-3 / 64.0 * expected;
  }
  EXPECT_NEAR(results.numbers("/history/radiated_power").back(), power, 1e-9 * power);
}

TEST(SteadyMode, LightsAFlameThatTheStartHasNotLit) {
  const test::SharedScratchFolder scratch;
  const auto hottest = [&](const char* run) {
    return std::ranges::max(test::lastOf(Hdf5Reader(scratch.path() / run / "results.h5"), "temperature"));
  };
  EXPECT_THAT(test::runFlow(
                  hydrogenBesideAir({"radiation={model: optically_thin, surroundings: 320 K}", "output.species=[all]"}),
                  scratch.path() / "lit")
                  .resultsJson,
              AllOf(HasSubstr("\"times_lit\": 1"), ContainsRegex("\"flame_cells\": [1-9]")));
  EXPECT_GT(hottest("lit"), 1200.0);
  expectRadiationOfItsState(scratch.path() / "lit");
  EXPECT_THAT(test::runFlow(hydrogenBesideAir({"time.steady.light=false"}), scratch.path() / "dark").resultsJson,
              AllOf(HasSubstr("\"times_lit\": 0"), HasSubstr("\"flame_cells\": null")));
  EXPECT_LT(hottest("dark"), 310.0);
  // A start without anything hot asks for no flame.
  EXPECT_THAT(
      test::runFlow(hydrogenBesideAir({"initial.formula={temperature: '298'}"}), scratch.path() / "cold").resultsJson,
      HasSubstr("\"times_lit\": 0"));
}

// Of the steps in time.
std::vector<std::vector<double>> inTime(const Hdf5Reader& results) {
  std::vector<std::vector<double>> columns;
  const std::vector<double> iteration = results.numbers("/history/iteration");
  for (const char* name : {"time", "dt", "maximum_temperature", "heat_release", "kinetic_energy"}) {
    const std::vector<double> all = results.numbers(std::string("/history/") + name);
    std::vector<double>& column = columns.emplace_back();
    for (std::size_t row = 1; row < all.size(); ++row)
      if (iteration[row] == iteration[row - 1]) column.push_back(all[row]);
  }
  return columns;
}

TEST(SteadyMode, StepsGoOnAfterAnAttemptAsWithoutIt) {
  const test::SharedScratchFolder scratch;
  const std::vector<std::string> settings{steady, "chemistry.share_work=false"};
  const auto with = [&](int attempts) {
    std::vector<std::string> all = settings;
    all.push_back("time.steady.attempts=" + std::to_string(attempts));
    return all;
  };
  const RunRecord plain = runChannel(scratch.path() / "plain", with(0));
  FailsTwice fault(7);  // two of steps, one to begin with, four that are taken
  const RunRecord failed = runChannel(scratch.path() / "failed", with(1), {}, &fault);
  EXPECT_THAT(plain.resultsJson, AllOf(HasSubstr("\"attempts_taken_back\": 0"), HasSubstr("\"found_early\": false")));
  EXPECT_THAT(failed.resultsJson,
              AllOf(HasSubstr("\"attempts_taken_back\": 1"), HasSubstr("\"iterations_taken_back\": 5"),
                    HasSubstr("\"found_early\": false"), HasSubstr("\"returns_to_steps\": 0")));
  const Hdf5Reader a(scratch.path() / "plain/results.h5"), b(scratch.path() / "failed/results.h5");
  EXPECT_EQ(inTime(a).front().size(), 49U);  // the first has none before it
  EXPECT_EQ(inTime(a), inTime(b));
  EXPECT_EQ(test::lastOf(a, "temperature"), test::lastOf(b, "temperature"));
  EXPECT_EQ(test::lastOf(a, "velocity"), test::lastOf(b, "velocity"));
  // One that does not fail.
  EXPECT_THAT(runChannel(scratch.path() / "early", with(1)).resultsJson,
              AllOf(HasSubstr("\"found_early\": true"), HasSubstr("\"steps_in_time\": 20,")));
  // Nobody has asked for attempts in a gas that cannot burn.
  EXPECT_THAT(runChannel(scratch.path() / "unasked", settings).resultsJson,
              AllOf(HasSubstr("\"attempts_taken_back\": 0"), HasSubstr("\"found_early\": false"),
                    HasSubstr("\"steps_in_time\": 50,")));
}

// Stopped in an attempt that fails afterwards, and is taken back to what was before it.
TEST(SteadyMode, AnAttemptGoesOnFromACheckpoint) {
  const test::SharedScratchFolder scratch;
  std::vector<std::string> settings{steady,
                                    "chemistry.share_work=false",
                                    "time.retries=0",
                                    "checkpoint.steps=25",
                                    "time.steady.residual=1e-12",
                                    "time.steady.iterations=8",
                                    "time.steady.attempts=2"};
  FailsFrom whole(1.8e-4), on(1.8e-4);
  EXPECT_THROW(runChannel(scratch.path() / "whole", settings, {}, &whole), NumericsError);
  EXPECT_THROW(runChannel(scratch.path() / "on", settings, scratch.path() / "whole/checkpoint/step_000025.h5", &on),
               NumericsError);
  const Hdf5Reader a(scratch.path() / "whole/results.h5.part"), b(scratch.path() / "on/results.h5.part");
  EXPECT_EQ(a.numbers("/history/iteration").back(), 8.0);
  EXPECT_EQ(a.names("/steps"), b.names("/steps"));
  for (const char* field : {"temperature", "velocity", "pressure"})
    EXPECT_EQ(test::lastOf(a, field), test::lastOf(b, field));
  EXPECT_EQ(inTime(a), inTime(b));
}

// Through an outlet, between hot walls: six times as dense as the gas that it meets.
TEST(SteadyMode, ColdGasIsDrawnIntoHot) {
  const test::SharedScratchFolder scratch;
  const RunRecord found =
      runChannel(scratch.path() / "found",
                 {steady, "time.steady.returns=0", "time.steady.attempts=2", "mesh.x=[{to: 6 mm, cells: 6}]",
                  "mesh.y=[{to: 6 mm, cells: 6}]", "initial.temperature=1800 K", "boundaries.cold.temperature=1800 K",
                  "boundaries.adiabatic.temperature=1800 K",
                  "boundaries.in={type: inlet, side: y-min, temperature: 1800 K, composition: 'GAS: 1', formula: "
                  "{velocity: '-0.3'}}"});
  EXPECT_THAT(found.resultsJson, AllOf(HasSubstr("\"steady\": true"), HasSubstr("\"found_early\": true")));
  const Hdf5Reader results(scratch.path() / "found/results.h5");
  EXPECT_LT(std::ranges::min(test::lastOf(results, "temperature")), 500.0);
}

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
