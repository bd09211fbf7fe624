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
  EXPECT_EQ(messageOf("flame:\n  type: wall\n  strain: 3\n"),
            "deck.yaml:3:3: flame.strain: 'flame.nozzles: plug' does not have this; leave it out, or choose: potential "
            "(plug is the default)\n"
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
  EXPECT_THAT(messageOf(text, {"flame.type=wall"}),
              AllOf(StartsWith("deck.yaml:3:1: left: 'flame.type: wall' does not"), Not(HasSubstr("default"))));
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

// A section of which a deck may have one, as a map, or a list of them.
TEST(DeckConditions, ASectionMayBeAMapOrAListOfMaps) {
  DeckSchema made;
  for (const std::string at : {"start", "start[]"})
    made.add(choiceKey(at + ".shape", {"none", "equal", "wide"}, "Shape.").byDefault("none"))
        .add(quantityKey(at + ".size", units::length, "Size.").optional())
        .add(numberKey(at + ".width", "Width.").optional().onlyWith(at + ".shape", {"wide"}));
  made.section("start[]", Presence::defaulted, "Or a list.");
  const auto deckOf = [&](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return Deck::parse(text, "deck.yaml", overrides, made);
  };
  const auto problem = [&](const std::string& text) -> std::string {
    try {
      (void)deckOf(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  const Deck map = deckOf("start: {shape: wide, size: 1 mm}", {"start.width=2"});
  EXPECT_EQ(map.number("start.width"), 2);
  EXPECT_EQ(map.size("start"), 0U);
  const Deck list = deckOf("start:\n- {shape: wide, width: 3}\n- {size: 2 mm}\n", {"start[1].shape=equal"});
  ASSERT_EQ(list.size("start"), 2U);
  EXPECT_EQ(list.number("start[0].width"), 3);
  EXPECT_EQ(list.choice("start[1].shape"), "equal");
  EXPECT_EQ(list.quantity("start[1].size"), 2e-3);
  EXPECT_FALSE(list.has("start.shape")) << "no defaults beside a list";
  EXPECT_EQ(deckOf(list.resolved()).resolved(), list.resolved());
  EXPECT_EQ(deckOf(map.resolved()).resolved(), map.resolved());
  EXPECT_EQ(deckOf("{}").choice("start.shape"), "none");
  EXPECT_EQ(deckOf("start:\n").choice("start.shape"), "none");
  EXPECT_EQ(deckOf("start: []").size("start"), 0U);
  EXPECT_THAT(problem("start: wide"),
              HasSubstr("start: expected a map of keys or a list of such maps, such as {shape: wide}, found"));
  EXPECT_THAT(problem("start: [wide]"),
              HasSubstr("start[0]: expected a map of keys, such as {shape: wide}, found 'wide'"));
  EXPECT_THAT(problem("start: {shpe: wide}"), HasSubstr("did you mean 'shape'? Known here: shape, size, width\n"));
  EXPECT_THAT(problem("start: [{shape: none}, {shpe: wide}]"), HasSubstr("start[1].shpe: unknown key"));
  EXPECT_THAT(problem("start:\n- shape: wide\n- {shape: equal, width: 2}\n"),
              AllOf(StartsWith("deck.yaml:3:18: start[1].width: 'start[1].shape: equal' does not have this")));
  EXPECT_THAT(problem("start: {width: 2}"), HasSubstr("'start.shape: none' does not have this"));
  const std::string page = markdownReference(made);
  EXPECT_THAT(page, AllOf(HasSubstr("| `start.width` |"), HasSubstr("| `start[].width` |")));
  const std::string json = jsonSchema(made);
  EXPECT_THAT(json, AllOf(HasSubstr("\"anyOf\""), HasSubstr("\"array\""), Not(HasSubstr("\"[]\""))));
}

// A condition that one of several keys meets, and defaults that depend on others.
DeckSchema mixed() {
  DeckSchema part, made;
  part.add(integerKey("box.count", "Number.").byDefault("7").byDefault("8", {{"box.kind", {"paths"}}}))
      .section("box.inner", Presence::defaulted, "Inner.")
      .add(numberKey("box.inner.width", "Width.").byDefault("1"));
  made.add(choiceKey("box.kind", {"cells", "paths", "none"}, "Kind.").byDefault("none"))
      .add(choiceKey("box.of", {"soot", "silica"}, "Of.").byDefault("soot"))
      .add(part, {"box.kind", {"paths"}, {{"box.of", {"silica"}}}});
  return made;
}

Deck readMixed(const std::string& text) {
  return Deck::parse(text, "deck.yaml", {}, mixed());
}

TEST(DeckConditions, OneOfSeveralMayHold) {
  for (const char* text : {"box: {kind: paths, count: 3}", "box: {of: silica, count: 3, inner: {width: 2}}"})
    EXPECT_EQ(readMixed(text).integer("box.count"), 3) << text;
  for (const char* key : {"count: 3", "inner: {width: 2}"}) {
    std::string message;
    try {
      (void)readMixed(std::string("box: {kind: cells, ") + key + "}");
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_THAT(message, HasSubstr("'box.kind: cells' does not have this; leave it out, or choose: paths; or 'box.of': "
                                   "silica"));
  }
  EXPECT_THAT(readMixed("box: {kind: cells}").resolved(), Not(HasSubstr("count")));
  EXPECT_THAT(markdownReference(mixed()), HasSubstr("Only with `box.kind`: `paths` or `box.of`: `silica`."));
}

TEST(DeckConditions, ADefaultMayDependOnAnotherKey) {
  EXPECT_EQ(readMixed("box: {kind: paths}").integer("box.count"), 8);
  EXPECT_EQ(readMixed("box: {kind: paths, count: 2}").integer("box.count"), 2);
  EXPECT_EQ(readMixed("box: {of: silica}").integer("box.count"), 7);
  EXPECT_THAT(readMixed("box: {kind: paths}").resolved(), HasSubstr("count: 8"));
  EXPECT_THAT(markdownReference(mixed()), HasSubstr("| `7`; `8` with `box.kind`: `paths` |"));
  DeckSchema wrong;
  wrong.add(integerKey("a", "A.").byDefault("1").byDefault("2", {{"b", {"c"}}}));
  EXPECT_THROW((void)wrong.tree(), std::logic_error);
}

}  // namespace
}  // namespace lampblack::io
