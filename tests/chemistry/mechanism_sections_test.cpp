// Where a phase takes its species, reactions and elements from, and the units that hold there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readFileText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kThermo = "thermo: {model: NASA7, temperature-ranges: [200, 3000], data: [[3.5, 0, 0, 0, 0, 0, 1]]}";

std::string species(const std::string& name, const std::string& composition) {
  return "- {name: " + name + ", composition: {" + composition + "}, " + kThermo + "}\n";
}

// The phase's entries stand in line 2; the species follow in lines 4 to 7, the section `more` in 9, reactions in 11 to
// 12, and another list of them from line 14 on.
std::string file(const std::string& phase) {
  const std::string kinetics = phase.find("kinetics:") == std::string::npos ? "kinetics: gas, " : "";
  return "phases:\n- {name: gas, thermo: ideal-gas, " + kinetics + phase + "}\nspecies:\n" + species("H", "H: 1") +
         species("O2", "O: 2") + species("HO2", "H: 1, O: 2") + species("CO", "C: 1, O: 1") + "more:\n" +
         species("AR", "Ar: 1") + "reactions:\n" +
         "- {equation: H + O2 + M => HO2 + M, rate-constant: [1, 0, 0], efficiencies: {CO: 2}}\n" +
         "- {equation: H + CO + M => H + CO + M, type: three-body, rate-constant: [1, 0, 0]}\n" + "others:\n" +
         "- units: {length: cm, quantity: mol}\n" + "- {equation: HO2 => H + O2, rate-constant: [5, 0, 0]}\n" +
         "- {equation: HO2 + HO2 => H + O2 + HO2, rate-constant: [3e6, 0, 0]}\n";
}

std::vector<std::string> names(const Mechanism& mechanism) {
  std::vector<std::string> result;
  for (const auto& s : mechanism.allSpecies()) result.push_back(s.name);
  return result;
}

std::string messageOf(const std::string& text) {
  try {
    readFileText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MechanismSections, AllSpeciesOrAList) {
  EXPECT_THAT(names(readFileText(file("species: all"))), ElementsAre("H", "O2", "HO2", "CO"));
  EXPECT_THAT(names(readFileText(file("kinetics: gas"))), ElementsAre("H", "O2", "HO2", "CO"));
  const auto some = readFileText(file("species: [CO, {more: [AR]}, {species: [H]}], reactions: none"));
  EXPECT_THAT(names(some), ElementsAre("CO", "AR", "H"));
  EXPECT_EQ(some.numReactions(), 0U);
  EXPECT_EQ(some.numElements(), 4U);  // C, O, Ar, H as they come
  EXPECT_EQ(some.elementName(2), "Ar");
  EXPECT_THAT(names(readFileText(file("species: [{more: all}], reactions: none"))), ElementsAre("AR"));
}

TEST(MechanismSections, ReactionsOfSectionsAndRules) {
  EXPECT_EQ(readFileText(file("reactions: all")).numReactions(), 2U);
  EXPECT_EQ(readFileText(file("reactions: none")).numReactions(), 0U);
  EXPECT_EQ(readFileText(file("kinetics: none")).numReactions(), 0U);
  EXPECT_EQ(readFileText(file("reactions: [others, reactions]")).numReactions(), 4U);
  EXPECT_EQ(readFileText(file("species: [H, O2, HO2], reactions: [{others: declared-species}, {reactions: none}]"))
                .numReactions(),
            2U);
}

TEST(MechanismSections, UndeclaredSpeciesAreLeftOutWhereThePhaseSaysSo) {
  // The second reaction has CO; so do the efficiencies of the first.
  EXPECT_THAT(messageOf(file("species: [H, O2, HO2]")), AllOf(HasSubstr(":11:"), HasSubstr("'CO' of 'efficiencies'")));
  EXPECT_THAT(messageOf(file("species: [H, O2, HO2], reactions: declared-species")), HasSubstr(":11:"));
  const auto mechanism =
      readFileText(file("species: [H, O2, HO2], reactions: declared-species, skip-undeclared-third-bodies: true"));
  ASSERT_EQ(mechanism.numReactions(), 1U);
  EXPECT_TRUE(mechanism.reaction(0).thirdBody->efficiencies.empty());
  EXPECT_THAT(messageOf(file("species: [H, O2, HO2], skip-undeclared-third-bodies: true")),
              AllOf(HasSubstr(":12:"), HasSubstr("'CO' is not declared")));
}

// Named alone, an undeclared third body takes the whole reaction with it.
TEST(MechanismSections, UndeclaredCollidersAreLeftOutWhereThePhaseSaysSo) {
  const std::string reactions =
      "list:\n- {equation: H + O2 + AR => HO2 + AR, rate-constant: [1, 0, 0]}\n- {equation: H + O2 (+AR) => HO2 (+AR), "
      "type: falloff, low-P-rate-constant: [1, 0, 0], high-P-rate-constant: [1, 0, 0]}\n- {equation: H + O2 => HO2, "
      "rate-constant: [1, 0, 0]}\n";
  EXPECT_THAT(messageOf(file("reactions: [list]") + reactions), HasSubstr("'AR' is not declared"));
  const auto mechanism = readFileText(file("skip-undeclared-third-bodies: true, reactions: [list]") + reactions);
  ASSERT_EQ(mechanism.numReactions(), 1U);
  EXPECT_EQ(mechanism.reaction(0).equation, "H + O2 => HO2");
}

TEST(MechanismSections, SpeciesOfUndeclaredElements) {
  EXPECT_THAT(messageOf(file("elements: [H, O]")), AllOf(HasSubstr(":7:"), HasSubstr("element 'C' is not declared")));
  EXPECT_THAT(names(readFileText(file("elements: [H, O], skip-undeclared-elements: true, reactions: none"))),
              ElementsAre("H", "O2", "HO2"));
}

// cm and mol for one list, the file's own units (m and kmol) for the other.
TEST(MechanismSections, UnitsOfAList) {
  const auto mechanism = readFileText(file("reactions: [others, reactions]"));
  EXPECT_DOUBLE_EQ(mechanism.reaction(0).rate.A, 5);
  EXPECT_DOUBLE_EQ(mechanism.reaction(1).rate.A, 3);
  EXPECT_DOUBLE_EQ(mechanism.reaction(2).rate.A, 1e-6);  // m6/kmol2/s
}

TEST(MechanismSections, EachLevelOfUnitsChangesWhatItNames) {
  const std::string text = "units: {length: cm, quantity: mol, activation-energy: cal/mol}\n" +
                           file("species: [H, O2, HO2], reactions: [others, list]") + "list:\n" +
                           "- {equation: H + O2 => HO2, rate-constant: [1e6, 0, 1000]}\n" +
                           "- {units: {length: m}, equation: H + O2 => HO2, rate-constant: [1, 0, 1000], duplicate: "
                           "false}\n";
  EXPECT_THAT(messageOf(text), HasSubstr("duplicate: true"));
  auto marked = text;
  for (auto at = marked.find("[1e6, 0, 1000]"); at != std::string::npos; at = std::string::npos)
    marked.replace(at, 14, "[1e6, 0, 1000], duplicate: true");
  marked.replace(marked.find("duplicate: false"), 16, "duplicate: true");
  const auto mechanism = readFileText(marked);
  for (const std::size_t r : {2, 3}) {
    EXPECT_DOUBLE_EQ(mechanism.reaction(r).rate.A, 1);
    EXPECT_DOUBLE_EQ(mechanism.reaction(r).rate.activationTemperature, 4184 / constants::gasConstant);
  }
}

// Without a unit of its own, an activation energy is in energy per quantity.
TEST(MechanismSections, EnergyAndQuantityMakeActivationEnergy) {
  const auto Ta = [](const std::string& units) {
    return readFileText(units + file("reactions: [list]") +
                        "list:\n- {equation: H + O2 => HO2, rate-constant: [1, 0, 2]}")
        .reaction(0)
        .rate.activationTemperature;
  };
  EXPECT_DOUBLE_EQ(Ta(""), 2e-3 / constants::gasConstant);  // J/kmol
  EXPECT_DOUBLE_EQ(Ta("units: {energy: kcal, quantity: mol}\n"), 8368 / constants::gasConstant);
  EXPECT_DOUBLE_EQ(Ta("units: {quantity: molec, energy: eV}\n"), 2 * 1.602176634e-19 / constants::boltzmann);
  EXPECT_DOUBLE_EQ(Ta("units: {quantity: mol, activation-energy: K}\n"), 2);
}

TEST(MechanismSections, OwnElements) {
  const auto mechanism = readFileText(file("species: [{more: [AR]}], reactions: none, elements: [{isotopes: [Ar]}, "
                                           "{default: [H]}]") +
                                      "isotopes:\n- {symbol: Ar, atomic-weight: 36}\n");
  EXPECT_DOUBLE_EQ(mechanism.molecularWeights()[0], 0.036);
  EXPECT_DOUBLE_EQ(mechanism.atomicWeight(1), 1.008e-3);
}

class OtherFile : public ::testing::Test {
 protected:
  // Reads the text as a file beside other.yaml.
  Mechanism read(const std::string& text) const { return Mechanism::fromFile(folder_.file("mechanism.yaml", text)); }
  std::string messageOf(const std::string& text) const {
    return test::messageOf<InputError>([&] { static_cast<void>(read(text)); });
  }

 private:
  test::ScratchFolder folder_;
  std::string other_ =
      folder_.file("other.yaml", "here:\n" + species("N2", "N: 2") + "bad:\n" + species("N2", "N: 2, Xy: 1"));
};

TEST_F(OtherFile, SpeciesComeFromThere) {
  EXPECT_THAT(names(read(file("species: [H, {other.yaml/here: [N2]}], reactions: none"))), ElementsAre("H", "N2"));
}

TEST_F(OtherFile, ErrorsNameTheFileTheyAreIn) {
  EXPECT_THAT(messageOf(file("species: [{other.yaml/bad: [N2]}], reactions: none, elements: [N]")),
              AllOf(HasSubstr("other.yaml:4:"), HasSubstr("element 'Xy'")));
  EXPECT_THAT(messageOf(file("species: [{other.yaml/her: [N2]}]")),
              AllOf(HasSubstr("mechanism"), HasSubstr(":2:"), HasSubstr("no section 'her'"), HasSubstr("other.yaml"),
                    HasSubstr("the nearest name is 'here'")));
  EXPECT_THAT(messageOf(file("species: [{none.yaml/here: [N2]}]")),
              AllOf(HasSubstr(":2:"), HasSubstr("section 'none.yaml/here'"), HasSubstr("there is no file")));
}

TEST(MechanismSections, WhatCannotBeFoundIsNamed) {
  const std::pair<std::string, std::string> cases[] = {
      {"species: [H2]", "species 'H2' of the phase is not declared under 'species'; the nearest name is 'H'"},
      {"species: some", "expected a list"},
      {"species: [H, H]", "'H' is in the phase twice"},
      {"species: []", "no species"},
      {"species: [{mor: [AR]}]", "no section 'mor'"},
      {"species: [{more: [AR], species: [H]}]", "one section"},
      {"elements: [{more: [Ar]}]", "has no 'symbol'"},
      {"elements: [Zz]", "unknown element 'Zz'"},
      {"reactions: some", "expected all, none, declared-species or a list"},
      {"reactions: [some]", "no section 'some'"},
      {"reactions: [{others: some}]", "unknown rule 'some'"},
      {"skip-undeclared-third-bodies: maybe", "expected true or false"},
      {"explicit-third-body-duplicates: ignore", "expected warn, error, mark-duplicate or modify-efficiency"},
  };
  for (const auto& [phase, expected] : cases)
    EXPECT_THAT(messageOf(file(phase)), AllOf(HasSubstr(".yaml:"), HasSubstr(expected))) << phase;
}

TEST(MechanismSections, UnitsThatMakeNoSense) {
  const std::pair<std::string, std::string> cases[] = {
      {"length: s", "'s' is not a unit of length; expected one such as m"},
      {"length: inch", "'inch' is not a known unit"},
      {"temperature: C", "'C' is not a unit of temperature; expected one such as K"},
      {"colour: m", "unknown quantity 'colour'; expected length"},
      {"activation-energy: m", "not a unit of an activation energy"},
      {"length: cm^a", "expected a number after '^', found 'a'"},
  };
  for (const auto& [units, expected] : cases)
    EXPECT_THAT(messageOf("units: {" + units + "}\n" + file("note: a")), AllOf(HasSubstr(":1:"), HasSubstr(expected)));
}

// Only the first ideal-gas phase counts; keys of other models are of no interest.
TEST(MechanismSections, OtherPhasesAreIgnored) {
  EXPECT_EQ(
      readFileText("phases:\n- {name: a, thermo: Redlich-Kwong, x: 1}\n- {name: b, thermo: ideal-gas, species: [H], "
                   "reactions: none, state: {T: 300 K, P: 1 atm, X: {H: 1}}, transport: mixture-averaged}\n- {name: "
                   "c, thermo: ideal-gas, species: [Q]}\nspecies:\n" +
                   species("H", "H: 1"))
          .numSpecies(),
      1U);
}

}  // namespace
