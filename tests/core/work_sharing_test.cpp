// Work sharing: results do not depend on where items run, and the load becomes even.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/every_module.hpp"
#include "work_items.hpp"

namespace lampblack::test {
namespace {

TEST(WorkSharingTest, ResultsAreTheSameBitsWithAndWithoutSharing) {
  for (const auto& counts : {skewed(), allOn(0, 50), allOn(worldSize() - 1, 50)}) {
    Bag apart(counts, 5);
    Bag together(counts, 5);
    EXPECT_EQ(WorkSharing(MPI_COMM_WORLD, false).run(apart.items).itemsSent, 0u);
    const auto sent = WorkSharing(MPI_COMM_WORLD).run(together.items).itemsSent;
    EXPECT_EQ(together.results, apart.results);
    if (worldSize() > 1) {
      EXPECT_GT(sumOverRanks(static_cast<double>(sent)), 0.0);
    }
  }
}

// Groups of any size, the last one of what is left: as one by one.
TEST(WorkSharingTest, ItemsInGroupsAreAsItemsOneByOne) {
  Bag alone(skewed(), 5);
  WorkSharing(MPI_COMM_WORLD).run(alone.items);
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    for (const bool shared : {true, false}) {
      Bag bag(skewed(), 5);
      std::size_t largest = 0;
      bag.items.groupSize = size;
      bag.items.advanceGroup = [&](auto inputs, auto outputs) {
        ASSERT_EQ(inputs.size(), outputs.size());
        largest = std::max(largest, inputs.size());
        for (std::size_t i = inputs.size(); i-- > 0;) {
          EXPECT_TRUE(outputs[i].empty());
          bag.items.advance(inputs[i], outputs[i]);
        }
      };
      WorkSharing(MPI_COMM_WORLD, shared).run(bag.items);
      EXPECT_EQ(bag.results, alone.results);
      EXPECT_EQ(bag.unpacked, alone.unpacked);
      EXPECT_LE(largest, size);
      EXPECT_GT(largest, std::min<std::size_t>(size, 4) - 1);  // rank 2 has eight items of its own
      EXPECT_EQ(sumOverRanks(bag.advanced), static_cast<double>(total(skewed())));
    }
  }
}

TEST(WorkSharingTest, EveryItemIsAdvancedAndUnpackedOnce) {
  for (const int spread : {1, 7}) {
    Bag bag(skewed(), spread);
    WorkSharing(MPI_COMM_WORLD).run(bag.items);
    EXPECT_EQ(bag.unpacked, std::vector<int>(bag.unpacked.size(), 1));
    EXPECT_EQ(sumOverRanks(bag.advanced), static_cast<double>(total(skewed())));
  }
}

TEST(WorkSharingTest, WithoutSharingEveryRankAdvancesItsOwnItems) {
  Bag bag(skewed());
  WorkSharing(MPI_COMM_WORLD, false).run(bag.items);
  EXPECT_EQ(bag.advanced, static_cast<int>(bag.items.cost.size()));
}

TEST(WorkSharingTest, SkewedCostIsSpreadToWithinAnItemATransfer) {
  for (const int spread : {1, 4}) {
    Bag bag(skewed(), spread);
    double own = 0.0;
    for (double c : bag.items.cost) own += c;
    const double mean = sumOverRanks(own) / worldSize();
    const double mostBefore = maxOverRanks(own);
    const auto statistics = WorkSharing(MPI_COMM_WORLD).run(bag.items);
    EXPECT_DOUBLE_EQ(statistics.imbalanceBefore, mostBefore / mean);
    EXPECT_GE(statistics.imbalanceAfter, 1.0);
    // The plan's tolerance, and at most one item (of cost `spread`) astray in each of at most ranks - 1 transfers.
    EXPECT_LE(maxOverRanks(bag.workDone), 1.02 * mean + (worldSize() - 1) * spread);
    if (worldSize() > 1) {
      EXPECT_LT(maxOverRanks(bag.workDone), mostBefore);
    }
  }
}

TEST(WorkSharingTest, MeasuredImbalanceFallsForASkewedCost) {
  if (worldSize() == 1) GTEST_SKIP() << "needs more than one rank";
  Bag bag(allOn(0, 30));
  // Sleep, so that ranks that share a processor do not slow each other down.
  bag.items.advance = [](std::span<const double>, std::vector<double>&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  };
  bag.items.unpack = [](std::size_t, std::span<const double>) {};
  const auto statistics = WorkSharing(MPI_COMM_WORLD).run(bag.items);
  EXPECT_EQ(statistics.imbalanceBefore, static_cast<double>(worldSize()));
  EXPECT_LT(statistics.imbalanceAfter, 0.5 * (1.0 + worldSize()));
}

// Counted in what items tell of themselves, and where they were advanced.
TEST(WorkSharingTest, CountedImbalanceIsThatOfTheWorkDone) {
  for (const bool isShared : {false, true})
    for (const bool inGroups : {false, true}) {
      Bag bag(skewed(), 3);
      const auto advance = bag.items.advance;
      double done = 0.0;
      bag.items.advance = [&](std::span<const double> input, std::vector<double>& output) {
        advance(input, output);
        output.push_back(7.0 * input.back());
        done += output.back();
      };
      if (inGroups) {
        bag.items.groupSize = 3;
        bag.items.advanceGroup = [&](auto inputs, auto outputs) {
          for (std::size_t i = 0; i < inputs.size(); ++i) bag.items.advance(inputs[i], outputs[i]);
        };
      }
      bag.items.unpack = [](std::size_t, std::span<const double>) {};
      bag.items.work = [](std::span<const double> output) { return output.back(); };
      const auto statistics = WorkSharing(MPI_COMM_WORLD, isShared).run(bag.items);
      EXPECT_DOUBLE_EQ(statistics.imbalanceAfter, maxOverRanks(done) * worldSize() / sumOverRanks(done));
      if (!isShared) {
        EXPECT_DOUBLE_EQ(statistics.imbalanceAfter, statistics.imbalanceBefore);
      }
    }
}

TEST(WorkSharingTest, BalancedItemsStayWhereTheyAre) {
  Bag bag(std::vector<int>(at(worldSize()), 20));
  EXPECT_EQ(WorkSharing(MPI_COMM_WORLD).run(bag.items).itemsSent, 0u);
  EXPECT_EQ(bag.advanced, 20);
}

TEST(WorkSharingTest, NoItemsAnywhereIsBalanced) {
  Bag bag(allOn(0, 0));
  const auto statistics = WorkSharing(MPI_COMM_WORLD).run(bag.items);
  EXPECT_EQ(statistics.itemsSent, 0u);
  EXPECT_EQ(statistics.imbalanceBefore, 1.0);
}

TEST(WorkSharingTest, ItemsOfNoCostAreAdvancedAtHome) {
  Bag bag(skewed());
  std::fill(bag.items.cost.begin(), bag.items.cost.end(), 0.0);
  EXPECT_EQ(WorkSharing(MPI_COMM_WORLD).run(bag.items).itemsSent, 0u);
  EXPECT_EQ(bag.advanced, static_cast<int>(bag.items.cost.size()));
}

TEST(WorkSharingTest, OneItemDearerThanAllOthersIsNotPassedToAndFro) {
  Bag bag(allOn(0, 1));
  const auto statistics = WorkSharing(MPI_COMM_WORLD).run(bag.items);
  EXPECT_EQ(sumOverRanks(bag.advanced), 1.0);
  EXPECT_EQ(statistics.imbalanceBefore, static_cast<double>(worldSize()));
}

TEST(WorkSharingTest, ParcelsFarBeyondTheEagerLimitArrive) {
  const std::size_t doubles = 50000;  // 400 kB an item
  Bag bag(allOn(0, 24), 1, doubles);
  Bag reference(allOn(0, 24), 1, doubles);
  WorkSharing(MPI_COMM_WORLD).run(bag.items);
  WorkSharing(MPI_COMM_WORLD, false).run(reference.items);
  EXPECT_EQ(bag.results, reference.results);
}

TEST(WorkSharingTest, ManyRunsInARowDoNotMixTheirMessages) {
  Bag reference(skewed(), 3);
  WorkSharing(MPI_COMM_WORLD, false).run(reference.items);
  WorkSharing sharing(MPI_COMM_WORLD);
  for (int run = 0; run < 50; ++run) {
    Bag bag(skewed(), 3);
    sharing.run(bag.items);
    ASSERT_EQ(maxOverRanks(bag.results == reference.results ? 0.0 : 1.0), 0.0) << "run " << run;
  }
}

}  // namespace
}  // namespace lampblack::test
