// Which phase of a file is read, and which reactions and atomic weights it has by the format's rules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readFileText;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kThermo = "thermo: {model: NASA7, temperature-ranges: [200, 3000], data: [[3.5, 0, 0, 0, 0, 0, 1]]}";

// The phases start in line 2.
std::string file(const std::string& phases, bool withReactions = true) {
  std::string text = "phases:\n" + phases + "species:\n- {name: H, composition: {H: 1}, " + kThermo +
                     "}\n- {name: H2, composition: {H: 2}, " + kThermo + "}\n- {name: AR, composition: {Ar: 1}, " +
                     kThermo + "}\nelements:\n- {symbol: Ar, atomic-weight: 36}\n";
  if (withReactions) text += "reactions:\n- {equation: 2 H => H2, rate-constant: [1, 0, 0]}\n";
  return text + "more:\n- {equation: H2 => 2 H, rate-constant: [1, 0, 0]}\n";
}

std::string phase(const std::string& entries, const std::string& name = "gas") {
  return "- {name: " + name + ", thermo: ideal-gas" + entries + "}\n";
}

std::string messageOf(const std::string& text, const std::string& name = "") {
  try {
    readFileText(text, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MechanismPhases, WithoutKineticsThereAreNoReactions) {
  EXPECT_EQ(readFileText(file(phase(""))).numReactions(), 0U);
  EXPECT_EQ(readFileText(file(phase(", kinetics: none"))).numReactions(), 0U);
  EXPECT_EQ(readFileText(file(phase(", reactions: none"))).numReactions(), 0U);
  for (const char* model : {"gas", "bulk"})
    EXPECT_EQ(readFileText(file(phase(std::string(", kinetics: ") + model))).numReactions(), 1U);
  EXPECT_EQ(readFileText(file(phase(", kinetics: gas, reactions: none"))).numReactions(), 0U);
  EXPECT_EQ(readFileText(file(phase(", kinetics: gas, reactions: [more, reactions]"))).numReactions(), 2U);
  // Reactions of species that the phase does not have are no concern of it.
  EXPECT_EQ(readFileText(file(phase(", species: [AR]"))).numReactions(), 0U);
}

TEST(MechanismPhases, ReactionsThatContradictThePhaseAreErrors) {
  EXPECT_THAT(messageOf(file(phase(", reactions: all"))), AllOf(HasSubstr(":2:"), HasSubstr("'kinetics: gas'")));
  EXPECT_THAT(messageOf(file(phase(", reactions: [more]"))), HasSubstr("'kinetics: gas'"));
  for (const char* entries : {", kinetics: gas", ", kinetics: gas, reactions: all"})
    EXPECT_THAT(messageOf(file(phase(entries), false)),
                AllOf(HasSubstr(":2:"), HasSubstr("'reactions', which is not there"), HasSubstr("'reactions: none'")));
  EXPECT_EQ(readFileText(file(phase(", kinetics: gas, reactions: none"), false)).numReactions(), 0U);
  EXPECT_EQ(readFileText(file(phase(", kinetics: gas, reactions: [more]"), false)).numReactions(), 1U);
  for (const std::string model : {"surface", "edge"})
    EXPECT_THAT(messageOf(file(phase(", kinetics: " + model))),
                AllOf(HasSubstr(":2:"), HasSubstr("kinetics '" + model + "' is not supported")));
}

// The file's own argon of 36 g/mol is for phases that list elements.
TEST(MechanismPhases, WithoutElementsTheWeightsAreTheStandardOnes) {
  const auto weight = [](const std::string& elements) {
    const auto mechanism = readFileText(file(phase(", species: [AR]" + elements)));
    return 1e3 * mechanism.molecularWeights()[0];
  };
  EXPECT_DOUBLE_EQ(weight(""), 39.95);
  EXPECT_DOUBLE_EQ(weight(", elements: [Ar]"), 36);
  EXPECT_DOUBLE_EQ(weight(", elements: [{default: [Ar]}]"), 39.95);
  EXPECT_DOUBLE_EQ(weight(", elements: [{elements: [Ar]}]"), 36);
}

TEST(MechanismPhases, AreChosenByName) {
  const auto text = file("- {name: wall, thermo: ideal-surface}\n" + phase(", kinetics: gas", "first") +
                         phase(", species: [AR]", "second"));
  EXPECT_EQ(readFileText(text).numSpecies(), 3U);
  EXPECT_EQ(readFileText(text, "first").numReactions(), 1U);
  EXPECT_EQ(readFileText(text, "second").numSpecies(), 1U);
  const std::string names = "'wall' (ideal-surface), 'first' (ideal-gas), 'second' (ideal-gas)";
  EXPECT_THAT(messageOf(text, "third"), AllOf(HasSubstr("no phase 'third'"), HasSubstr(names)));
  EXPECT_THAT(messageOf(text, "wall"),
              AllOf(HasSubstr(":2:"), HasSubstr("type 'ideal-surface', which is not supported"), HasSubstr(names)));
}

TEST(MechanismPhases, OtherModelsAreRefusedByName) {
  for (const std::string model : {"plasma", "Redlich-Kwong", "Peng-Robinson", "ideal-surface", "pure-fluid"})
    EXPECT_THAT(messageOf(file("- {name: a, thermo: " + model + "}\n")),
                AllOf(HasSubstr(":2:"), HasSubstr("no ideal-gas phase"), HasSubstr("'a' (" + model + ")")));
}

TEST(MechanismPhases, TransportModelsThatAreNotThereAreTold) {
  const auto warnings = [](const std::string& model) {
    return readFileText(file(phase(", transport: " + model))).warnings();
  };
  for (const char* model : {"none", "mixture-averaged", "multicomponent-CK", "unity-Lewis-number"})
    EXPECT_TRUE(warnings(model).empty()) << model;
  ASSERT_EQ(warnings("ionized-gas").size(), 1U);
  EXPECT_THAT(warnings("ionized-gas")[0],
              AllOf(HasSubstr(":2:"), HasSubstr("'ionized-gas'"), HasSubstr("neutral molecules")));
}

}  // namespace
