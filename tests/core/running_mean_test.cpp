// Mean and scatter against their definitions, and a ratio of means against the ratio estimator's.
#include "core/running_mean.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr std::array<double, 5> runningN{4, 1, 0, 6, 3}, runningX{8.5, 1.5, 0, 13, 5};

TEST(RunningMean, IsMeanAndStandardErrorByTheirDefinitions) {
  RunningMean mean;
  EXPECT_TRUE(std::isnan(mean.mean()));
  for (const double x : runningX) mean.add(x);
  double squares = 0;
  for (const double x : runningX) squares += (x - 5.6) * (x - 5.6);
  EXPECT_NEAR(mean.mean(), 5.6, 1e-14);
  EXPECT_NEAR(mean.standardError(), std::sqrt(squares / 4 / 5), 1e-14);
}

TEST(RunningMean, OfOneValueHasNoError) {
  RunningMean mean;
  mean.add(3);
  EXPECT_EQ(mean.mean(), 3);
  EXPECT_TRUE(std::isnan(mean.standardError()));
}

TEST(RunningRatio, IsThatOfTheSumsWithTheErrorOfItsLinearisation) {
  RunningRatio ratio;
  EXPECT_TRUE(std::isnan(ratio.ratio()));
  for (std::size_t i = 0; i < runningN.size(); ++i) ratio.add(runningN[i], runningX[i]);
  EXPECT_NEAR(ratio.ratio(), 28.0 / 14, 1e-14);
  double squares = 0;
  for (std::size_t i = 0; i < runningN.size(); ++i) squares += std::pow(runningX[i] - 2 * runningN[i], 2);
  EXPECT_NEAR(ratio.standardError(), std::sqrt(squares / 4 / 5) / 2.8, 1e-14);
}

TEST(RunningRatio, OfProportionalNumbersIsExact) {
  RunningRatio ratio;
  for (const double n : {1.0, 5.0, 2.0}) ratio.add(n, 0.25 * n);
  EXPECT_NEAR(ratio.ratio(), 0.25, 1e-15);
  EXPECT_NEAR(ratio.standardError(), 0, 1e-8);
}

}  // namespace
}  // namespace lampblack::test
