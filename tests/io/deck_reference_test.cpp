#include <stdexcept>

#include "core/modules.hpp"
#include "core/nearest_name.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack::io {
namespace {

using testing::HasSubstr;

TEST(DeckReference, HasEachKeyWithTypeRangeDefaultAndMeaning) {
  const DeckSchema schema = test::sampleSchema();
  const std::string page = markdownReference(schema);
  EXPECT_THAT(page,
              HasSubstr("| `boundaries.*.temperature` | temperature (K), above 0 K | `25 degC` | Temperature. |"));
  EXPECT_THAT(page,
              HasSubstr("| `mesh.z[].cells` | integer, from 1 to 100000 | **required** | Cells of the segment. |"));
  EXPECT_THAT(page, HasSubstr("| `problem` | `flow`, `reactor`, `flame1d` | **required** | What is computed. |"));
  EXPECT_THAT(page, HasSubstr("## `particles`\n\nOptional. Particles, where wanted."));
  for (const DeckKey& key : schema.keys()) EXPECT_THAT(page, HasSubstr("`" + key.path + "`"));
}

TEST(DeckReference, JsonSchemaIsStrictAndKnowsWildcardsAndLists) {
  const std::string json = jsonSchema(test::sampleSchema());
  EXPECT_THAT(json, HasSubstr("\"additionalProperties\": false"));
  EXPECT_THAT(json, HasSubstr("\"enum\": [\n"));
  EXPECT_THAT(json, HasSubstr("\"exclusiveMinimum\": 0"));
  EXPECT_THAT(json, HasSubstr("\"minItems\": 3"));
}

// Two kinds of deck: a part of the page each, and a condition each in the JSON schema; a deck is read by its own kind.
TEST(DeckKinds, AreChosenByTheirKey) {
  DeckSchema one, two;
  one.add(choiceKey("problem", {"one"}, "Kind.")).add(integerKey("cells", "Cells."));
  two.add(choiceKey("problem", {"two"}, "Kind.")).add(stringKey("name", "Name."));
  const DeckKinds kinds{"problem", {{"one", "The first.", one}, {"two", "The second.", two}}};
  const std::string page = markdownReference(kinds);
  EXPECT_THAT(page, HasSubstr("## problem: one\n\nThe first.\n\n### Top level"));
  EXPECT_THAT(page, HasSubstr("- [`problem: two`](#problem-two): The second."));
  EXPECT_THAT(jsonSchema(kinds), HasSubstr("\"const\": \"two\""));
  EXPECT_THAT(jsonSchema(kinds), HasSubstr("\"required\": [\n        \"base\"\n      ]"));
  EXPECT_EQ(Deck::parse("problem: two\nname: a", "deck.yaml", {}, kinds).string("name"), "a");
  EXPECT_EQ(Deck::parse("problem: two\ncells: 3", "deck.yaml", {"problem=one"}, kinds).integer("cells"), 3);
  EXPECT_THROW((void)Deck::parse("problem: two\ncells: 3", "deck.yaml", {}, kinds), InputError);
  EXPECT_THROW((void)Deck::parse("problem: three", "deck.yaml", {}, kinds), InputError);
  EXPECT_THROW((void)Deck::parse("problem: [one]", "deck.yaml", {}, kinds), InputError);
  EXPECT_THROW((void)Deck::parse("cells: 3", "deck.yaml", {}, kinds), InputError);
}

TEST(DeckSchema, RefusesContradictionsOfItsOwn) {
  DeckSchema schema = test::sampleSchema();
  EXPECT_THROW(schema.add(integerKey("seed", "Again.")), std::logic_error);
  EXPECT_THROW(schema.add(integerKey("seed.low", "Below a key.")), std::logic_error);
  EXPECT_THROW(schema.add(integerKey("mesh", "Above keys.")), std::logic_error);
  EXPECT_THROW(schema.add(choiceKey("none", {}, "No choices.")), std::logic_error);
  EXPECT_THROW(schema.section("mesh", Presence::optional, "Again."), std::logic_error);
  schema.add(quantityKey("bad", units::length, "Bad default.").byDefault("3 s"));
  EXPECT_THROW((void)Deck::parse(test::sampleText, "deck.yaml", {}, schema), std::logic_error);
}

TEST(NearestName, IsNearEnoughToBeMeant) {
  EXPECT_EQ(editDistance("velocty", "velocity"), 1U);
  EXPECT_EQ(editDistance("tiem", "time"), 1U);
  EXPECT_EQ(editDistance("Pressure", "pressure"), 0U);
  EXPECT_EQ(nearestName("temprature", {"pressure", "temperature"}), "temperature");
  EXPECT_EQ(nearestName("banana", {"pressure", "temperature"}), "");
  EXPECT_EQ(nearestName("x", {"y", "z"}), "");
  EXPECT_EQ(didYouMean("c2h4", {"C2H2", "C2H4"}), "; did you mean 'C2H4'?");
}

}  // namespace
}  // namespace lampblack::io
