// Stage timers and their spread over the ranks.
#include "core/timers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

void spend(Timers& timers, const char* stage, int milliseconds) {
  const Timers::Scope scope(timers, stage);
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(TimersTest, ScopesOfOneStageAddUp) {
  Timers timers;
  EXPECT_EQ(timers.seconds("reaction"), 0.0);
  spend(timers, "reaction", 10);
  const double once = timers.seconds("reaction");
  EXPECT_GE(once, 0.010);  // a sleep lasts at least as long as asked for
  spend(timers, "reaction", 10);
  EXPECT_GE(timers.seconds("reaction"), once + 0.010);
  EXPECT_EQ(timers.seconds("transport"), 0.0);
}

TEST(TimersTest, NestedStagesAreEachCounted) {
  Timers timers;
  {
    const Timers::Scope outer(timers, "step");
    spend(timers, "reaction", 5);
  }
  EXPECT_GE(timers.seconds("step"), timers.seconds("reaction"));
  EXPECT_GE(timers.seconds("reaction"), 0.005);
}

TEST(TimersTest, GatherGivesLeastMeanAndMostOverTheRanksInOrderOfFirstUse) {
  Timers timers;
  spend(timers, "transport", 1);
  spend(timers, "reaction", 10 * (worldRank() + 1));
  const auto stages = timers.gather(MPI_COMM_WORLD);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].name, "transport");
  EXPECT_EQ(stages[1].name, "reaction");
  const double own = timers.seconds("reaction");
  EXPECT_LE(stages[1].least, own);
  EXPECT_GE(stages[1].most, own);
  EXPECT_GE(stages[1].least, 0.010);
  EXPECT_GE(stages[1].most, 0.010 * worldSize());
  EXPECT_NEAR(stages[1].mean, sumOverRanks(own) / worldSize(), 1e-15 * worldSize());
}

TEST(TimersTest, RanksThatMetStagesInAnotherOrderOrNotAtAllAreStillMatchedByName) {
  Timers timers;
  const bool last = worldRank() == worldSize() - 1;
  if (worldRank() == 0) {
    spend(timers, "write", 2);
    spend(timers, "reaction", 20);
  } else {
    spend(timers, "only here", 1);
    spend(timers, "reaction", 20);
    if (!last) spend(timers, "write", 2);
  }
  const auto stages = timers.gather(MPI_COMM_WORLD);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].name, "write");
  EXPECT_EQ(stages[1].name, "reaction");
  EXPECT_GE(stages[1].least, 0.020);
  if (worldSize() > 1) {
    EXPECT_EQ(stages[0].least, 0.0);  // the last rank never wrote
  }
}

TEST(TimersTest, NothingTimedGathersNothing) {
  EXPECT_TRUE(Timers().gather(MPI_COMM_WORLD).empty());
}

}  // namespace
}  // namespace lampblack::test
