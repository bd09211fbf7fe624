// The plan of gas and particles in turn.
#include "flow/steady/steady_rounds.hpp"

#include <gtest/gtest.h>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr auto gas = SteadyRounds::Turn::Gas, particles = SteadyRounds::Turn::Particles;

// The round that ends with such a gas; whether it was the last.
bool round(SteadyRounds& rounds, double change) {
  EXPECT_EQ(rounds.turn(), particles);
  rounds.addParticles();
  EXPECT_EQ(rounds.turn(), gas);
  rounds.addGas(change);
  return rounds.isDone();
}

TEST(SteadyRounds, EndWhereTheGasAgreesAfterLongAverages) {
  SteadyRounds rounds({.most = 20, .tolerance = 0.01, .blocks = 30, .leastBlocks = 5});
  EXPECT_EQ(rounds.turn(), gas);
  rounds.addGas({});
  EXPECT_EQ(rounds.blocks(), 5U);
  EXPECT_FALSE(round(rounds, 0.4));
  EXPECT_EQ(rounds.blocks(), 5U);
  // The averages were short: once more, with long ones.
  EXPECT_FALSE(round(rounds, 0.009));
  EXPECT_EQ(rounds.blocks(), 30U);
  EXPECT_FALSE(round(rounds, 0.011));
  EXPECT_FALSE(rounds.agrees());
  EXPECT_EQ(rounds.blocks(), 30U);
  EXPECT_TRUE(round(rounds, 0.01));
  EXPECT_TRUE(rounds.agrees());
  EXPECT_EQ(rounds.rounds(), 4);
}

TEST(SteadyRounds, EndAfterTheMostWithLongAveragesAndSayWhetherTheyAgree) {
  SteadyRounds rounds({.most = 2, .tolerance = 0.01, .blocks = 30, .leastBlocks = 5});
  rounds.addGas({});
  EXPECT_FALSE(round(rounds, 0.4));
  EXPECT_EQ(rounds.blocks(), 30U);
  EXPECT_TRUE(round(rounds, 0.2));
  EXPECT_FALSE(rounds.agrees());
}

TEST(SteadyRounds, AreOneWhereTheGasDoesNotKnowOfTheParticles) {
  SteadyRounds rounds({.blocks = 30, .leastBlocks = 5, .actsOnGas = false});
  rounds.addGas({});
  EXPECT_EQ(rounds.blocks(), 30U);
  EXPECT_EQ(rounds.turn(), particles);
  rounds.addParticles();
  EXPECT_TRUE(rounds.isDone());
  EXPECT_TRUE(rounds.agrees());
}

}  // namespace
}  // namespace lampblack::test
