// Decks that go on from another one.
#include "io/deck_base.hpp"

#include <fstream>

#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

using test::sampleText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// The sample deck as base.yaml, and a deck beside it, files of the first rank.
struct Folder {
  explicit Folder(const std::string& text, const std::string& base = sampleText) {
    if (test::worldRank() != 0) return;
    std::ofstream(path.parent_path() / "base.yaml") << base;
    std::ofstream(path) << text;
  }
  [[nodiscard]] Deck deck(const std::vector<std::string>& overrides = {}) const {
    return Deck::load(path, overrides, test::sampleSchema(), MPI_COMM_WORLD);
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)deck();
    } catch (const InputError& error) {
      EXPECT_TRUE(isCollective(error));
      return error.what();
    }
    return "accepted";
  }
  test::SharedScratchFolder scratch;
  std::filesystem::path path = scratch.path() / "deck.yaml";
};

TEST(DeckBase, MapsGoOverThoseOfTheBase) {
  const Folder folder("base: base.yaml\nboundaries:\n  fuel: {velocity: 30 cm/s}\n  coflow: {type: inlet}\nseed: 7\n");
  const Deck deck = folder.deck();
  EXPECT_DOUBLE_EQ(deck.quantity("boundaries.fuel.velocity"), 0.3);
  EXPECT_EQ(deck.choice("boundaries.fuel.type"), "inlet");
  EXPECT_DOUBLE_EQ(deck.quantity("boundaries.oxidiser.velocity"), 0.2);
  EXPECT_THAT(deck.children("boundaries"), ElementsAre("fuel", "oxidiser", "outside", "coflow"));
  EXPECT_EQ(deck.integer("seed"), 7);
  EXPECT_DOUBLE_EQ(deck.quantity("time.end"), 0.04);
  EXPECT_EQ(deck.path(), folder.path);
  EXPECT_THAT(deck.resolved(), testing::Not(HasSubstr("base")));
}

TEST(DeckBase, ListsAndValuesReplaceThoseOfTheBase) {
  const Deck deck = Folder("base: base.yaml\nmesh:\n  z: [{to: 5 mm, cells: 3}]\ntime: {end: 1 ms}\n").deck();
  EXPECT_EQ(deck.size("mesh.z"), 1U);
  EXPECT_EQ(deck.integer("mesh.z[0].cells"), 3);
  EXPECT_DOUBLE_EQ(deck.quantity("time.end"), 1e-3);
}

// Also where that is a mistake: what a deck says is never passed over.
TEST(DeckBase, ValuesReplaceMapsAndMapsReplaceValues) {
  const Folder value("base: base.yaml\ntime: 1 ms\n"), map("base: base.yaml\nproblem: {end: 1 ms}\n");
  EXPECT_THAT(value.refusal(), StartsWith(value.path.string() + ":2:7: time: expected a map of keys"));
  EXPECT_THAT(map.refusal(), StartsWith(map.path.string() + ":2:10: problem: "));
}

TEST(DeckBase, SettingsGoOverBoth) {
  const Folder folder("base: base.yaml\nseed: 7\n");
  EXPECT_EQ(folder.deck({"seed=8"}).integer("seed"), 8);
  EXPECT_DOUBLE_EQ(folder.deck({"time.end=2 ms"}).quantity("time.end"), 2e-3);
}

TEST(DeckBase, MistakesPointIntoTheFileTheyStandIn) {
  const std::string wrongBase = sampleText + "tiem: 3\n";
  const Folder inBase("base: base.yaml\n", wrongBase);
  EXPECT_THAT(inBase.refusal(), StartsWith((inBase.path.parent_path() / "base.yaml:23:1: tiem: unknown key").string()));
  EXPECT_THAT(inBase.refusal(), HasSubstr("    23 | tiem: 3\n"));
  const Folder inDeck("# on top\nbase: base.yaml\ntime: {end: 1 m}\n");
  EXPECT_THAT(inDeck.refusal(), StartsWith(inDeck.path.string() + ":3:13: time.end: expected a time"));
}

TEST(DeckBase, IsADeckOfTheSameFolder) {
  EXPECT_THAT(Folder("base: ../base.yaml\n").refusal(),
              HasSubstr("base: expected the name of a deck in the same folder ('deck.yaml'), found '../base.yaml'"));
  EXPECT_THAT(Folder("base: [base.yaml]\n").refusal(),
              HasSubstr("in the same folder ('deck.yaml'), found a list of 1"));
  EXPECT_THAT(Folder("base:\n").refusal(), HasSubstr("in the same folder ('deck.yaml'), found nothing"));
  EXPECT_THAT(Folder("base: none.yaml\n").refusal(), HasSubstr("none.yaml: there is no such file; expected a deck"));
  EXPECT_THAT(Folder("base: deck.yaml\n").refusal(), HasSubstr("has no base of its own"));
}

TEST(DeckBase, TextsThatAreNoFilesHaveNone) {
  EXPECT_THAT(test::messageOf(sampleText + "base: deck.yaml\n"), HasSubstr("unknown key 'base'"));
}

}  // namespace
}  // namespace lampblack::io
