// Former names of keys and choices: read as the present ones, with a note for each that says what to write.
#include "io/deck_former_names.hpp"

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
  made.add(choiceKey("problem", {"gas"}, "Kind.").formerly("air", "gas"))
      .add(quantityKey("particles.frozen_gas", units::time, "Time.").optional().formerly("hold_gas").formerly("hold"))
      .add(integerKey("particles.count", "Number.").byDefault("1"))
      .add(choiceKey("methods.*.moments", {"M0", "M1"}, "Moments.")
               .list()
               .optional()
               .formerly("claims")
               .formerly("m1", "M1"))
      .add(integerKey("points[].cells", "Cells.").optional().formerly("segments"))
      .add(numberKey("points[].ratio", "Ratio.").optional().onlyWith("problem", {"gas"}));
  return made;
}

TEST(FormerNames, ADeckWithPresentNamesHasNoNotes) {
  EXPECT_THAT(deckOf(schema(), "problem: gas\nparticles: {frozen_gas: 1 s}\n").notes(), IsEmpty());
}

TEST(FormerNames, AreReadAsThePresentOnesWithANoteEach) {
  const Deck deck = deckOf(schema(),
                           "problem: air\n"
                           "particles:\n"
                           "  hold_gas: 2 ms\n"
                           "methods:\n"
                           "  one: {claims: [M0, m1]}\n"
                           "points:\n"
                           "  - {segments: 7, ratio: 2}\n");
  EXPECT_EQ(deck.choice("problem"), "gas");
  EXPECT_EQ(deck.quantity("particles.frozen_gas"), 0.002);
  EXPECT_TRUE(deck.isGiven("particles.frozen_gas"));
  EXPECT_FALSE(deck.has("particles.hold_gas"));
  EXPECT_EQ(deck.strings("methods.one.moments"), (std::vector<std::string>{"M0", "M1"}));
  EXPECT_EQ(deck.integer("points[0].cells"), 7);
  const auto& notes = deck.notes();
  ASSERT_EQ(notes.size(), 5u);
  EXPECT_EQ(
      notes[0],
      "deck.yaml:1: 'problem: air' is called 'problem: gas' since version 0.2; write the new name, as version 0.3 "
      "does not read the old one");
  EXPECT_THAT(notes[1], HasSubstr("deck.yaml:3: particles.hold_gas is called particles.frozen_gas since version 0.2"));
  EXPECT_THAT(notes[2], HasSubstr("deck.yaml:5: methods.one.claims is called methods.one.moments"));
  EXPECT_THAT(notes[3], HasSubstr("deck.yaml:5: 'methods.one.moments: m1' is called 'methods.one.moments: M1'"));
  EXPECT_THAT(notes[4], HasSubstr("deck.yaml:7: points[0].segments is called points[0].cells"));
}

TEST(FormerNames, TheResolvedDeckHasThePresentNames) {
  const Deck old = deckOf(schema(), "problem: air\nparticles: {hold: 1 s}\n"),
             present = deckOf(schema(), "problem: gas\nparticles: {frozen_gas: 1 s}\n");
  EXPECT_EQ(old.resolved(), present.resolved());
  EXPECT_EQ(old.resolvedJson(), present.resolvedJson());
  EXPECT_THAT(Deck::parse(old.resolved(), "again.yaml", {}, schema()).notes(), IsEmpty());
}

TEST(FormerNames, MayStandInOverrides) {
  const Deck deck = deckOf(schema(), "problem: gas\n", {"particles.hold_gas=3 s", "methods.a={claims: [M1]}"});
  EXPECT_EQ(deck.quantity("particles.frozen_gas"), 3);
  EXPECT_EQ(deck.strings("methods.a.moments"), std::vector<std::string>{"M1"});
  EXPECT_THAT(deck.notes(),
              ElementsAre(HasSubstr("--set particles.hold_gas: particles.hold_gas is called particles.frozen_gas"),
                          HasSubstr("--set methods.a: methods.a.claims is called methods.a.moments")));
}

// As of one name given twice: what comes later holds, whichever name each has.
TEST(FormerNames, AnOverrideHoldsOverTheOtherName) {
  const std::string old = "problem: gas\nparticles: {count: 2, hold_gas: 1 s}\n",
                    present = "problem: gas\nparticles: {frozen_gas: 1 s, count: 2}\n";
  for (const auto& [text, overrides, value] :
       {std::tuple{old, std::vector<std::string>{"particles.frozen_gas=2 s"}, 2.0},
        std::tuple{present, std::vector<std::string>{"particles.hold_gas=2 s"}, 2.0},
        std::tuple{present, std::vector<std::string>{"particles.hold_gas=2 s", "particles.frozen_gas=3 s"}, 3.0},
        std::tuple{old, std::vector<std::string>{"particles.frozen_gas=2 s", "particles.hold_gas=3 s"}, 3.0}}) {
    const Deck deck = deckOf(schema(), text, overrides);
    EXPECT_EQ(deck.quantity("particles.frozen_gas"), value) << text;
    EXPECT_EQ(deck.integer("particles.count"), 2);
    EXPECT_EQ(deck.notes().size(), 1u);
  }
}

TEST(FormerNames, BothNamesInOneDeckAreAnError) {
  const std::string both = refusalOf(schema(), "problem: gas\nparticles:\n  frozen_gas: 1 s\n  hold_gas: 2 s\n");
  EXPECT_THAT(both,
              HasSubstr("deck.yaml:4:3: particles.hold_gas: this is the former name of 'frozen_gas', which is given "
                        "too; leave 'hold_gas' out"));
  EXPECT_THAT(both, HasSubstr("hold_gas: 2 s"));
  EXPECT_THAT(refusalOf(schema(), "problem: gas\n", {"particles={hold_gas: 1 s, frozen_gas: 2 s}"}),
              HasSubstr("leave 'hold_gas' out"));
  EXPECT_THAT(refusalOf(schema(), "problem: gas\nparticles: {hold: 1 s, hold_gas: 2 s}\n"),
              HasSubstr("former name of 'frozen_gas'"));
}

TEST(FormerNames, MistakesNameThePresentKey) {
  EXPECT_THAT(refusalOf(schema(), "problem: gas\nparticles: {hold_gas: 3 m}\n"), HasSubstr("particles.frozen_gas: "));
  EXPECT_THAT(refusalOf(schema(), "problem: gas\nparticles: {hold_gsa: 3 s}\n"),
              HasSubstr("did you mean 'frozen_gas'?"));
  EXPECT_THAT(refusalOf(schema(), "problem: gas\nhold_gas: 3 s\n"), HasSubstr("did you mean 'particles.frozen_gas'?"));
  EXPECT_THAT(refusalOf(schema(), "problem: air2\n"), HasSubstr("expected one of: gas"));
}

TEST(FormerNames, OfAKindOfDecksChooseTheKind) {
  DeckSchema other;
  other.add(choiceKey("problem", {"flow"}, "Kind."));
  const DeckKinds kinds{"problem", {{"flow", "A flow.", other}, {"gas", "A gas.", schema()}}};
  const Deck deck = Deck::parse("problem: air\nparticles: {count: 4}\n", "deck.yaml", {}, kinds);
  EXPECT_EQ(deck.choice("problem"), "gas");
  EXPECT_EQ(deck.integer("particles.count"), 4);
  EXPECT_EQ(deck.notes().size(), 1u);
  EXPECT_EQ(Deck::parse("problem: flow\n", "deck.yaml", {"problem=air"}, kinds).choice("problem"), "gas");
  EXPECT_THAT(jsonSchema(kinds), HasSubstr("\"air\""));
}

TEST(FormerNames, StandInTheReferenceAndInTheJsonSchema) {
  const std::string page = markdownReference(schema()), json = jsonSchema(schema());
  EXPECT_THAT(
      page,
      HasSubstr("| Time. `hold_gas` is a former name of this key; `hold` is a former name of this key; version 0.3 "
                "does not read former names. |"));
  EXPECT_THAT(page, HasSubstr("`air` is a former name of `gas`; version 0.3 does not read former names."));
  EXPECT_THAT(page, Not(HasSubstr("| `particles.hold_gas` |")));
  EXPECT_THAT(json, HasSubstr("\"hold_gas\": {"));
  EXPECT_THAT(json, HasSubstr("\"deprecated\": true"));
  EXPECT_THAT(json, HasSubstr("\"x-former\": [\n"));
}

TEST(FormerNames, ThatAreOtherKeysAreAMistakeOfTheSchema) {
  DeckSchema made;
  made.add(integerKey("a.b", "B."));
  EXPECT_THROW(made.add(integerKey("a.c", "C.").formerly("b")), std::logic_error);
  made.add(integerKey("a.d", "D.").formerly("e"));
  EXPECT_THROW(made.add(integerKey("a.e", "E.")), std::logic_error);
  made.add(integerKey("f.b", "Another section.").formerly("d"));
}

}  // namespace
}  // namespace lampblack::io
