// When a cell is asked again how fast its reactions grow.
#include "flow/models/asked_again.hpp"

#include <gtest/gtest.h>

namespace lampblack::flow {
namespace {

// Steps until it is asked next, in which it changes by this.
int stepsUntilDue(double change, double& asked, double& left) {
  int steps = 1;
  while (!AskedAgain::isDue(change, asked, left) && steps < 1000) ++steps;
  return steps;
}

TEST(AskedAgain, AtOnceSoonAndThenLate) {
  double asked = 0, left = 0;
  EXPECT_EQ(stepsUntilDue(0.02, asked, left), 1);
  EXPECT_EQ(asked, 0.02);
  EXPECT_EQ(stepsUntilDue(0.02, asked, left), 8);
  EXPECT_EQ(stepsUntilDue(0.021, asked, left), 32);
  EXPECT_EQ(stepsUntilDue(0.017, asked, left), 32);
  EXPECT_EQ(asked, 0.017);
}

TEST(AskedAgain, AtOnceWhereAStepChangesMore) {
  double asked = 0.02, left = 20;
  EXPECT_EQ(stepsUntilDue(0.0249, asked, left), 20);
  EXPECT_EQ(stepsUntilDue(0.032, asked, left), 1);
  EXPECT_EQ(left, 8);  // it has changed: soon again
}

TEST(AskedAgain, SoonWhereAStepChangesLess) {
  double asked = 0.02, left = 3;
  EXPECT_EQ(stepsUntilDue(0.01, asked, left), 3);
  EXPECT_EQ(stepsUntilDue(0.01, asked, left), 8);
}

}  // namespace
}  // namespace lampblack::flow
