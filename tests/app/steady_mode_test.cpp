// A deck with `time: {mode: steady}`: what is found, what is written, how it ends where nothing is found, and that a
// run goes on from a checkpoint as if it had not stopped.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/models/radiation.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/app/steady_mode_decks.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

using steadymode::channel;
using steadymode::hydrogenBesideAir;
using steadymode::steady;

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

const std::string boundaries = "output.boundaries=[all]";

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

}  // namespace
}  // namespace lampblack::app
