#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack::io {
namespace {

using test::messageOf;
using test::sampleDeck;
using test::sampleText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(DeckOverrides, ReplaceAddAndIndex) {
  const Deck deck =
      sampleDeck({"time.end=1 ms", "mesh.z.0.cells=11", "mesh.z[1].cells=31", "mesh.z.2={to: 9 mm, cells: 4}",
                  "boundaries.coflow.type=inlet", "gravity=[0, 0, 0]", "time.end=2 ms"});
  EXPECT_DOUBLE_EQ(deck.quantity("time.end"), 2e-3);
  EXPECT_EQ(deck.integer("mesh.z[0].cells"), 11);
  EXPECT_EQ(deck.integer("mesh.z[1].cells"), 31);
  EXPECT_EQ(deck.integer("mesh.z[2].cells"), 4);
  EXPECT_THAT(deck.children("boundaries"), ElementsAre("fuel", "oxidiser", "outside", "coflow"));
  EXPECT_THAT(deck.quantities("gravity"), ElementsAre(0.0, 0.0, 0.0));
}

TEST(DeckOverrides, ReplaceWholeSections) {
  const Deck deck = sampleDeck({"boundaries.fuel={type: wall}"});
  EXPECT_EQ(deck.choice("boundaries.fuel.type"), "wall");
  EXPECT_FALSE(deck.has("boundaries.fuel.velocity"));
}

// A shell takes the quotes around the whole; what is left is a map to YAML, or nothing at all.
TEST(DeckOverrides, TextsWithColonsNeedNoQuotesOfTheirOwn) {
  for (const char* text : {"H2: 2, O2: 1", "H2: 1", "'a(1,3)': 1"})
    EXPECT_EQ(sampleDeck({std::string("mechanism=") + text}).string("mechanism"), text);
  EXPECT_EQ(sampleDeck({"mechanism=\"H2: 2, O2: 1\""}).string("mechanism"), "H2: 2, O2: 1");
}

TEST(DeckOverrides, MapsAreNoTexts) {
  EXPECT_THAT(messageOf(sampleText, {"mechanism={H2: 1}"}), HasSubstr("mechanism: expected a text, found a map"));
  EXPECT_THAT(messageOf(sampleText, {"seed=H2: 2, O2: 1"}),
              HasSubstr("seed: expected an integer, found 'H2: 2, O2: 1'"));
}

TEST(DeckOverrides, ErrorsPointIntoTheOverride) {
  EXPECT_EQ(messageOf(sampleText, {"boundaries.fuel.velocity=20 cm"}),
            "--set boundaries.fuel.velocity=20 cm: boundaries.fuel.velocity: expected a velocity (for instance "
            "'20 cm/s'), found '20 cm', a length\n"
            " --set | boundaries.fuel.velocity=20 cm\n"
            "       |                          ^~~~~");
  EXPECT_THAT(messageOf(sampleText, {"seed=1", "tiem.end=3"}),
              testing::AllOf(StartsWith("--set tiem.end=3: tiem: unknown key 'tiem'; did you mean 'time'?")));
}

TEST(DeckOverrides, MalformedOnesAreRefused) {
  EXPECT_THAT(messageOf(sampleText, {"seed"}), HasSubstr("expected 'key=value'"));
  EXPECT_THAT(messageOf(sampleText, {"=3"}), HasSubstr("expected 'key=value'"));
  EXPECT_THAT(messageOf(sampleText, {"a..b=3"}), HasSubstr("a part of the key has no name"));
  EXPECT_THAT(messageOf(sampleText, {"mesh.z.7.cells=3"}), HasSubstr("'7' is not an item of this list"));
  EXPECT_THAT(messageOf(sampleText, {"mesh.z.first.cells=3"}), HasSubstr("'first' is not an item of this list"));
  EXPECT_THAT(messageOf(sampleText, {"problem.x=3"}), HasSubstr("what is above it is '"));
  EXPECT_THAT(messageOf(sampleText, {"seed=[1"}), HasSubstr("this is not YAML"));
  EXPECT_THAT(messageOf(sampleText, {"seed="}), HasSubstr("seed: expected an integer, found nothing"));
}

}  // namespace
}  // namespace lampblack::io
