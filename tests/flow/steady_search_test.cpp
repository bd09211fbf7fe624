// The plan of a search for a steady state: when it iterates, when it goes back to steps in time, how it ends.
#include "flow/steady/steady_search.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/state_backup.hpp"
#include "tests/flow/steady_search_steps.hpp"

namespace lampblack::flow {
namespace {

using Phase = SteadySearch::Phase;
using test::high;
using test::pass;
using test::steps;
using testing::AllOf;
using testing::HasSubstr;

TEST(SteadySearch, KnowsAFlowThatIsAtRest) {
  SteadySearch search({.residual = 1e-7}), other({.residual = 1e-7});
  steps(search);
  EXPECT_FALSE(search.isFlowAtRest());
  search.addIteration({1e-3, 2e-7, 1e-9}, 1.0);
  EXPECT_FALSE(search.isFlowAtRest());
  search.addIteration({1e-3, 1e-8, 1e-5}, 1.0);
  pass(search, other);
  EXPECT_TRUE(search.isFlowAtRest() && other.isFlowAtRest() && !search.isSteady());
  // Of enthalpy there is more: Newton's method may go on, combinations may not.
  EXPECT_TRUE(search.mayBeNewtons() && other.mayBeNewtons() && !search.mayAccelerate());
  search.addIteration({1e-3, 1e-8, 1e-8}, 1.0);
  EXPECT_FALSE(search.mayBeNewtons());
  search.addIteration({1e-3, 2e-7, 1e-8}, 1.0);
  EXPECT_TRUE(search.mayBeNewtons() && search.mayAccelerate());
}

// Where a flow at rest is left with something that iterations by themselves do not take away, as where eddies mix, they
// are combined again for a while.
TEST(SteadySearch, CombinesIterationsAgainWhereTheyAloneLeadNowhere) {
  SteadySearch search({.residual = 1e-6}), other({.residual = 1e-6});
  steps(search);
  EXPECT_TRUE(search.mayAccelerate());
  search.addIteration({1e-3, 2e-6, 1e-5}, 1.0);
  EXPECT_TRUE(search.mayAccelerate());
  double residual = 1e-4;
  for (int i = 0; i < 20; ++i) {  // fall by themselves
    search.addIteration({residual *= 0.85, 9e-7, 1e-6}, 1.0);
    EXPECT_FALSE(search.mayAccelerate());
  }
  for (int i = 0; i < 9; ++i) search.addIteration({residual *= 0.995, 9e-7, 1e-6}, 1.0);
  EXPECT_FALSE(search.mayAccelerate());
  pass(search, other);
  for (SteadySearch* of : {&search, &other}) {
    int combined = 0, alone = 0;
    of->addIteration({residual, 9e-7, 1e-6}, 1.0);
    for (; of->mayAccelerate() && combined < 1000; ++combined) of->addIteration({residual, 9e-7, 1e-6}, 1.0);
    EXPECT_EQ(combined, 50);
    for (; !of->mayAccelerate() && alone < 1000; ++alone) of->addIteration({residual, 9e-7, 1e-6}, 1.0);
    EXPECT_EQ(alone, 11);
  }
}

// As many iterations and returns as at the start; what was found before is not found any more.
TEST(SteadySearch, GoesOnWhereWhatActsHasChanged) {
  SteadySearch search({.residual = 1e-7, .iterations = 10});
  steps(search);
  for (int i = 0; i < 8; ++i) search.addIteration(high / (i + 1), 1.0);
  search.addIteration(1e-8, 1.0);
  ASSERT_TRUE(search.isSteady());
  search.resume(high, 2.0);
  EXPECT_FALSE(search.isSteady());
  EXPECT_EQ(search.phase(), Phase::Iterations);
  SteadySearch other({.residual = 1e-7, .iterations = 10});
  pass(search, other);
  for (SteadySearch* of : {&search, &other}) {
    for (int i = 0; i < 9; ++i) of->addIteration(high / (i + 1), 2.0);
    EXPECT_FALSE(of->isGivenUp());
    of->addIteration(high / 10, 2.0);
    EXPECT_TRUE(of->isGivenUp());
  }
  SteadySearch near({.residual = 1e-7});
  steps(near);
  near.addIteration(1e-8, 1.0);
  near.resume(1e-8, 1.0);
  EXPECT_TRUE(near.isSteady());
}

TEST(SteadySearch, OfAnotherVersionsCheckpointIsRefused) {
  StateBackup kept(0, 0);
  kept.save([](StateArchive& archive) {
    std::vector<double> numbers(22, 1.0), heat(3, 1.0);
    archive.shared("steady_search", numbers);
    archive.shared("steady_search_heat", heat);
  });
  SteadySearch search({});
  EXPECT_THROW(kept.restore([&](StateArchive& archive) { search.saveOrLoad(archive); }), InputError);
}

TEST(SteadySearch, IteratesOnceTheHeatReleaseIsQuiet) {
  SteadySearch still({});
  EXPECT_EQ(steps(still), 50);
  EXPECT_EQ(still.steps(), 50);
  EXPECT_EQ(still.firstResidual(), high);

  // A flame that grows by 1 % a step is not established, and is taken as it is in the end.
  SteadySearch growing({});
  int count = 0;
  for (double heat = 1.0; growing.phase() == Phase::Steps; heat *= 1.01, ++count) {
    growing.addStep(heat, false);
    if (growing.wantsResidual()) growing.addResidualOfStep(high);
  }
  EXPECT_EQ(count, 300);

  // As many as were asked for, and twice as many with each return.
  SteadySearch asked({.steps = 20});
  EXPECT_EQ(steps(asked), 20);
  asked.endIterations("");
  EXPECT_EQ(steps(asked), 40);

  SteadySearch askedFew({.steps = 3});
  EXPECT_EQ(steps(askedFew), 3);
  askedFew.endIterations("");
  EXPECT_EQ(steps(askedFew), 6);

  // Without reactions there is no flame to wait for, where the residual is low; what fails then is like any other flow.
  SteadySearch inert({.reacts = false});
  EXPECT_EQ(steps(inert, 0.0), 10);
  inert.endIterations("");
  EXPECT_EQ(steps(inert, 0.0), 100);
  SteadySearch asked20({.steps = 20, .reacts = false});
  EXPECT_EQ(steps(asked20, 0.0), 20);
  SteadySearch far({.reacts = false});
  EXPECT_EQ(steps(far, 0.0, 10000, 0.3), 50);

  // What was more than 20 steps ago does not count.
  SteadySearch lit({});
  steps(lit, 10.0, 30);
  EXPECT_EQ(30 + steps(lit), 50);

  // A step that was tried again is none of a quiet flow.
  SteadySearch disturbed({});
  steps(disturbed, 1.0, 45);
  disturbed.addStep(1.0, true);
  EXPECT_EQ(45 + 1 + steps(disturbed), 70);
}

TEST(SteadySearch, TakesAsManyStepsAnewOnceLit) {
  SteadySearch search({});
  steps(search, 10.0);
  search.addLighting();
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_EQ(steps(search), 50) << "heat from before does not count";
  EXPECT_EQ(search.lightings(), 1);
  EXPECT_EQ(search.returns(), 0);

  // What is steady and dark is not steady once lit.
  SteadySearch dark({});
  dark.addStep(0.0, false);
  dark.addResidualOfStep(1e-9);
  EXPECT_TRUE(dark.isSteady());
  dark.addLighting();
  EXPECT_FALSE(dark.isSteady());
}

TEST(SteadySearch, EndsWhereTheResidualIsLowEnough) {
  SteadySearch byIterations({.residual = 1e-6});
  steps(byIterations);
  byIterations.addIteration(1.1e-6, 1.0);
  EXPECT_FALSE(byIterations.isSteady());
  EXPECT_NEAR(byIterations.progress(), 0.99, 0.01);
  byIterations.addIteration(1e-6, 1.0);
  EXPECT_TRUE(byIterations.isSteady());
  EXPECT_EQ(byIterations.progress(), 1.0);
  EXPECT_EQ(byIterations.iterations(), 2);

  SteadySearch bySteps({.residual = 1e-6});
  for (int step = 0; step < 10; ++step) bySteps.addStep(1.0, false);
  bySteps.addResidualOfStep(0.9e-6);
  EXPECT_TRUE(bySteps.isSteady());
  EXPECT_EQ(bySteps.phase(), Phase::Steps);
}

TEST(SteadySearch, GoesBackToTwiceAsManyStepsEachTimeAndIsGivenUp) {
  SteadySearch search({.returns = 2});
  EXPECT_EQ(steps(search), 50);
  search.endIterations("no pressure");
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_EQ(search.whyNot(), "no pressure");
  EXPECT_TRUE(search.takesBack());
  EXPECT_EQ(steps(search), 100);
  EXPECT_FALSE(search.takesBack());
  search.addIteration(0.5 * high, 1.0);
  search.endIterations("no pressure again");
  EXPECT_TRUE(search.takesBack());
  EXPECT_FALSE(search.isGivenUp());
  EXPECT_EQ(steps(search), 200);
  search.endIterations("no pressure at last");
  EXPECT_TRUE(search.isGivenUp());
  EXPECT_EQ(search.returns(), 2);
  EXPECT_EQ(search.iterations(), 4);
}

TEST(SteadySearch, GoesBackAfterFailuresOneBehindTheOther) {
  SteadySearch search({});
  steps(search);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 7; ++i) search.addFailure("too much");
    EXPECT_EQ(search.phase(), Phase::Iterations);
    if (round == 0) search.addIteration(0.5 * high, 1.0);
  }
  search.addFailure("too much again");
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_EQ(search.whyNot(), "too much again");
  EXPECT_FALSE(search.takesBack());  // what the iteration has gained is kept
  EXPECT_EQ(search.iterations(), 16);
}

TEST(SteadySearch, GoesBackWhereTheResidualStandsStill) {
  SteadySearch search({});
  steps(search);
  for (int i = 0; i < 99; ++i) search.addIteration(0.95 * high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Iterations);
  search.addIteration(0.89 * high, 1.0);  // just in time
  for (int i = 0; i < 99; ++i) search.addIteration(0.88 * high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Iterations);
  search.addIteration(0.88 * high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_FALSE(search.takesBack());
  EXPECT_THAT(search.whyNot(), AllOf(HasSubstr("in 100 iterations"), HasSubstr("below 8.90e-02")));
}

// The largest residual, of a trace, stands still all the while.
TEST(SteadySearch, StaysWithAFlameThatGrowsOrWhoseMomentumOrHeatComesToRest) {
  const auto run = [](double momentum, double enthalpy, double heat, int iterations) {
    SteadySearch search({});
    steps(search);
    for (int i = 1; i <= iterations && search.phase() == Phase::Iterations; ++i)
      search.addIteration({high, high * std::pow(momentum, i), high * std::pow(enthalpy, i)}, std::pow(heat, i), true);
    return search.phase() == Phase::Iterations;
  };
  EXPECT_FALSE(run(1.0, 1.0, 1.0, 120));
  EXPECT_TRUE(run(0.99, 1.0, 1.0, 240));
  EXPECT_TRUE(run(1.0, 0.99, 1.0, 240));
  EXPECT_TRUE(run(1.0, 1.0, 1.001, 240));
  EXPECT_FALSE(run(1.0, 1.0, 0.9999, 240));
  EXPECT_FALSE(run(1.0, 1.0, 1.0004, 240));  // by less than a twentieth in a hundred
}

TEST(SteadySearch, IterationsThatRunAwayAreTakenBack) {
  SteadySearch search({});
  steps(search);
  search.addIteration(0.9e4 * high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Iterations);
  search.addIteration(1.1e4 * high, 1.0);
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_TRUE(search.takesBack());
  EXPECT_THAT(search.whyNot(), HasSubstr("has grown"));
}

TEST(SteadySearch, AFlameAtRestIsKeptWhateverItsLastDigitsDo) {
  SteadySearch search({.residual = 1e-7, .steps = 10});
  for (int step = 0; step < 10; ++step) search.addStep(1.0, false);
  search.addResidualOfStep({high, 1e-9, 1e-9});
  search.addIteration({1e-3 * high, 9e-8, 9e-8}, 1.0);
  for (int i = 0; i < 8; ++i) search.addFailure("too much");
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_FALSE(search.takesBack());
}

// A trace's residual is a thousandth of what it was; the gas burns as no flame does, or flows as none does.
TEST(SteadySearch, WhatAFlameHasLostIsTakenBackWhateverATraceHasGained) {
  for (const bool isHeat : {false, true})
    for (const double flame : {0.9e-3, 1e-3, 0.5}) {
      SCOPED_TRACE(fmt::format("{} {}", isHeat, flame));
      SteadySearch search({.steps = 10}), loaded({.steps = 10});
      for (int step = 0; step < 10; ++step) search.addStep(1.0, false);
      const auto residual = [&](double all, double lost, double fallen) {
        return isHeat ? SteadySearch::Residual{all, fallen, lost} : SteadySearch::Residual{all, lost, fallen};
      };
      search.addResidualOfStep(residual(high, 1e-3, high));
      search.addIteration(residual(1e-3 * high, flame, 1e-3 * high), 1.0);
      pass(search, loaded);
      for (SteadySearch* each : {&search, &loaded}) {
        for (int i = 0; i < 8; ++i) each->addFailure("too much");
        EXPECT_EQ(each->phase(), Phase::Steps);
        EXPECT_EQ(each->takesBack(), flame >= 1e-3);
        const std::string told = isHeat ? "that of enthalpy went from 1.00e-03" : "that of momentum went from 1.00e-03";
        EXPECT_EQ(each->whyNot().find(told) != std::string::npos, flame > 1e-3);
      }
    }
}

TEST(SteadySearch, AFlameThatGoesOutIsNoSteadyState) {
  SteadySearch search({.residual = 1e-3});
  steps(search, 20.0);
  for (int i = 0; i < 19; ++i) search.addIteration(1e-2, i < 9 ? 1.9 : -60.0);
  search.addIteration(1e-2, 2.1);  // burns again
  for (int i = 0; i < 19; ++i) search.addIteration(1e-4, 1.9);
  EXPECT_FALSE(search.isSteady());
  EXPECT_EQ(search.phase(), Phase::Iterations);
  search.addIteration(1e-4, 1.9);
  EXPECT_FALSE(search.isSteady());
  EXPECT_EQ(search.phase(), Phase::Steps);
  EXPECT_TRUE(search.takesBack());
  EXPECT_THAT(search.whyNot(), HasSubstr("gone out: 1.9 W of 20 W"));

  // What failures leave is not kept where it does not burn.
  for (const double heat : {1.9, 2.1}) {
    SteadySearch failing({});
    steps(failing, 20.0);
    failing.addIteration(0.5 * high, heat);
    for (int i = 0; i < 8; ++i) failing.addFailure("too much");
    EXPECT_EQ(failing.takesBack(), heat < 2.0);
  }
}

TEST(SteadySearch, IsGivenUpAfterItsIterations) {
  SteadySearch search({.iterations = 3});
  steps(search);
  for (int i = 0; i < 2; ++i) search.addIteration(high / (2 + i), 1.0);
  EXPECT_FALSE(search.isGivenUp());
  search.addIteration(high / 4, 1.0);
  EXPECT_TRUE(search.isGivenUp());
  EXPECT_EQ(search.phase(), Phase::Iterations);  // from where another run may go on
}

TEST(SteadySearch, WhatWasFoundIsFoundButForATighterLimit) {
  SteadySearch found({.residual = 1e-6}), again({.residual = 1e-6}), tighter({.residual = 1e-8});
  steps(found);
  found.addIteration(1e-7, 1.0);
  ASSERT_TRUE(found.isSteady());
  pass(found, again);
  pass(found, tighter);
  EXPECT_TRUE(again.isSteady());
  EXPECT_FALSE(tighter.isSteady());
  EXPECT_EQ(tighter.phase(), Phase::Iterations);

  SteadySearch dark({.residual = 1e-6}), darkAgain({.residual = 1e-6});
  steps(dark, 20.0);
  for (int i = 0; i < 19; ++i) dark.addIteration(1e-7, 1.0);
  pass(dark, darkAgain);
  EXPECT_FALSE(darkAgain.isSteady());
  darkAgain.addIteration(1e-7, 1.0);
  EXPECT_THAT(darkAgain.whyNot(), HasSubstr("gone out"));
}

// At any point of the way.
TEST(SteadySearch, GoesOnFromWhatWasSavedAsIfNothingHadBeen) {
  for (const int until : {3, 25, 47, 62, 74, 150, 190, 280}) {
    SCOPED_TRACE(until);
    const auto advance = [](SteadySearch& search, int from, int to) {
      for (int i = from; i < to; ++i)
        if (search.phase() == Phase::Iterations && i >= 70 && i < 78) {
          search.addFailure("too much");
        } else if (search.phase() == Phase::Iterations) {
          search.addIteration(0.97 * high, 1.0);
        } else {
          search.addStep(i == 35 ? 2.0 : 1.0, i == 10);
          if (search.wantsResidual()) search.addResidualOfStep(high);
        }
    };
    const SteadySearch::Options options{.attempts = 2};
    SteadySearch whole(options), first(options), second(options);
    advance(whole, 0, 700);
    advance(first, 0, until);
    pass(first, second);
    advance(second, until, 700);
    EXPECT_EQ(second.phase(), whole.phase());
    EXPECT_EQ(second.steps(), whole.steps());
    EXPECT_EQ(second.iterations(), whole.iterations());
    EXPECT_EQ(second.returns(), whole.returns());
    EXPECT_EQ(second.progress(), whole.progress());
    EXPECT_EQ(second.attempts(), whole.attempts());
    EXPECT_EQ(second.iterationsTakenBack(), whole.iterationsTakenBack());
    EXPECT_GT(whole.returns(), 1);
    EXPECT_GT(whole.attempts(), 0);
  }
}

}  // namespace
}  // namespace lampblack::flow
