#include "app/flame1d/flame_stochastic_deck.hpp"

#include <gtest/gtest.h>

#include "core/modules.hpp"

namespace lampblack::app {
namespace {

TEST(StochasticDeck, APathFromTheRightStartsAsFarFromItsEndAsThatFromTheLeft) {
  DeckSchema schema;
  addStochasticKeys(schema);
  SootModelOptions soot;
  soot.pah = {{"A2", 10, 8, 2e-3}};
  const Deck deck = Deck::parse("stochastic: {start: 2 mm}", "deck.yaml", {}, schema);
  const auto request = readStochastic(deck, soot, 0.009, true);
  ASSERT_TRUE(request);
  const auto& paths = request->coupling.ensemble.paths;
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_FALSE(paths[0].fromRight);
  EXPECT_NEAR(paths[0].start.value(), 0.002, 1e-12);
  EXPECT_TRUE(paths[1].fromRight);
  EXPECT_NEAR(paths[1].start.value(), 0.007, 1e-12);
}

}  // namespace
}  // namespace lampblack::app
