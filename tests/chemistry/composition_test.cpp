#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using ::testing::HasSubstr;

std::string messageOf(const std::string& text) {
  try {
    parseComposition(lampblack::test::hydrogen(), text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Composition, IsNormalisedToMoleFractions) {
  const auto& mechanism = lampblack::test::hydrogen();
  for (const char* text : {"H2: 2, O2: 1, N2: 5", "  H2:2 O2:1 N2:5 ", "O2: 1e0,H2 : 2.0,N2: 5"}) {
    const auto X = parseComposition(mechanism, text);
    EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("H2")], 0.25) << text;
    EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("O2")], 0.125) << text;
    EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("N2")], 0.625) << text;
    EXPECT_EQ(X[mechanism.speciesIndex("OH")], 0.0);
  }
}

// Names in any case of letters, where only one species can be meant.
TEST(Composition, NamesInAnyCase) {
  const auto& mechanism = lampblack::test::hydrogen();
  const auto X = parseComposition(mechanism, "h2: 2, O2: 1, n2: 5");
  EXPECT_EQ(X, parseComposition(mechanism, "H2: 2, O2: 1, N2: 5"));
  EXPECT_THAT(messageOf("h2: 2, H2: 1"), HasSubstr("'H2' is given twice"));
  const auto metals = lampblack::test::readText("species: [CO, Co, ar]", R"(
- {name: CO, composition: {C: 1, O: 1}, thermo: *t}
- {name: Co, composition: {Co: 1}, thermo: *t}
- {name: ar, composition: {Ar: 1}, thermo: *t})",
                                                "[]");
  EXPECT_EQ(metals.speciesIndex("Co"), 1U);
  EXPECT_EQ(metals.speciesIndex("AR"), 2U);
  EXPECT_FALSE(metals.findSpecies("co"));
  try {
    static_cast<void>(metals.speciesIndex("co"));
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'co' in mechanism"));
    EXPECT_THAT(error.what(), HasSubstr("may be any of 'CO', 'Co'"));
  }
}

TEST(Composition, ANameMayStandInQuotes) {
  const auto& mechanism = lampblack::test::hydrogen();
  for (const char* text : {"'H2': 2, \"O2\" = 1, N2: 5", "'H2':2 'O2':1 'N2':5"}) {
    const auto X = parseComposition(mechanism, text);
    EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("H2")], 0.25) << text;
    EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("O2")], 0.125) << text;
  }
}

TEST(Composition, AmountsNearTheEndOfFloatingPoint) {
  const auto& mechanism = lampblack::test::hydrogen();
  const auto X = parseComposition(mechanism, "H2: 1e308, O2: 1e308, N2: 1.6e308");
  EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("H2")], 1 / 3.6);
  EXPECT_DOUBLE_EQ(X[mechanism.speciesIndex("N2")], 1.6 / 3.6);
}

TEST(Composition, ANameAloneIsThatSpeciesAlone) {
  const auto& mechanism = lampblack::test::hydrogen();
  for (const char* text : {"O2", " o2 ", "'O2'"})
    EXPECT_EQ(parseComposition(mechanism, text), parseComposition(mechanism, "O2: 1")) << text;
}

TEST(Composition, SaysWhatIsWrong) {
  EXPECT_THAT(messageOf("air"), HasSubstr("air is 'O2: 0.21, N2: 0.79'"));
  EXPECT_THAT(messageOf("H2: 1, H2O3: 1"), HasSubstr("nearest known name is 'H2O"));
  EXPECT_THAT(messageOf("H2: 1, XENON: 1"), HasSubstr(", which has H2, H, "));
  EXPECT_THAT(messageOf("H2: -1, O2: 2"), HasSubstr("negative amount of 'H2'"));
  EXPECT_THAT(messageOf("H2: 0, O2: 0"), HasSubstr("all amounts are zero"));
  EXPECT_THAT(messageOf("H2: 1, H2: 2"), HasSubstr("twice"));
  EXPECT_THAT(messageOf("H2: one"), HasSubstr("expected a number"));
  EXPECT_THAT(messageOf("H2: 1x, O2: 1"), HasSubstr("expected a number"));
  EXPECT_THAT(messageOf("H2: 2; O2: 1"), HasSubstr("expected a number after 'H2:', found '2;'; commas or blanks part"));
  EXPECT_THAT(messageOf("H2:20%, O2:80%"), HasSubstr("found '20%'; leave out '%'"));
  EXPECT_THAT(messageOf("H2: 50 %, O2: 50 %"), HasSubstr("found '50 %'; leave out '%'"));
  EXPECT_THAT(messageOf("H2: 1, O2: 50 %"), HasSubstr("after 'O2:', found '50 %'; leave out '%'"));
  EXPECT_THAT(messageOf("H2: 0,5, O2: 1"), HasSubstr("after 'H2:', found '0,5'; a number has a decimal point, 0.5"));
  EXPECT_THAT(messageOf("H2: 1, O2: 0,25"), HasSubstr("found '0,25'; a number has a decimal point, 0.25"));
  EXPECT_THAT(messageOf("H2: 2/3, O2: 1/3"), HasSubstr("found '2/3'; write a decimal number"));
  EXPECT_THAT(messageOf("H2:"), HasSubstr("expected a number after 'H2:'"));
  EXPECT_THAT(messageOf("H2: 2, AIR: 4.76"), HasSubstr("'AIR' is a mixture; name its species"));
  EXPECT_THAT(messageOf("H2: nan"), HasSubstr("expected a number"));
  EXPECT_THAT(messageOf("'H2: 1, O2: 2"), HasSubstr("the quote before 'H2: 1, O2: 2' is not closed"));
  EXPECT_THAT(messageOf("'H2' x: 1"), HasSubstr("expected ':' after the name 'H2'"));
  EXPECT_THAT(messageOf("'H2' 1"), HasSubstr("expected ':'"));
  EXPECT_THAT(messageOf("\"a:b=c\": 1"), HasSubstr("'a:b=c'"));
  EXPECT_THAT(messageOf("H2 1"), HasSubstr("expected ':'"));
  EXPECT_THAT(messageOf(" "), HasSubstr("empty composition"));
}

}  // namespace
