#include "io/time_left.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {
namespace {

// Steps of half a second each: what is said after each of them, and what the rest takes in truth.
struct Said {
  std::optional<double> seconds;
  double truth = 0, done = 0;
};

std::vector<Said> run(const std::vector<double>& steps) {
  double end = 0, t = 0;
  for (const double dt : steps) end += dt;
  TimeLeft left;
  std::vector<Said> said;
  for (const double dt : steps) {
    t += dt;
    const double elapsed = 0.5 * static_cast<double>(said.size() + 1);
    left.report(elapsed, t / end);
    said.push_back({left.seconds(), 0.5 * static_cast<double>(steps.size()) - elapsed, t / end});
  }
  return said;
}

// A run of a minute and a half, whose steps grow by a fifth from a thousandth of their largest. Time over share would
// say more than a day at the first of them. Nothing is said while they grow; then not twice the truth, as the last
// quarter of the time may still hold some of the small steps, and the truth when it no longer does.
TEST(TimeLeft, WaitsUntilStepsHaveGrown) {
  std::vector<double> steps;
  for (double dt = 1e-3; steps.size() < 180; dt = std::min(1.2 * dt, 1.0)) steps.push_back(dt);
  const auto said = run(steps);
  const auto first = std::ranges::find_if(said, [](const Said& s) { return s.seconds.has_value(); });
  const auto grown = std::ranges::find(steps, 1.0) - steps.begin();
  EXPECT_GE(first - said.begin(), grown);
  EXPECT_LT(first - said.begin(), 2 * grown);
  for (auto s = first; s != said.end(); ++s) {
    ASSERT_TRUE(s->seconds.has_value()) << "what is known stays known";
    const bool smallStepsCount = 0.75 * static_cast<double>(s - said.begin() + 1) < static_cast<double>(grown);
    EXPECT_NEAR(*s->seconds, s->truth, smallStepsCount ? s->truth : 1e-9) << 100 * s->done << " %";
  }
}

// Steps that grow all the way are never settled: 5 % have to be done.
TEST(TimeLeft, WaitsForFivePercentOfStepsThatKeepGrowing) {
  std::vector<double> steps;
  for (int i = 1; i <= 400; ++i) steps.push_back(i);
  for (const Said& s : run(steps)) EXPECT_EQ(s.seconds.has_value(), s.done >= 0.05) << 100 * s.done << " %";
}

// Equal steps of a long run: known from the twentieth on, far below 5 %, and right; thinning keeps it so.
TEST(TimeLeft, IsKnownEarlyOfEqualSteps) {
  const auto said = run(std::vector<double>(20000, 1.0));
  EXPECT_FALSE(said[18].seconds.has_value());
  for (std::size_t i = 19; i < said.size(); ++i) {
    ASSERT_TRUE(said[i].seconds.has_value()) << i;
    ASSERT_NEAR(*said[i].seconds, said[i].truth, 1e-6 * said[i].truth + 1e-6) << i;
  }
}

TEST(TimeLeft, IsNotKnownWhileNothingMoves) {
  TimeLeft left;
  for (int i = 1; i <= 50; ++i) left.report(i, 0);
  EXPECT_FALSE(left.seconds().has_value());
}

}  // namespace
}  // namespace lampblack::io
