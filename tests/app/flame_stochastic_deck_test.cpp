#include "app/problems/flame/flame_stochastic_deck.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "app/problems/flame/flame_case.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/trees/tree_ensemble.hpp"
#include "tests/messages.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

std::optional<StochasticRequest> requestOf(const std::string& sections) {
  const std::string file = test::sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml");
  static const auto mechanism = std::make_shared<const Mechanism>(Mechanism::fromFile(file));
  const std::string stream = "{temperature: 300 K, composition: \"O2: 1\", velocity: 1 m/s}";
  const Deck deck = Deck::parse(
      fmt::format(
          "problem: flame1d\nmechanism: {}\nflame: {{type: counterflow, length: 9 mm}}\nleft: {}\nright: {}\n{}", file,
          stream, stream, sections),
      "deck.yaml", {}, flameSchema());
  return readStochastic(deck, mechanism, 0.009, true);
}

TEST(StochasticDeck, APathFromTheRightStartsAsFarFromItsEndAsThatFromTheLeft) {
  const auto request = requestOf("particles: {description: ensemble, carried: two_equation_dimer, start: 2 mm}\n");
  ASSERT_TRUE(request);
  const auto& paths = request->coupling.ensemble.paths;
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_FALSE(paths[0].fromRight);
  EXPECT_NEAR(paths[0].start.value(), 0.002, 1e-12);
  EXPECT_TRUE(paths[1].fromRight);
  EXPECT_NEAR(paths[1].start.value(), 0.007, 1e-12);
  EXPECT_EQ(request->elements, (std::vector<std::string>{"C", "H"}));
  EXPECT_EQ(request->watched, "C2H2");
}

TEST(StochasticDeck, PathsOfAFlameTakeTreesToo) {
  const auto request =
      requestOf("particles: {description: trees, number: 16, repeats: 3, bins: 7, coupling: two_way}\n");
  ASSERT_TRUE(request);
  EXPECT_TRUE(request->twoWay);
  EXPECT_EQ(request->coupling.ensemble.repeats, 3U);
  EXPECT_EQ(request->coupling.ensemble.march.bins.count, 7U);
  const auto trees = request->coupling.ensemble.make(0);
  EXPECT_NE(dynamic_cast<const TreeEnsemble*>(trees.get()), nullptr);
  EXPECT_EQ(request->watched, "C2H2");
  EXPECT_FALSE(requestOf("particles: {description: none}\n"));
}

TEST(StochasticDeck, WhatIsOfAnotherKindIsRefused) {
  for (const auto& [keys, expected] :
       {std::pair{"description: trees, method: dsmc", "particles.method: 'particles.description: trees' does not have"},
        std::pair{"description: trees, shape: aggregates", "particles.shape: 'particles.description: trees'"},
        std::pair{"description: ensemble, smoothing: 1", "particles.smoothing: 'particles.description: ensemble'"},
        std::pair{"description: hmom, carried: momic", "particles.carried: 'particles.description: hmom'"},
        std::pair{"description: hmom, heights: [5 mm]", "particles.heights: 'particles.description: hmom'"},
        std::pair{"description: ensemble, hmom: {fractal_dimension: 2}",
                  "choose: hmom, none; or 'particles.carried': hmom"},
        std::pair{"description: trees, material: silica, carried: hmom", "hmom is a model of soot"}})
    EXPECT_THAT(
        test::messageOf<InputError>([text = keys] { (void)requestOf(fmt::format("particles: {{{}}}\n", text)); }),
        testing::HasSubstr(expected));
  EXPECT_TRUE(requestOf("particles: {description: ensemble, carried: hmom, hmom: {fractal_dimension: 2}}\n"));
}

}  // namespace
}  // namespace lampblack::app
