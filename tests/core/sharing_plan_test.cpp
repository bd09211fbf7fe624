// The plan by which ranks share work, from costs alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "core/work_sharing.hpp"

namespace lampblack {
namespace {

std::vector<double> loadAfter(std::vector<double> load, const SharingPlan& plan) {
  for (const auto& transfer : plan.transfers) {
    load[static_cast<std::size_t>(transfer.from)] -= transfer.cost;
    load[static_cast<std::size_t>(transfer.to)] += transfer.cost;
  }
  return load;
}

TEST(SharingPlan, OneBusyRankGivesToAllOthersTheirShare) {
  const auto plan = planSharing({8.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(plan.imbalanceBefore, 4.0);
  EXPECT_EQ(plan.imbalancePlanned, 1.0);
  ASSERT_EQ(plan.transfers.size(), 3u);
  for (const auto& transfer : plan.transfers) {
    EXPECT_EQ(transfer.from, 0);
    EXPECT_EQ(transfer.cost, 2.0);
  }
  EXPECT_EQ(loadAfter({8.0, 0.0, 0.0, 0.0}, plan), std::vector<double>(4, 2.0));
}

TEST(SharingPlan, BalancedLoadStaysWhereItIs) {
  EXPECT_TRUE(planSharing({3.0, 3.0, 3.0}).transfers.empty());
  EXPECT_TRUE(planSharing({1.01, 0.99}).transfers.empty());  // within the tolerance of 2 %
  EXPECT_FALSE(planSharing({1.01, 0.99}, 0.001).transfers.empty());
}

TEST(SharingPlan, NothingToShareIsBalanced) {
  for (const std::vector<double>& cost : {std::vector<double>{}, {0.0}, {5.0}, {0.0, 0.0, 0.0}}) {
    const auto plan = planSharing(cost);
    EXPECT_TRUE(plan.transfers.empty());
    EXPECT_EQ(plan.imbalanceBefore, 1.0);
    EXPECT_EQ(plan.imbalancePlanned, 1.0);
  }
}

TEST(SharingPlan, AnyLoadIsBalancedWithFewerTransfersThanRanksAndNoRankBothGivesAndTakes) {
  constexpr double tolerance = 0.02;
  for (std::uint64_t sample = 0; sample < 300; ++sample) {
    RandomStream random(1, sample, 0);
    std::vector<double> cost(1 + random.below(40));
    for (double& c : cost) c = random.exponential(1.0) * (random.uniform() < 0.2 ? 30.0 : 1.0);
    const auto plan = planSharing(cost, tolerance);
    const auto load = loadAfter(cost, plan);
    const double total = std::accumulate(cost.begin(), cost.end(), 0.0);
    const double ranks = static_cast<double>(cost.size());
    const double rounding = ranks * ranks * std::numeric_limits<double>::epsilon() * total;

    EXPECT_LT(plan.transfers.size(), cost.size());
    EXPECT_LE(*std::max_element(load.begin(), load.end()), total / ranks * (1.0 + tolerance) + rounding);
    EXPECT_NEAR(std::accumulate(load.begin(), load.end(), 0.0), total, rounding);
    EXPECT_LE(plan.imbalancePlanned, plan.imbalanceBefore);
    std::vector<bool> gives(cost.size(), false);
    std::vector<bool> takes(cost.size(), false);
    for (const auto& transfer : plan.transfers) {
      EXPECT_GT(transfer.cost, 0.0);
      gives[static_cast<std::size_t>(transfer.from)] = true;
      takes[static_cast<std::size_t>(transfer.to)] = true;
    }
    for (std::size_t r = 0; r < cost.size(); ++r) EXPECT_FALSE(gives[r] && takes[r]) << "rank " << r;
  }
}

}  // namespace
}  // namespace lampblack
