// Student's t against tables, and how often blocks are found stationary or correlated that are, and that are not.
#include "coupling/block_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/coupling/noise.hpp"

namespace lampblack::coupling {
namespace {

using test::Noise;

TEST(BlockStatistics, KnowsStudentsDistribution) {
  // Abramowitz and Stegun (1964), table 26.10, A = 0.95.
  const std::vector<std::pair<std::size_t, double>> table{{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},
                                                          {5, 2.571},  {9, 2.262},  {10, 2.228}, {29, 2.045},
                                                          {60, 2.000}, {120, 1.980}};
  for (const auto& [freedom, t] : table) EXPECT_NEAR(studentQuantile(freedom), t, 6e-4) << freedom;
  EXPECT_NEAR(studentQuantile(100000), 1.96, 3e-3);
}

TEST(BlockStatistics, HasNoIntervalOfFourBlocks) {
  EXPECT_FALSE(BlockInterval::of(4));
  const std::vector<double> blocks{1.0, 2.0, 3.0, 4.0, 5.0};
  const BlockMean of = meanOf(blocks);
  EXPECT_DOUBLE_EQ(of.mean, 3.0);
  EXPECT_DOUBLE_EQ(of.squares, 10.0);
  EXPECT_NEAR(BlockInterval::of(5).value().half(of.squares), 2.776 * std::sqrt(10.0 / 20.0), 1e-3);
}

// By hand: of -1, 1, 0 about their mean the products are -1 and 0, the squares 2. Two blocks have no correlation of
// their own.
TEST(BlockStatistics, TheCorrelationOfThreeBlocksIsThatByHand) {
  const std::vector<double> three{4.0, 6.0, 5.0}, two{4.0, 6.0};
  EXPECT_DOUBLE_EQ(lagOneCorrelation(three), -0.5);
  EXPECT_EQ(lagOneCorrelation(two), 0.0);
}

// Of so many series the share for which `found` is true. A series: `value(i, noise)` for each block.
constexpr int seeds = 1000;
double share(std::size_t blocks, double memory, const std::function<double(double i, double noise)>& value,
             const std::function<bool(const std::vector<double>&)>& found) {
  int count = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Noise noise(static_cast<std::uint64_t>(seed), memory);
    std::vector<double> series;
    for (std::size_t i = 0; i < blocks; ++i) series.push_back(value(static_cast<double>(i), noise.next()));
    if (found(series)) ++count;
  }
  return static_cast<double>(count) / seeds;
}

bool stationary(const std::vector<double>& series) {
  return isStationary(series, 0.0);
}

TEST(BlockStatistics, FindsNoiseStationaryAndGrowthNot) {
  const auto flat = [](double, double noise) { return 10.0 + noise; };
  // Four tests at 95 %, which depend on each other.
  for (const std::size_t blocks : {10U, 20U, 50U}) EXPECT_GT(share(blocks, 0.0, flat, stationary), 0.85) << blocks;
  EXPECT_EQ(share(9, 0.0, flat, stationary), 0.0) << "too few";
  EXPECT_EQ(share(
                20, 0.0, [](double, double) { return 0.0; }, stationary),
            0.0)
      << "nothing has begun";
  EXPECT_LT(share(
                10, 0.0, [](double i, double noise) { return 20.0 + i + noise; }, stationary),
            0.01);
  EXPECT_LT(share(
                10, 0.0, [](double i, double noise) { return 30.0 - i + noise; }, stationary),
            0.01);
  EXPECT_LT(share(
                10, 0.0, [](double i, double noise) { return std::exp(2.0 * i) * (1.0 + 0.01 * noise); }, stationary),
            0.01)
      << "a growth by powers leaves a line a large scatter";
  const auto peak = [](double i, double noise) { return 100.0 - 2.0 * (i - 4.5) * (i - 4.5) + noise; };
  EXPECT_LT(share(10, 0.0, peak, stationary), 0.05) << "a peak in the middle has no slope";
}

// What approaches its end is found stationary when the rest is not seen for the noise, and not before.
TEST(BlockStatistics, WaitsForTheEndOfAnApproach) {
  constexpr double time = 6.0, noise = 0.02;  // blocks; of the end
  double early = 0.0, late = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Noise random(seed, 0.0);
    std::vector<double> series;
    while (!isStationary(series, 0.0) && series.size() < 200)
      series.push_back(1.0 - std::exp(-static_cast<double>(series.size()) / time) + noise * random.next());
    const double left = std::exp(-static_cast<double>(series.size()) / time);
    if (left > 3.0 * noise) early += 1.0 / 200.0;
    if (series.size() > 60) late += 1.0 / 200.0;
  }
  EXPECT_LT(early, 0.02) << "share of starts with more left than three deviations";
  EXPECT_LT(late, 0.02);
}

TEST(BlockStatistics, TakesASmallDriftForNone) {
  std::vector<double> series;
  for (int i = 0; i < 10; ++i) series.push_back(1.0 + 0.0005 * i);
  EXPECT_FALSE(isStationary(series, 0.0));
  EXPECT_FALSE(isStationary(series, 0.004));
  EXPECT_TRUE(isStationary(series, 0.005));
}

TEST(BlockStatistics, SeesCorrelatedBlocks) {
  const auto flat = [](double, double noise) { return noise; };
  const auto correlated = [](const std::vector<double>& series) { return areCorrelated(series); };
  for (const std::size_t blocks : {6U, 12U, 40U}) EXPECT_LT(share(blocks, 0.0, flat, correlated), 0.08) << blocks;
  EXPECT_GT(share(40, 0.6, flat, correlated), 0.9);
  EXPECT_FALSE(areCorrelated(std::vector<double>{1.0, 2.0, 3.0, 4.0})) << "too few";
  EXPECT_EQ(lagOneCorrelation(std::vector<double>{1.0, 1.0, 1.0, 1.0, 1.0}), 0.0);
}

// Means over blocks of a process whose memory is known.
TEST(BlockStatistics, KnowsTheTimeFromTheBlocksCorrelation) {
  constexpr double time = 50.0;  // steps
  for (const int length : {50, 100}) {
    Noise noise(3, std::exp(-1.0 / time));
    std::vector<double> series(4000, 0.0);
    for (double& block : series)
      for (int i = 0; i < length; ++i) block += noise.next() / length;
    EXPECT_NEAR(correlationTime(lagOneCorrelation(series)) * length, time, 0.1 * time) << length;
  }
  EXPECT_EQ(correlationTime(-0.1), 0.0);
  EXPECT_NEAR(1.0 / (2.0 * (longBlock - 1.0)), 0.06, 0.01);
}

}  // namespace
}  // namespace lampblack::coupling
