// Leading modes of marches that are known exactly.
#include "flow/steady/leading_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/modules.hpp"

namespace lampblack::flow {
namespace {

constexpr double time = 0.25;  // s
constexpr std::size_t values = 60;

// Pairs that turn, and single values that decay, each by itself: a pair at rate +-2 pi f, from the third on decay.
// Every value has a follower, twice as large, behind all of them.
struct Known {
  double growth = 0.4, frequency = 0.8;
  double constant = 1.0;  // the state that stays
  double bend = 0.0;      // of the square of a disturbance
  double drift = 0.0;     // of every value in a march

  void march(std::vector<double>& v) const {
    const double a = std::exp(growth * time), phase = 2.0 * std::numbers::pi * frequency * time;
    std::vector<double> x(values);
    for (std::size_t i = 0; i < values; ++i) x[i] = v[i] - constant;
    const double x0 = a * (std::cos(phase) * x[0] - std::sin(phase) * x[1]) + bend * x[0] * x[0];
    const double x1 = a * (std::sin(phase) * x[0] + std::cos(phase) * x[1]);
    for (std::size_t i = 2; i < values; ++i) x[i] *= std::exp(-(1.0 + 0.5 * static_cast<double>(i)) * time);
    x[0] = x0;
    x[1] = x1;
    for (std::size_t i = 0; i < values; ++i) {
      v[i] = constant + x[i] + drift;
      v[values + i] = 2.0 * x[i] + drift;
    }
  }
  [[nodiscard]] LeadingModes modes(const ModeOptions& options, double unit = 1.0) const {
    MarchedFlow flow{[this](std::vector<double>& v) { march(v); }, time, std::vector<double>(2 * values, constant),
                     std::vector<double>(2 * values, 0.0), std::vector<double>(2 * values, 0.0)};
    for (std::size_t i = 0; i < values; ++i) {
      flow.scales[i] = unit;
      flow.shares[i] = 1.0 / values;
      flow.state[values + i] = 0.0;
    }
    return leadingModes(MPI_COMM_SELF, flow, std::vector<double>(2 * values, 1.0), options);
  }
};

TEST(LeadingModes, FindsWhatGrowsAndTurns) {
  const LeadingModes found = Known{}.modes({.vectors = 30});
  ASSERT_FALSE(found.modes.empty());
  EXPECT_NEAR(found.modes[0].growthRate, 0.4, 1e-2);
  EXPECT_NEAR(found.modes[0].frequency, 0.8, 1e-2 / (2.0 * std::numbers::pi));
  EXPECT_LE(found.modes[0].error, 0.01 * std::hypot(0.4, 2.0 * std::numbers::pi * 0.8));
  EXPECT_TRUE(found.grows());
  EXPECT_FALSE(found.decays());
  EXPECT_LT(found.vectors, 30);
  // The pair once; then what decays, with errors that hold.
  const LeadingModes all = Known{.growth = -0.4}.modes({.vectors = static_cast<int>(values)});
  EXPECT_TRUE(all.decays());
  EXPECT_FALSE(all.grows());
  ASSERT_GE(all.modes.size(), 2U);
  EXPECT_NEAR(all.modes[0].growthRate, -0.4, 2.0 * all.modes[0].error);
  EXPECT_EQ(all.modes[1].frequency, 0.0);
  EXPECT_NEAR(all.modes[1].growthRate, -2.0, 2.0 * all.modes[1].error);
  EXPECT_GT(all.modes[1].error, 0.0);
}

// A flow that is not linear, disturbed in proportion to the scales of its values.
TEST(LeadingModes, DisturbsAsMuchAsItIsTold) {
  const Known bent{.bend = 1.0};
  const double large = bent.modes({.vectors = 12, .disturbance = 0.1}).modes.at(0).growthRate;
  const double small = bent.modes({.vectors = 12, .disturbance = 1e-4}).modes.at(0).growthRate;
  const double sameAsLarge = bent.modes({.vectors = 12, .disturbance = 1e-3}, 1e-2).modes.at(0).growthRate;
  EXPECT_NEAR(small, 0.4, 1e-2);
  EXPECT_GT(std::abs(large - 0.4), 10.0 * std::abs(small - 0.4));
  EXPECT_NEAR(sameAsLarge, large, 1e-9);
}

// A state that is not quite steady.
TEST(LeadingModes, AreThoseOfDisturbancesAndNotOfTheState) {
  const LeadingModes still = Known{}.modes({.vectors = 12}), drifting = Known{.drift = 1e-3}.modes({.vectors = 12});
  EXPECT_NEAR(drifting.modes.at(0).growthRate, still.modes.at(0).growthRate, 1e-6);
  EXPECT_NEAR(drifting.modes.at(0).frequency, still.modes.at(0).frequency, 1e-6);
}

TEST(LeadingModes, AreNotToldWhereTooFewVectorsWereMarched) {
  const LeadingModes few = Known{.growth = -1.9, .frequency = 0.0}.modes({.vectors = 2});
  EXPECT_EQ(few.vectors, 2);
  EXPECT_FALSE(few.grows());
  EXPECT_FALSE(few.decays());
}

}  // namespace
}  // namespace lampblack::flow
