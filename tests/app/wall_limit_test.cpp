// When a run stops for its wall time.
#include "core/wall_limit.hpp"

#include <gtest/gtest.h>

#include "core/wall_clock.hpp"
#include "tests/every_module.hpp"

namespace lampblack::app {
namespace {

// Whole seconds after which a limit is near, asked from zero.
int nearAfter(const WallLimit& limit) {
  int elapsed = 0;
  while (elapsed < 10000 && !limit.isNear(elapsed)) ++elapsed;
  return elapsed;
}

TEST(WallLimit, LeavesTimeForTheLongestStepAndForWhatIsWritten) {
  WallLimit limit(1000.0);
  limit.recordStep(10.0);
  const int steps = nearAfter(limit);
  EXPECT_LE(steps, 990) << "a step would not end in time";
  EXPECT_GT(steps, 960);
  limit.recordStep(2.0);
  EXPECT_EQ(nearAfter(limit), steps) << "the longest counts";
  limit.recordOutput(20.0);
  const int outputs = nearAfter(limit);
  EXPECT_LE(outputs, 950) << "a step, a checkpoint no shorter than an output, and an output";
  limit.recordCheckpoint(100.0);
  const int all = nearAfter(limit);
  EXPECT_LE(all, 870) << "a step, a checkpoint, an output";
  EXPECT_GT(all, 750);
  limit.recordCheckpoint(50.0);
  EXPECT_GT(nearAfter(limit), all) << "the last checkpoint counts";
}

TEST(WallLimit, LetsOneStepPassWhateverItIs) {
  WallLimit limit(1e-3);
  EXPECT_FALSE(limit.isNear(1e6));
  limit.recordStep(1e-6);
  EXPECT_TRUE(limit.isNear(1e6));
}

TEST(WallLimit, IsNoneWithoutTheKey) {
  WallLimit limit({});
  limit.recordStep(1e3);
  EXPECT_FALSE(limit.isNear(1e9));
}

TEST(WallClock, RunsFromTheStartOfTheProgram) {
  const double now = secondsSinceStart();
  EXPECT_GT(now, 0.0);
  EXPECT_LT(now, 300.0);
  EXPECT_GE(secondsSinceStart(), now);
}

}  // namespace
}  // namespace lampblack::app
