// Keys and sections that count only with some choices of another key: refused where they are said in vain, left out of
// the resolved deck where only their defaults stand, told by the reference page.
#include <stdexcept>

#include "core/modules.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

DeckSchema schema() {
  DeckSchema made;
  made.add(choiceKey("flame.type", {"free", "wall", "counterflow"}, "Kind.").byDefault("free"))
      .add(choiceKey("flame.nozzles", {"plug", "potential"}, "Nozzles.")
               .byDefault("plug")
               .onlyWith("flame.type", {"wall", "counterflow"}))
      .add(numberKey("flame.strain", "Strain.").optional().onlyWith("flame.nozzles", {"potential"}))
      .section("left", Presence::optional, "Stream.", {{"flame.type", {"counterflow"}}})
      .add(numberKey("left.temperature", "Of the stream.").byDefault("300"))
      .add(choiceKey("walls.*.type", {"inlet", "wall"}, "Kind."))
      .add(numberKey("walls.*.speed", "Speed.").optional().onlyWith("walls.*.type", {"inlet"}))
      .add(booleanKey("steps[].fixed", "Fixed.").byDefault("false"))
      .add(numberKey("steps[].size", "Size.").byDefault("1").onlyWith("steps[].fixed", {"true"}))
      .add(choiceKey("soot.model", {"none", "sections"}, "Soot."))
      .section("soot", Presence::optional, "Soot.")
      .section("paths", Presence::optional, "Paths.", {{"soot.model", {"sections"}}})
      .add(numberKey("paths.count", "Number.").byDefault("1"));
  return made;
}

Deck read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Deck::parse(text, "deck.yaml", overrides, schema());
}

std::string messageOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(DeckConditions, AKeyOfAnotherChoiceIsRefusedWhereItStands) {
  EXPECT_EQ(
      messageOf("flame:\n  type: wall\n  strain: 3\n"),
      "deck.yaml:3:3: flame.strain: 'flame.nozzles: plug' does not have this; leave it out, or choose: potential\n"
      "     3 |   strain: 3\n"
      "       |   ^~~~~~");
  EXPECT_EQ(messageOf("flame: {type: wall, nozzles: potential, strain: 3}"), "");
}

TEST(DeckConditions, SoIsTheDefaultSaidAloud) {
  EXPECT_THAT(messageOf("flame:\n  nozzles: plug\n"),
              AllOf(StartsWith("deck.yaml:2:3: flame.nozzles: 'flame.type: free'"), HasSubstr("wall, counterflow")));
}

TEST(DeckConditions, AnOverrideOfTheChoiceLeavesTheKeyInVain) {
  const std::string text = "flame:\n  type: counterflow\nleft: {temperature: 400}\n";
  EXPECT_EQ(messageOf(text), "");
  EXPECT_THAT(messageOf(text, {"flame.type=wall"}), StartsWith("deck.yaml:3:1: left: 'flame.type: wall' does not"));
}

TEST(DeckConditions, ASectionOfAnotherChoiceIsRefusedEvenEmpty) {
  EXPECT_THAT(messageOf("left:\n"), HasSubstr("left: 'flame.type: free' does not have this"));
}

TEST(DeckConditions, NamesAndItemsAreTheirOwn) {
  EXPECT_EQ(messageOf("walls: {a: {type: inlet, speed: 1}, b: {type: wall}}"), "");
  EXPECT_THAT(messageOf("walls:\n  a: {type: inlet}\n  b: {type: wall, speed: 1}\n"),
              StartsWith("deck.yaml:3:19: walls.b.speed: 'walls.b.type: wall' does not have this"));
  EXPECT_EQ(messageOf("steps: [{fixed: true, size: 2}, {fixed: false}]"), "");
  EXPECT_THAT(messageOf("steps: [{fixed: true, size: 2}, {size: 2}]"),
              HasSubstr("steps[1].size: 'steps[1].fixed: false' does not have this; leave it out, or choose: true"));
}

TEST(DeckConditions, AChoiceThatIsNotThereIsNamed) {
  EXPECT_THAT(messageOf("paths: {count: 3}"),
              HasSubstr("paths: this counts only with 'soot.model'; leave it out, or choose: sections"));
  EXPECT_EQ(messageOf("paths: {count: 3}\nsoot: {model: sections}"), "");
}

// Its own refusals must not make the resolved deck, which is written with every result, unreadable.
TEST(DeckConditions, DefaultsThatDoNotCountAreNotResolved) {
  const Deck deck = read("walls: {b: {type: wall}}\nsteps: [{fixed: false}]");
  EXPECT_EQ(deck.choice("flame.nozzles"), "plug");
  EXPECT_THAT(deck.resolved(), AllOf(HasSubstr("type: free"), Not(HasSubstr("nozzles")), Not(HasSubstr("size"))));
  EXPECT_THAT(deck.resolvedJson(), Not(HasSubstr("nozzles")));
  EXPECT_EQ(read(deck.resolved()).resolved(), deck.resolved());
  EXPECT_THAT(read("flame: {type: wall}").resolved(), HasSubstr("nozzles: plug"));
}

TEST(DeckConditions, AreToldByReferenceAndJsonSchema) {
  EXPECT_THAT(markdownReference(schema()),
              AllOf(HasSubstr("Nozzles. Only with `flame.type`: `wall`, `counterflow`. |"),
                    HasSubstr("Optional. Stream. Only with `flame.type`: `counterflow`.")));
  EXPECT_THAT(jsonSchema(schema()), HasSubstr("Nozzles. Only with `flame.type`: `wall`, `counterflow`. Expected:"));
}

TEST(DeckConditions, OnWhatIsNotDeclaredAreMistakesOfTheSchema) {
  DeckSchema unknownKey = schema(), unknownChoice = schema();
  unknownKey.add(numberKey("a", "A.").optional().onlyWith("flame.tipe", {"free"}));
  unknownChoice.add(numberKey("a", "A.").optional().onlyWith("flame.type", {"fre"}));
  EXPECT_THROW((void)unknownKey.tree(), std::logic_error);
  EXPECT_THROW((void)unknownChoice.tree(), std::logic_error);
}

}  // namespace
}  // namespace lampblack::io
