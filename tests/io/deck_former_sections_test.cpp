// Sections of former versions: their keys are read where they stand now, with a note for each section.
#include <stdexcept>

#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack::io {
namespace {

using test::deckOf;
using test::refusalOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

DeckSchema schema() {
  DeckSchema made;
  made.section("dust", Presence::optional, "Dust.")
      .add(integerKey("dust.count", "Number.").byDefault("1"))
      .add(numberKey("dust.rate", "Rate.").optional().formerly("speed"))
      .add(numberKey("dust.box.width", "Width.").optional())
      .add(numberKey("dust.box.height", "Height.").optional())
      .add(numberKey("dust.modes[].size", "Size."))
      .add(stringKey("wall.kind", "Wall.").byDefault("none"));
  made.formerly({{{"ash", "dust"}, {"ash.fraction", "dust.rate"}, {"ash.wall", "wall.kind"}, {"smoke", "dust"}},
                 [](const DeckSource&, DeckNode& root, std::vector<std::string>&) {
                   return root.child("smoke") == nullptr ? std::vector<std::string>{}
                                                         : std::vector<std::string>{"with smoke"};
                 }});
  return made;
}

TEST(FormerSections, KeysAreReadWhereTheyStandNow) {
  const Deck deck = deckOf(schema(), "ash:\n  count: 7\n  fraction: 0.5\n  wall: brick\nsmoke: {box: {width: 2}}\n");
  EXPECT_EQ(deck.integer("dust.count"), 7);
  EXPECT_EQ(deck.number("dust.rate"), 0.5);
  EXPECT_EQ(deck.string("wall.kind"), "brick");
  EXPECT_EQ(deck.number("dust.box.width"), 2);
  EXPECT_FALSE(deck.has("ash"));
  EXPECT_THAT(
      deck.notes(),
      ElementsAre(
          "deck.yaml:1: the keys of 'ash' stand in 'dust' since version 0.2; write them there, 'ash.fraction' "
          "as 'dust.rate', 'ash.wall' as 'wall.kind', with smoke, as version 0.3 does not read the old one",
          "deck.yaml:5: the keys of 'smoke' stand in 'dust' since version 0.2; write them there, as version 0.3 "
          "does not read the old one"));
  EXPECT_THAT(deckOf(schema(), deck.resolved()).notes(), IsEmpty());
}

TEST(FormerSections, AreThoseOfASchemaThatIsAdded) {
  DeckSchema whole;
  whole.add(booleanKey("other", "Something else.").byDefault("true"));
  EXPECT_EQ(whole.add(schema()).formerSections().table.size(), 4U);
  EXPECT_EQ(whole.add(DeckSchema()).formerSections().table.size(), 4U);
}

TEST(FormerSections, AnEmptyOneIsThere) {
  EXPECT_TRUE(deckOf(schema(), "ash:\n").has("dust.count"));
  EXPECT_FALSE(deckOf(schema(), "wall: {kind: brick}\n").has("dust.count"));
}

TEST(FormerSections, FormerNamesOfKeysHoldInThem) {
  const Deck deck = deckOf(schema(), "ash: {speed: 3}\n");
  EXPECT_EQ(deck.number("dust.rate"), 3);
  EXPECT_EQ(deck.notes().size(), 2u);
}

TEST(FormerSections, SettingsAreMovedAndTheLaterHolds) {
  const std::string text = "dust: {count: 2, box: {width: 1, height: 3}}\n";
  EXPECT_EQ(deckOf(schema(), text, {"ash.count=5"}).integer("dust.count"), 5);
  EXPECT_EQ(deckOf(schema(), text, {"dust.count=5", "ash.count=6"}).integer("dust.count"), 6);
  EXPECT_EQ(deckOf(schema(), text, {"ash.count=6", "dust.count=5"}).integer("dust.count"), 5);
  const Deck box = deckOf(schema(), text, {"smoke.box.width=4"});
  EXPECT_EQ(box.number("dust.box.width"), 4);
  EXPECT_EQ(box.number("dust.box.height"), 3);
  const Deck modes = deckOf(schema(), "dust: {modes: [{size: 1}, {size: 5}]}\n", {"ash.modes[1].size=2"});
  EXPECT_EQ(modes.number("dust.modes[0].size"), 1);
  EXPECT_EQ(modes.number("dust.modes[1].size"), 2);
  EXPECT_THAT(deckOf(schema(), text, {"ash.count=5"}).notes(),
              ElementsAre(HasSubstr("--set ash.count: the keys of 'ash'")));
}

TEST(FormerSections, BothNamesInOneDeckAreAnError) {
  EXPECT_THAT(
      refusalOf(schema(), "ash: {count: 1}\ndust: {count: 2}\n"),
      HasSubstr("deck.yaml:1:7: ash.count: this is 'dust.count' now, which is given too; leave 'ash.count' out"));
  EXPECT_THAT(refusalOf(schema(), "ash: {count: 1}\nsmoke: {count: 2}\n"), HasSubstr("leave 'smoke.count' out"));
  EXPECT_THAT(refusalOf(schema(), "ash: {box: {width: 1}}\ndust: {box: {width: 2}}\n"),
              HasSubstr("'ash.box.width' out"));
  EXPECT_THAT(refusalOf(schema(), "", {"ash={fraction: 1, count: 1}", "dust.x=1"}), HasSubstr("the deck is empty"));
}

TEST(FormerSections, MistakesStandWhereTheyWereMade) {
  EXPECT_THAT(refusalOf(schema(), "wall: {}\nash: {cuont: 1}\n"),
              HasSubstr("deck.yaml:2:7: dust.cuont: unknown key 'cuont'"));
  EXPECT_THAT(refusalOf(schema(), "ash: {count: one}\n"),
              HasSubstr("note: deck.yaml:1: the keys of 'ash' stand in 'dust'"));
  EXPECT_THAT(refusalOf(schema(), "ash: 3\n"), HasSubstr("ash: expected a map of keys, found '3'"));
  EXPECT_THAT(refusalOf(schema(), "dust: 3\nash: {count: 1}\n"), HasSubstr("dust: expected a map of keys, found '3'"));
}

TEST(FormerSections, StandInTheJsonSchema) {
  EXPECT_THAT(jsonSchema(schema()), HasSubstr("Its keys stand in 'dust'; version 0.3 does not read it."));
}

}  // namespace
}  // namespace lampblack::io
