// The event loop, births and splitting by themselves: what happens how often, and when.
#include "particles/population/engine/event_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "particles/population/engine/even_births.hpp"
#include "particles/population/engine/split_step.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int repeats = 4000;

// A population that counts what happens to it.
struct Tally {
  int births = 0, happened[3] = {}, fictitious[3] = {};
  double time = 0;
};
template <int Which>
struct Toy {
  static constexpr const char* name = Which == 1 ? "the second" : "a toy";
  const Tally& of;
  double before, after, accepted;  // bound until the first birth and from then on, 1/s; share of the attempts
  bool isActive = true;
  [[nodiscard]] double bound() const { return !isActive ? 0 : of.births == 0 ? before : after; }
  [[nodiscard]] bool attempt(RandomStream& random) const { return random.uniform() < accepted; }
};
struct TallyHost {
  Tally& of;
  void look() {}
  void setTime(double time) {
    EXPECT_GE(time, of.time);
    of.time = time;
  }
  void giveBirth() { ++of.births; }
  template <int Which>
  void take(const Toy<Which>&, bool happened) {
    ++(happened ? of.happened : of.fictitious)[Which];
  }
};
struct OneBirth {
  double at;
  [[nodiscard]] double due(double) const { return at; }
  void pass(double) {}
  void happen() { at = infinity; }
};

// Of the processes over 2 s, with a birth at `at`.
Tally tally(int repeat, double at, Toy<0> first, Toy<1> second, double third = 0) {
  RandomStream random(7, static_cast<std::uint64_t>(repeat), 3);
  Tally all;
  OneBirth births{at};
  TallyHost host{all};
  double time = 0;
  runEvents(time, 2.0, random, births, host, Toy<0>{all, first.before, first.after, first.accepted, first.isActive},
            Toy<1>{all, second.before, second.after, second.accepted, second.isActive},
            Toy<2>{all, third, third, 1, third > 0});
  EXPECT_EQ(time, 2.0);
  return all;
}

TEST(EventLoop, EachProcessHappensAtItsOwnRate) {
  const Tally none;
  std::vector<double> first, fictitious, second, third;
  for (int r = 0; r < repeats; ++r) {
    const Tally all = tally(r, infinity, {none, 3, 0, 0.5}, {none, 1, 0, 1}, 0.25);
    EXPECT_EQ(all.births + all.fictitious[1], 0);
    first.push_back(all.happened[0]);
    fictitious.push_back(all.fictitious[0]);
    second.push_back(all.happened[1]);
    third.push_back(all.happened[2]);
  }
  EXPECT_LT(std::abs(summarise(first).z(3)), zLimit);
  EXPECT_LT(std::abs(summarise(fictitious).z(3)), zLimit);
  EXPECT_LT(std::abs(summarise(second).z(2)), zLimit);
  EXPECT_LT(std::abs(summarise(third).z(0.5)), zLimit);
}

TEST(EventLoop, WaitingTimesGoOnAtTheRatesAfterABirth) {
  const Tally none;
  constexpr double at = 0.8, mean = 0.5 * at + 2 * (2 - at);
  std::vector<double> events, without;
  for (int r = 0; r < repeats; ++r) {
    const Tally all = tally(r, at, {none, 0.5, 2, 1}, {none, 9, 9, 1, false});
    EXPECT_EQ(all.births, 1);
    EXPECT_GE(all.time, at);
    events.push_back(all.happened[0]);
    without.push_back(all.happened[0] == 0 ? 1 : 0);
  }
  EXPECT_LT(std::abs(summarise(events).z(mean)), zLimit);
  EXPECT_LT(std::abs(summarise(without).z(std::exp(-mean))), zLimit);
}

TEST(EventLoop, RatesBeyondAllNumbersAreSaid) {
  const Tally none;
  try {
    (void)tally(0, infinity, {none, 3, 0, 1}, {none, infinity, 0, 1});
    FAIL() << "no error";
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("the rate of the second is too large"), std::string::npos) << error.what();
  }
}

// Rates that change from step to step, weights that change from nucleus to nucleus.
TEST(EvenBirths, FollowTheIntegralOfTheRate) {
  std::vector<double> missing;
  for (int r = 0; r < repeats; ++r) {
    RandomStream random(8, static_cast<std::uint64_t>(r), 3);
    EvenBirths births;
    double born = 0, integral = 0, weight = 1;
    for (int step = 0; step < 9; ++step) {
      const double rate = 1 + step % 3, length = 0.37 * (1 + step % 2);
      births.setRate(rate);
      births.plan(weight, random);
      double time = 0;
      for (double due = births.due(time); due < length; due = births.due(time)) {
        births.pass(due - time);
        births.happen();
        time = due;
        const double next = 2.5 - weight;
        births.bear(weight, next, random);
        born += std::exchange(weight, next);
      }
      births.pass(length - time);
      integral += rate * length;
      EXPECT_LT(std::abs(born - integral), 3);
    }
    missing.push_back(born - integral);
  }
  EXPECT_LT(std::abs(summarise(missing).z(0)), zLimit);
}

TEST(EvenBirths, ThinWithTheGas) {
  RandomStream random(9, 1, 3);
  EvenBirths births;
  births.setRate(4);
  births.plan(1, random);
  const double due = births.due(0);
  births.dilute(0.25);
  EXPECT_DOUBLE_EQ(births.due(0), 0.25 * due);
  births.setRate(0);
  EXPECT_EQ(births.due(0), infinity);
}

TEST(SplitStep, HasTheFirstOutsideAndTheLastOnce) {
  std::string order;
  const auto of = [&](char name) {
    return [&order, name](double dt) { order += name + std::to_string(dt).substr(0, 3); };
  };
  splitStep(2.0, of('a'), of('b'), of('c'));
  EXPECT_EQ(order, "a1.0b1.0c2.0b1.0a1.0");
}

TEST(SplitStep, StepsFillTheTimeOrEndEarly) {
  std::vector<double> steps;
  inSteps(
      1.0, [](double left) { return std::min(left, 0.4); }, [&](double step) { steps.push_back(step); });
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_NEAR(steps[2], 0.2, 1e-15);
  inSteps(
      1.0, [&](double) { return steps.size() < 5 ? 0.1 : 0.0; }, [&](double step) { steps.push_back(step); });
  EXPECT_EQ(steps.size(), 5U);
}

}  // namespace
}  // namespace lampblack::test
