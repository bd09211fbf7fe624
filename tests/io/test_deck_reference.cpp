#include <stdexcept>

#include "core/nearest_name.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack {
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
}  // namespace lampblack
