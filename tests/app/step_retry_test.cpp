// A step that fails is taken back and tried again with a quarter of its length; where that does not help either, the
// run ends with its last good state on disk.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "app/problems/flow/flow_loop.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/field_registry.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/hdf5_reader.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using test::at;
using testing::AllOf;
using testing::HasSubstr;

// What is done to the step that begins at a state, and what the states were.
class Watcher : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "watcher"; }
  void advance(State& state, double time, double dt) override {
    if (++sweep_ < sweeps) return disturb(state, time, dt, false);
    sweep_ = 0;
    disturb(state, time, dt, true);
    last_ = {time, dt};
  }
  void endStep(State& state) override {
    if (last_) steps.push_back({last_->first, last_->second, state});
    last_.reset();
  }
  // A step that turns out to be bad at its end is taken back as well.
  void saveOrLoad(StateArchive& archive) override {
    if (archive.loading()) {
      sweep_ = 0;
      last_.reset();
      steps.erase(steps.begin() + kept_, steps.end());
    } else {
      kept_ = static_cast<std::ptrdiff_t>(steps.size());
    }
  }

  struct Step {
    double time, dt;
    State after;
  };
  std::vector<Step> steps;
  int sweeps = 1;

 protected:
  virtual void disturb(State&, double, double, bool) {}

 private:
  int sweep_ = 0;
  std::ptrdiff_t kept_ = 0;
  std::optional<std::pair<double, double>> last_;
};

// The step in which anything happens: some way into the run, when what operators keep has grown old.
constexpr std::size_t disturbedStep = 12;

// Lets the first attempts of a step fail, in a way that the test chooses.
class Fault : public Watcher {
 public:
  using Harm = std::function<void(State&)>;
  Fault(Harm harm, bool inLastSweep, int attempts = 1)
      : harm_(std::move(harm)), inLastSweep_(inLastSweep), left_(attempts) {}

 protected:
  void disturb(State& state, double, double, bool isLastSweep) override {
    if (steps.size() != disturbedStep || isLastSweep != inLastSweep_ || left_ == 0) return;
    --left_;
    harm_(state);
  }

 private:
  Harm harm_;
  bool inLastSweep_;
  int left_;
};

// Takes the smaller step from the start.
class Shortener : public Watcher {
 public:
  explicit Shortener(double shorter) : shorter_(shorter) {}
  [[nodiscard]] double largestStep(const State&) override {
    return steps.size() == disturbedStep ? shorter_ : std::numeric_limits<double>::infinity();
  }

 private:
  double shorter_;
};

// Fast enough for soot to burn, and for steps that the Courant number limits. On 15 cells: a step is taken back as a
// whole.
std::vector<std::string> settings(int sweeps, const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"time.end=60 us",
                               "time.maximum_step=4 us",
                               "output.interval=25 us",
                               "boundaries.fuel.swirl_velocity=10 cm/s",
                               "chemistry.share_work=false",
                               "time.sweeps=" + std::to_string(sweeps),
                               "mesh.refinement=0.5"};
  if (sweeps > 1) all.emplace_back("time.tolerance=0.01");
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

FlowCase caseOf(const std::vector<std::string>& overrides) {
  FlowCase flowCase = readFlowCase(test::flameDeck(overrides));
  flowCase.trajectories.reset();
  return flowCase;
}

struct Ran {
  std::int64_t retried = 0;
  std::vector<double> countInHistory, massInflow, solverSteps, dt;
};

Ran run(Watcher& watcher, const std::filesystem::path& path, const std::vector<std::string>& overrides,
        const std::optional<std::filesystem::path>& restart = {}) {
  FlowCase flowCase = caseOf(overrides);
  watcher.sweeps = flowCase.flow.sweeps;
  FlowLoop loop(MPI_COMM_WORLD, std::move(flowCase));
  loop.addOperator(watcher);
  if (restart) loop.load(newestCheckpoint(MPI_COMM_WORLD, *restart));
  const RunFolder folder = RunFolder::prepare(path, false, MPI_COMM_WORLD);
  loop.run(folder, {"test", "none", {}, "now"});
  RunRecord record;
  loop.count(record);
  const Hdf5Reader results(folder.results());
  return {record.retriedSteps.value(), results.numbers("/history/retried_steps"),
          results.numbers("/history/mass_inflow"), results.numbers("/history/stiff_solver_steps"),
          results.numbers("/history/dt")};
}

void expectSameBits(const std::vector<double>& found, const std::vector<double>& expected, const char* what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]) << what << ' ' << i;
}

void expectSameSteps(const Watcher& found, const Watcher& expected) {
  ASSERT_EQ(found.steps.size(), expected.steps.size());
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(found.steps[i].time, expected.steps[i].time);
    ASSERT_EQ(found.steps[i].dt, expected.steps[i].dt);
    const State &a = found.steps[i].after, &b = expected.steps[i].after;
    for (const FieldDeclaration& field : fieldRegistry()) expectSameBits(field.of(a), field.of(b), field.name);
  }
}

void fail(State&) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  collectively(MPI_COMM_WORLD, [&] {
    if (rank == 0) throw NumericsError("made to fail");
  });
}

void spoil(std::vector<double>& values, double with) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == ranks - 1) values[5] = with;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Kind {
  const char* name;
  int sweeps;
  bool inLastSweep;
  Fault::Harm harm;
};

// Runs of so many sweeps in which nothing fails: one as it is, and one in which the step is a quarter as long from the
// start.
struct Undisturbed {
  Watcher alone;
  std::optional<Shortener> shortener;
  Ran asItIs, shorter;
};

const Undisturbed& undisturbed(int sweeps) {
  static std::map<int, Undisturbed> runs;
  const auto [found, isNew] = runs.try_emplace(sweeps);
  Undisturbed& both = found->second;
  if (!isNew) return both;
  const test::SharedScratchFolder scratch;
  both.asItIs = run(both.alone, scratch.path() / "alone", settings(sweeps));
  both.shortener.emplace(0.25 * both.alone.steps.at(disturbedStep).dt);
  both.shorter = run(*both.shortener, scratch.path() / "shorter", settings(sweeps));
  return both;
}

class RetriedStep : public testing::TestWithParam<Kind> {};

TEST_P(RetriedStep, GoesOnAsIfItHadBeenTheSmallerOneFromTheStart) {
  const test::SharedScratchFolder scratch;
  const auto& [alone, shortener, asItIs, shorter] = undisturbed(GetParam().sweeps);
  ASSERT_GT(alone.steps.size(), disturbedStep + 3);
  EXPECT_EQ(asItIs.retried, 0);
  Fault fault(GetParam().harm, GetParam().inLastSweep);
  const Ran retried = run(fault, scratch.path() / "retried", settings(GetParam().sweeps));
  EXPECT_EQ(fault.steps.at(disturbedStep).dt, 0.25 * alone.steps.at(disturbedStep).dt);
  expectSameSteps(fault, *shortener);
  expectSameBits(retried.massInflow, shorter.massInflow, "what came in");
  expectSameBits(retried.solverSteps, shorter.solverSteps, "what operators count");
  ASSERT_EQ(retried.dt.size(), fault.steps.size());
  for (std::size_t i = 0; i < retried.dt.size(); ++i) EXPECT_EQ(retried.dt[i], fault.steps[i].dt) << i;
  EXPECT_EQ(retried.retried, 1);
  EXPECT_EQ(retried.countInHistory.at(disturbedStep - 1), 0.0);
  EXPECT_EQ(retried.countInHistory.at(disturbedStep), 1.0);
  EXPECT_EQ(retried.countInHistory.back(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, RetriedStep,
    testing::Values(Kind{"Error", 1, true, fail}, Kind{"ErrorInTheFirstSweep", 2, false, fail},
                    Kind{"ErrorInTheLastSweep", 2, true, fail},
                    Kind{"Temperature", 1, true, [](State& state) { spoil(state.temperature, nan); }},
                    Kind{"VelocityBeforeThePressure", 2, false, [](State& state) { spoil(state.velocity, nan); }},
                    Kind{"TemperatureOutOfRange", 2, false, [](State& state) { spoil(state.temperature, 1e9); }},
                    Kind{"MassFlux", 1, true,
                         [](State& state) { spoil(state.massFlux, std::numeric_limits<double>::infinity()); }}),
    [](const auto& kind) { return kind.param.name; });

TEST(RetriedStep, SaysFieldAndPlaceOfWhatIsNoNumber) {
  const test::SharedScratchFolder scratch;
  std::optional<std::array<double, 2>> place;
  const auto finer = settings(1, {"time.retries=0", "mesh.refinement=1"});
  const Mesh mesh(MPI_COMM_WORLD, caseOf(finer).mesh);
  // Two cells, the one with the smaller number on any rank is told.
  Fault fault(
      [&](State& state) {
        for (const std::int64_t natural : {17, 41})
          if (const int cell = mesh.findOwned(natural); cell >= 0)
            state.Y[static_cast<std::size_t>(cell) * static_cast<std::size_t>(state.species) + 2] = nan;
      },
      true);
  const std::string message = test::messageOf<NumericsError>([&] { run(fault, scratch.path() / "out", finer); });
  EXPECT_THAT(message, AllOf(HasSubstr("the mass fraction of "), HasSubstr(" is nan at (0.013, 0.002) m"),
                             HasSubstr("this was step 13 from t = "), HasSubstr("--restart goes on from ")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
}

TEST(RetriedStep, StopsBeforeThePressureMeetsWhatIsNoNumber) {
  const test::SharedScratchFolder scratch;
  Fault fault([](State& state) { spoil(state.velocity, nan); }, false);
  EXPECT_THAT(
      test::messageOf<NumericsError>([&] { run(fault, scratch.path() / "out", settings(2, {"time.retries=0"})); }),
      AllOf(HasSubstr("in the cell at ("), HasSubstr("the velocities have grown beyond all numbers")));
}

TEST(RetriedStep, EndsTheRunWhereNothingHelpsWithSomethingToGoOnFrom) {
  const test::SharedScratchFolder scratch;
  const auto out = scratch.path() / "out";
  const Mesh mesh(MPI_COMM_WORLD, caseOf(settings(1)).mesh);
  Fault fault(fail, true, 3);
  const std::string message = test::messageOf<NumericsError>([&] { run(fault, out, settings(1, {"time.retries=2"})); });
  EXPECT_EQ(fault.steps.size(), disturbedStep);
  EXPECT_THAT(message, AllOf(HasSubstr("made to fail; this was step 13 from t = "), HasSubstr("tried with dt = "),
                             HasSubstr("the fields until then are in "), HasSubstr("--restart goes on from ")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
  // What is kept is the state before the step.
  const Hdf5Reader kept(out / "results.h5.part");
  EXPECT_EQ(kept.numbers("/history/step").back(), static_cast<double>(disturbedStep));
  EXPECT_EQ(kept.numbers("/history/retried_steps").size(), disturbedStep);
  const std::string last = kept.names("/steps").back();
  const std::vector<double> written = kept.numbers("/steps/" + last + "/temperature");
  double hottest = 0.0;
  for (int c = 0; c < mesh.owned; ++c) hottest = std::max(hottest, fault.steps.back().after.temperature[at(c)]);
  EXPECT_EQ(*std::ranges::max_element(written), test::maxOverRanks(hottest));

  // And from there it goes on as a run in which nothing failed.
  Watcher alone, rest;
  run(alone, scratch.path() / "alone", settings(1));
  run(rest, scratch.path() / "rest", settings(1), out);
  ASSERT_EQ(rest.steps.size() + disturbedStep, alone.steps.size());
  alone.steps.erase(alone.steps.begin(), alone.steps.begin() + disturbedStep);
  expectSameSteps(rest, alone);
}

// A step a tenth as long each time, as what grows from step to step does.
class Shrinker : public Watcher {
 public:
  [[nodiscard]] double largestStep(const State&) override {
    return steps.size() < disturbedStep ? std::numeric_limits<double>::infinity()
                                        : 1e-6 * std::pow(0.1, static_cast<double>(steps.size() - disturbedStep));
  }
};

TEST(RetriedStep, EndsTheRunWhereTimeStandsStill) {
  const test::SharedScratchFolder scratch;
  Shrinker shrinker;
  const std::string message =
      test::messageOf<NumericsError>([&] { run(shrinker, scratch.path() / "out", settings(1)); });
  EXPECT_THAT(message, AllOf(HasSubstr("in the cell at ("), HasSubstr("time stands still"), HasSubstr(" m/s here"),
                             HasSubstr("tried with dt = "), HasSubstr("--restart goes on from ")));
  EXPECT_TRUE(test::sameOnAllRanks(message));
  EXPECT_LT(shrinker.steps.size(), disturbedStep + 12);
}

// By the case's own step control, with a limit that the first of these steps is beyond.
TEST(RetriedStep, AStepThatChangesMoreThanTheDeckAllowsIsShorter) {
  const test::SharedScratchFolder scratch;
  Watcher watcher;
  const auto out = scratch.path() / "out";
  const Ran ran =
      run(watcher, out, settings(1, {"time.end=0.4 us", "time.temperature_change=15 K", "mesh.refinement=1"}));
  EXPECT_GT(ran.retried, 0);
  EXPECT_EQ(watcher.steps.front().dt, 0.1e-6);
  const double change = Hdf5Reader(out / "results.h5").numbers("/history/temperature_change").front();
  EXPECT_GT(change, 5.0);
  EXPECT_LT(change, 15.0);
}

TEST(RetriedStep, HasAsManyAttemptsAsTheDeckAllowsEachTime) {
  const test::SharedScratchFolder scratch;
  Fault fault(fail, true, 2);
  const Ran ran = run(fault, scratch.path() / "out", settings(1, {"time.retries=2"}));
  EXPECT_EQ(ran.retried, 2);
}

}  // namespace
}  // namespace lampblack::app
