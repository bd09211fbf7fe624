#include "app/flame1d/flame_stochastic_deck.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "app/flame1d/flame_case.hpp"
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
  const auto request = requestOf("soot: {pah: [A2]}\nstochastic: {start: 2 mm}\n");
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
  const auto request = requestOf(
      "soot: {pah: [A2]}\nparticles: {material: soot, number: 16, repeats: 3, bins: 7}\nstochastic: {coupling: "
      "two_way}\n");
  ASSERT_TRUE(request);
  EXPECT_TRUE(request->twoWay);
  EXPECT_EQ(request->coupling.ensemble.repeats, 3U);
  EXPECT_EQ(request->coupling.ensemble.march.bins.count, 7U);
  const auto trees = request->coupling.ensemble.make(0);
  EXPECT_NE(dynamic_cast<const TreeEnsemble*>(trees.get()), nullptr);
  EXPECT_EQ(request->watched, "C2H2");
  EXPECT_FALSE(requestOf("soot: {model: none}\n"));
}

TEST(StochasticDeck, WhatIsOfAnotherKindIsRefused) {
  for (const auto& [sections, expected] :
       {std::pair{"soot: {pah: [A2]}\nparticles: {material: soot}\n", "in a flame these need the section 'stochastic'"},
        std::pair{"soot: {pah: [A2]}\nparticles: {material: soot}\nstochastic: {repeats: 4}\n", "this is of soot"},
        std::pair{"soot: {pah: [A2]}\nparticles: {material: soot}\nstochastic: {shape: aggregates}\n",
                  "this is of soot"},
        std::pair{"soot: {pah: [A2]}\nparticles: {material: soot}\nstochastic: {number: 40}\n", "this is of soot"},
        std::pair{"stochastic: {repeats: 4}\n", "ensembles need the section 'soot'"}})
    EXPECT_THAT(test::messageOf<InputError>([text = sections] { (void)requestOf(text); }),
                testing::HasSubstr(expected));
}

// The section `soot` says these.
TEST(StochasticDeck, TreesOfSootHaveNoSecondKeyForWhatSootSays) {
  for (const char* key : {"density: 1900 kg/m^3", "coagulation: false", "enhancement: 2", "slip: davies"})
    EXPECT_THAT(test::messageOf<InputError>([key] {
                  (void)requestOf("soot: {pah: [A2]}\nparticles: {material: soot, " + std::string(key) +
                                  "}\nstochastic: {coupling: two_way}\n");
                }),
                testing::AllOf(testing::HasSubstr("particles." + std::string(key).substr(0, 4)),
                               testing::HasSubstr("of soot this is 'soot.")))
        << key;
}

}  // namespace
}  // namespace lampblack::app
