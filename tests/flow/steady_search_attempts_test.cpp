// Attempts of a search for a steady state: iterations before the flow is established.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/state_backup.hpp"
#include "flow/steady/steady_search.hpp"
#include "tests/flow/steady_search_steps.hpp"

namespace lampblack::flow {
namespace {

using Phase = SteadySearch::Phase;
using test::high;
using test::pass;
using test::steps;
using testing::AllOf;
using testing::HasSubstr;

TEST(SteadySearch, AnAttemptHasItsIterationsWhateverTheResidualDoes) {
  SteadySearch search({.attempts = 1});
  EXPECT_EQ(steps(search), 20);
  for (int i = 1; i < 300; ++i) search.addIteration(i < 10 ? high : 100 * high, 1.0);
  EXPECT_TRUE(search.isAttempt());
  EXPECT_EQ(search.phase(), Phase::Iterations);
  search.addIteration(high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_TRUE(search.takesBack());
}

TEST(SteadySearch, AttemptsNothingWhereNothingBurns) {
  SteadySearch search({.attempts = 2});
  for (int step = 1; step <= 49; ++step) {
    search.addStep(1.0, false);
    if (search.wantsResidual()) search.addResidualOfStep(high, false);
    EXPECT_EQ(search.phase(), Phase::Steps) << step;
  }
  search.addStep(1.0, false);
  search.addResidualOfStep(high, false);
  EXPECT_EQ(search.phase(), Phase::Iterations);
  EXPECT_FALSE(search.isAttempt());
}

// Steps of a flame that grows until it is quiet, so that it is established after 50.
TEST(SteadySearch, AnAttemptThatFailsIsAsIfItHadNotBeen) {
  SteadySearch search({.iterations = 30, .attempts = 2});
  EXPECT_EQ(steps(search), 20);
  EXPECT_TRUE(search.isAttempt());
  for (int i = 0; i < 7; ++i) search.addFailure("too much");
  search.addIteration(0.5 * high, 1.0);
  for (int i = 0; i < 8; ++i) search.addFailure("too much");
  EXPECT_FALSE(search.isAttempt());
  EXPECT_TRUE(search.takesBack());
  EXPECT_EQ(search.returns(), 0);
  EXPECT_EQ(search.attempts(), 1);
  EXPECT_EQ(search.iterationsTakenBack(), 16);
  EXPECT_EQ(search.whyNot(), "");
  EXPECT_EQ(search.progress(), 0.0);
  // The heat of the steps before counts: the flow is quiet at 50 steps, before the next attempt would be due.
  EXPECT_EQ(20 + steps(search), 50);
  EXPECT_FALSE(search.isAttempt());
  // All iterations are left to it.
  for (int i = 0; i < 29; ++i) search.addIteration(0.5 * high, 1.0);
  EXPECT_FALSE(search.isGivenUp());
  search.addIteration(0.5 * high, 1.0);
  EXPECT_TRUE(search.isGivenUp());
  EXPECT_EQ(search.iterations(), 46);
}

TEST(SteadySearch, AttemptsComeAfterTwiceAsManySteps) {
  SteadySearch search({.attempts = 3});
  double heat = 1.0;
  int count = 0;
  std::vector<int> begun;
  while (begun.size() < 5) {
    search.addStep(heat *= 1.01, false);
    ++count;
    if (search.wantsResidual()) search.addResidualOfStep(high);
    if (search.phase() != Phase::Iterations) continue;
    begun.push_back(count);
    search.endIterations("no pressure");
  }
  EXPECT_EQ(begun, (std::vector<int>{20, 60, 140, 300, 900}));
  EXPECT_EQ(search.attempts(), 3);
  EXPECT_EQ(search.iterationsTakenBack(), 3);
  EXPECT_EQ(search.returns(), 2);
  // Nor behind a return, though one would be due after ten more steps.
  SteadySearch returned({.attempts = 2});
  for (const int expected : {20, 30, 100}) {
    EXPECT_EQ(steps(returned), expected);
    returned.endIterations("no pressure");
  }
  // Where the number of steps is given there are none.
  SteadySearch asked({.steps = 30, .attempts = 2});
  EXPECT_EQ(steps(asked), 30);
  EXPECT_FALSE(asked.isAttempt());
}

TEST(SteadySearch, AnAttemptIsTakenWhereItBurns) {
  for (const bool burns : {true, false}) {
    SteadySearch search({.residual = 1e-6, .attempts = 1});
    steps(search);
    search.addIteration(1e-7, 1.0, burns);
    EXPECT_EQ(search.isSteady(), burns);
    EXPECT_EQ(search.isAttempt(), burns);
    EXPECT_EQ(search.takesBack(), !burns);
  }
  // What an established flow comes to is what it is.
  SteadySearch cold({.residual = 1e-6});
  steps(cold);
  cold.addIteration(1e-7, 1.0, false);
  EXPECT_TRUE(cold.isSteady());
}

TEST(SteadySearch, AnAttemptGoesOnBeyondItsIterationsWhileItGains) {
  SteadySearch search({.attempts = 1});
  steps(search);
  double residual = high;
  for (int i = 0; i < 300; ++i) search.addIteration(residual *= 0.99, 1.0);
  EXPECT_TRUE(search.isAttempt());
  search.addIteration(residual *= 0.8, 1.0);
  for (int i = 0; i < 29; ++i) search.addIteration(residual, 1.0);
  EXPECT_TRUE(search.isAttempt());
  search.addIteration(residual, 1.0);
  EXPECT_FALSE(search.isAttempt());
  EXPECT_TRUE(search.takesBack());
  EXPECT_EQ(search.phase(), Phase::Steps);

  // No longer than any iterations.
  SteadySearch few({.iterations = 330, .attempts = 1});
  steps(few);
  for (int i = 0; i < 329; ++i) few.addIteration(high * std::pow(0.99, i), 1.0);
  EXPECT_TRUE(few.isAttempt());
  few.addIteration(1e-3 * high, 1.0);
  EXPECT_FALSE(few.isAttempt());
}

}  // namespace
}  // namespace lampblack::flow
