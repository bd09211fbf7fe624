#include "chemistry/reactor/reactor_replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Event = ConstantPressureReactor::Event;

// A mixture that burns, and a reactor that may take too few steps for it.
FailedCell failedCell() {
  FailedCell cell{1300.0 + 1.0 / 3, constants::oneAtmosphere, 1e-3, 0.0, {}, {}, 2e5, 0.7, {1e-6, 1e-12, 3, 0.0, 2},
                  "a \"test\""};
  cell.Y.resize(hydrogen().numSpecies());
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 2, O2: 1, N2: 3.76"), cell.Y);
  cell.source.assign(cell.Y.size(), 0.0);
  cell.source[hydrogen().speciesIndex("O2")] = 1.0 / 3;
  cell.source[hydrogen().speciesIndex("N2")] = -1.0 / 3;
  return cell;
}

ConstantPressureReactor::Cell cellOf(FailedCell& failed) {
  return {failed.temperature, failed.pressure, failed.Y,         failed.source,
          failed.firstStep,   failed.heating,  failed.rateFactor};
}

class ReactorReplay : public ::testing::Test {
 protected:
  std::string write(const std::string& text) const { return folder_.file("cell.yaml", text); }
  std::string errorOf(const std::string& text) const {
    try {
      readReplay(write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  test::ScratchFolder folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST_F(ReactorReplay, KeepsEveryBit) {
  const auto cell = failedCell();
  const auto [mechanism, read] = readReplay(write(replayText(hydrogen(), cell)));
  EXPECT_EQ(mechanism.numReactions(), hydrogen().numReactions());
  EXPECT_EQ(read.temperature, cell.temperature);
  EXPECT_EQ(read.pressure, cell.pressure);
  EXPECT_EQ(read.duration, cell.duration);
  EXPECT_EQ(read.firstStep, cell.firstStep);
  EXPECT_EQ(read.Y, cell.Y);
  EXPECT_EQ(read.source, cell.source);
  EXPECT_EQ(read.heating, cell.heating);
  EXPECT_EQ(read.rateFactor, cell.rateFactor);
  EXPECT_EQ(read.options.relativeTolerance, cell.options.relativeTolerance);
  EXPECT_EQ(read.options.absoluteTolerance, cell.options.absoluteTolerance);
  EXPECT_EQ(read.options.maxSteps, cell.options.maxSteps);
  EXPECT_EQ(read.options.negligibleChange, cell.options.negligibleChange);
  EXPECT_EQ(read.options.rosenbrockSteps, cell.options.rosenbrockSteps);
  EXPECT_EQ(read.reason, cell.reason);
}

TEST_F(ReactorReplay, KeepsWhatIsNoNumber) {
  auto cell = failedCell();
  cell.temperature = NAN;
  cell.Y[2] = -INFINITY;
  const auto read = readReplay(write(replayText(hydrogen(), cell))).cell;
  EXPECT_TRUE(std::isnan(read.temperature));
  EXPECT_EQ(read.Y[2], -INFINITY);
}

// What a failing reactor throws is enough to fail again in the same way.
TEST_F(ReactorReplay, TheSameFailureComesAgain) {
  auto cell = failedCell();
  ConstantPressureReactor reactor(hydrogen(), cell.options);
  const auto failure = [](ConstantPressureReactor& with, FailedCell& state) -> ReactorFailure {
    auto tried = cellOf(state);
    try {
      with.advance(tried, state.duration);
    } catch (const ReactorFailure& error) {
      return error;
    }
    throw std::runtime_error("did not fail");
  };
  const auto first = failure(reactor, cell);
  auto [mechanism, read] = readReplay(write(replayText(hydrogen(), first.cell())));
  EXPECT_THAT(read.reason, HasSubstr("mxstep"));
  ConstantPressureReactor again(mechanism, read.options);
  EXPECT_STREQ(failure(again, read).what(), first.what());
}

// Watching changes no bit of the result, and every step is told.
TEST_F(ReactorReplay, AnObserverSeesTheStepsThatAreTaken) {
  auto plain = failedCell(), watched = plain;
  plain.options.maxSteps = 20000;
  plain.options.rosenbrockSteps = 0;
  ConstantPressureReactor reactor(hydrogen(), plain.options);
  auto a = cellOf(plain), b = cellOf(watched);
  const auto result = reactor.advance(a, plain.duration);
  int steps = 0, attempts = 0, done = 0;
  double last = 0, sum = 0;
  reactor.advance(b, plain.duration, [&](const Event& event) {
    attempts += event.kind == Event::Kind::Attempt ? 1 : 0;
    done += event.kind == Event::Kind::Done ? 1 : 0;
    if (event.kind != Event::Kind::Step) return;
    ++steps;
    EXPECT_GT(event.time, last);
    last = event.time;
    sum += event.stepSize;
  });
  EXPECT_EQ(steps, result.steps);
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(done, 1);
  EXPECT_NEAR(last, plain.duration, 1e-15 * plain.duration);
  EXPECT_NEAR(sum, plain.duration, 1e-12 * plain.duration);
  EXPECT_EQ(a.temperature, b.temperature);
  EXPECT_EQ(a.initialStep, b.initialStep);
  EXPECT_EQ(plain.Y, watched.Y);
}

TEST_F(ReactorReplay, AnObserverSeesEveryAttemptFail) {
  auto cell = failedCell();
  cell.options.rosenbrockSteps = 0;
  ConstantPressureReactor reactor(hydrogen(), cell.options);
  auto tried = cellOf(cell);
  std::vector<std::string> reasons;
  int steps = 0;
  const auto observe = [&](const Event& event) {
    if (event.kind == Event::Kind::Failed) reasons.push_back(event.reason);
    if (event.kind == Event::Kind::Step) ++steps;
  };
  EXPECT_THROW(reactor.advance(tried, cell.duration, observe), ReactorFailure);
  EXPECT_EQ(reasons.size(), 3);
  for (const auto& reason : reasons) EXPECT_THAT(reason, HasSubstr("steps taken before"));
  EXPECT_EQ(steps, 3 + 6 + 6);
}

TEST_F(ReactorReplay, ReadsStrictly) {
  const auto good = replayText(hydrogen(), failedCell());
  EXPECT_EQ(errorOf(good), "no error");
  EXPECT_THAT(errorOf(replaced(good, "duration:", "durations:")),
              AllOf(HasSubstr("cell.yaml:5: "), HasSubstr("unknown key 'durations'"), HasSubstr("'duration'")));
  EXPECT_THAT(errorOf(replaced(good, "pressure: 101325", "# none")), HasSubstr("has no 'pressure'"));
  EXPECT_THAT(errorOf(replaced(good, "pressure: 101325", "pressure: high")),
              AllOf(HasSubstr("cell.yaml:4: "), HasSubstr("pressure: expected a number")));
  EXPECT_THAT(errorOf(replaced(good, "max_steps: 3", "max_steps: 2.5")), HasSubstr("expected a whole number"));
  EXPECT_THAT(errorOf(replaced(good, "\"H2\":", "\"H22\":")), AllOf(HasSubstr("cell.yaml:"), HasSubstr("H22")));
  EXPECT_THAT(errorOf(replaced(good, "\"H2\":", "\"O2\":")), HasSubstr("'O2' is given twice"));
  EXPECT_THAT(errorOf(replaced(good, "  \"H2\": 0", "# \"H2\": 0")), HasSubstr("'H2' is missing"));
  EXPECT_THAT(errorOf(replaced(good, "mechanism: \"", "mechanism: \"/nowhere")), HasSubstr("/nowhere"));
  EXPECT_THAT(errorOf("a: [b"), HasSubstr("cell.yaml:"));
  EXPECT_THROW(readReplay((folder_.path() / "missing.yaml").string()), InputError);
}

}  // namespace
