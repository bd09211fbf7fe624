#include <cmath>
#include <stdexcept>

#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"
#include "tests/scratch.hpp"

namespace lampblack::io {
namespace {

using test::sampleDeck;
using testing::ElementsAre;

TEST(Deck, GivesValuesInSi) {
  const Deck deck = sampleDeck();
  EXPECT_EQ(deck.choice("problem"), "flow");
  EXPECT_EQ(deck.string("mechanism"), "../mechanisms/abf.yaml");
  EXPECT_DOUBLE_EQ(deck.quantity("mesh.z[0].to"), 2e-3);
  EXPECT_EQ(deck.integer("mesh.z[1].cells"), 30);
  EXPECT_DOUBLE_EQ(deck.quantity("boundaries.fuel.velocity"), 0.2);
  EXPECT_DOUBLE_EQ(deck.quantity("boundaries.oxidiser.velocity"), 0.2);
  EXPECT_DOUBLE_EQ(deck.number("boundaries.oxidiser.composition.O2"), 0.25);
  EXPECT_DOUBLE_EQ(deck.quantity("time.end"), 0.04);
}

TEST(Deck, FillsInDefaults) {
  const Deck deck = sampleDeck();
  EXPECT_DOUBLE_EQ(deck.quantity("pressure"), 101325.0);
  EXPECT_DOUBLE_EQ(deck.quantity("boundaries.fuel.temperature"), 298.15);
  EXPECT_TRUE(deck.boolean("time.adaptive"));
  EXPECT_THAT(deck.quantities("gravity"), ElementsAre(0.0, 0.0, -9.81));
  EXPECT_THAT(deck.strings("output.fields"), ElementsAre("temperature", "velocity"));
  EXPECT_TRUE(deck.has("pressure"));
  EXPECT_FALSE(deck.isGiven("pressure"));
  EXPECT_TRUE(deck.isGiven("time.end"));
}

TEST(Deck, ListsNamesInTheOrderOfTheFile) {
  const Deck deck = sampleDeck();
  EXPECT_THAT(deck.children("boundaries"), ElementsAre("fuel", "oxidiser", "outside"));
  EXPECT_THAT(deck.children("boundaries.oxidiser.composition"), ElementsAre("O2", "N2"));
  EXPECT_TRUE(deck.children("boundaries.outside.composition").empty());
  EXPECT_EQ(deck.size("mesh.z"), 2U);
  EXPECT_EQ(deck.size("mesh.r"), 0U);
}

TEST(Deck, SkipsAnOptionalSectionThatIsAbsentWithItsRequiredKeys) {
  const Deck deck = sampleDeck();
  EXPECT_FALSE(deck.has("particles"));
  EXPECT_FALSE(deck.has("particles.sites"));
  EXPECT_FALSE(deck.optionalQuantity("particles.sites").has_value());
  const Deck with = sampleDeck({"particles.count=64"});
  EXPECT_TRUE(with.has("particles"));
  EXPECT_DOUBLE_EQ(with.quantity("particles.sites"), 2.3e19);
}

TEST(Deck, GivesOptionalKeysAsOptionals) {
  const Deck deck = sampleDeck();
  EXPECT_EQ(deck.optionalQuantity("boundaries.fuel.velocity"), 0.2);
  EXPECT_EQ(deck.optionalQuantity("boundaries.outside.velocity"), std::nullopt);
}

TEST(Deck, TreatsAWrongQuestionAsAMistakeOfTheCaller) {
  const Deck deck = sampleDeck();
  EXPECT_THROW((void)deck.quantity("boundaries.outside.velocity"), std::logic_error);
  EXPECT_THROW((void)deck.quantity("presure"), std::logic_error);
  EXPECT_THROW((void)deck.optionalQuantity("presure"), std::logic_error);
  EXPECT_THROW((void)deck.number("pressure"), std::logic_error);
  EXPECT_THROW((void)deck.quantity("gravity"), std::logic_error);
}

TEST(Deck, ResolvedIsADeckThatReadsBackTheSame) {
  const Deck deck = sampleDeck({"particles.count=64", "mechanism='a b: c'"});
  const std::string resolved = deck.resolved();
  const Deck again = sampleDeck({}, resolved);
  EXPECT_EQ(again.resolved(), resolved);
  EXPECT_EQ(again.string("mechanism"), "a b: c");
  EXPECT_EQ(again.quantity("boundaries.fuel.temperature"), deck.quantity("boundaries.fuel.temperature"));
  EXPECT_TRUE(again.isGiven("pressure"));
  EXPECT_THAT(resolved, testing::HasSubstr("pressure: 101325 Pa\n"));
}

TEST(Deck, AZeroWithASignReadsBackTheSame) {
  const std::string resolved = sampleDeck({"gravity=[-0, -0 m/s^2, 1 m/s^2]"}).resolved();
  EXPECT_EQ(sampleDeck({}, resolved).resolved(), resolved);
}

TEST(Deck, ResolvedKeepsSectionsThatAreThereAndEmpty) {
  const Deck deck = sampleDeck({"mesh={z: []}", "boundaries.fuel.composition={}"});
  const Deck again = sampleDeck({}, deck.resolved());
  EXPECT_TRUE(again.has("mesh.z"));
  EXPECT_TRUE(again.has("boundaries.fuel.composition"));
  EXPECT_EQ(again.resolved(), deck.resolved());
}

TEST(Deck, ResolvedJsonHasSiNumbers) {
  const std::string json = sampleDeck().resolvedJson();
  EXPECT_THAT(json, testing::HasSubstr("\"pressure\": 101325"));
  EXPECT_THAT(json, testing::HasSubstr("\"velocity\": 0.2"));
  EXPECT_THAT(json, testing::HasSubstr("\"adaptive\": true"));
}

TEST(Deck, ResolvesPathsFromItsOwnFolder) {
  const Deck deck = sampleDeck();
  EXPECT_EQ(deck.resolvePath("data.csv"), std::filesystem::path("cases/sample/data.csv"));
  EXPECT_EQ(deck.resolvePath("/tmp/data.csv"), std::filesystem::path("/tmp/data.csv"));
}

TEST(Deck, PointsOtherPeoplesErrorsAtTheRightPlace) {
  const Deck deck = sampleDeck();
  EXPECT_STREQ(deck.error("boundaries.fuel.composition.C2H4", "the mechanism has no species 'C2H4'").what(),
               "cases/sample/deck.yaml:12:25: boundaries.fuel.composition.C2H4: the mechanism has no species 'C2H4'\n"
               "    12 |     composition: {C2H4: 1.0}\n"
               "       |                         ^~~");
  // A key that stands nowhere is looked for where it would be.
  EXPECT_THAT(deck.error("boundaries.outside.temperature", "too hot").what(),
              testing::StartsWith("cases/sample/deck.yaml:20:3: boundaries.outside.temperature: too hot"));
  EXPECT_THAT(deck.error("pressure", "too high").what(),
              testing::StartsWith("cases/sample/deck.yaml: pressure: too high"));
}

TEST(Deck, IsReadFromAFile) {
  const test::ScratchFolder folder;
  EXPECT_EQ(Deck::load(folder.file("deck.yaml", test::sampleText), {"seed=9"}, test::sampleSchema()).integer("seed"),
            9);
}

TEST(Deck, TakesKeysOfSectionsLeftEmpty) {
  const Deck deck = sampleDeck({}, test::sampleText + "output:\n");
  EXPECT_THAT(deck.strings("output.fields"), ElementsAre("temperature", "velocity"));
}

TEST(Deck, IntegersAreGivenInTheTypeTheyAreUsedIn) {
  const auto seed = [](const std::string& text) { return test::sampleDeck({"seed=" + text}); };
  EXPECT_EQ(seed("2147483647").integer<int>("seed"), 2147483647);
  EXPECT_EQ(seed("4294967297").integer("seed"), 4294967297);
  EXPECT_EQ(seed("4294967297").integer<std::uint64_t>("seed"), 4294967297U);
  EXPECT_EQ(test::sampleDeck().optionalInteger<int>("particles.count"), std::nullopt);
  const auto message = [&](const std::string& text, auto read) -> std::string {
    try {
      read(seed(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  // Cut to 32 bits this would be 1.
  EXPECT_THAT(
      message("4294967297", [](const Deck& deck) { (void)deck.integer<int>("seed"); }),
      testing::HasSubstr("--set seed=4294967297: seed: expected an integer of at most 2147483647, found 4294967297"));
  EXPECT_THAT(message("4294967297", [](const Deck& deck) { (void)deck.optionalInteger<int>("seed"); }),
              testing::HasSubstr("at most 2147483647"));
  EXPECT_THAT(message("-1", [](const Deck& deck) { (void)deck.integer<std::size_t>("seed"); }),
              testing::HasSubstr("expected an integer of at least 0, found -1"));
}

}  // namespace
}  // namespace lampblack::io
