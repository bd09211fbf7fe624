// What a wrong mechanism file says: file, line, reaction or species, and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"

namespace {

using namespace lampblack;
using lampblack::testing::mechanismText;
using lampblack::testing::readFileText;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string messageOf(const std::string& text) {
  try {
    readFileText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The species stand in lines 7 to 10, the reaction in line 12.
std::string withReaction(const std::string& reaction) {
  return mechanismText("species: [H, O2, HO2, AR]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: AR, composition: {Ar: 1}, thermo: *t})",
                       reaction);
}

std::string reactionMessage(const std::string& entry) {
  return messageOf(withReaction("- {" + entry + "}"));
}

const std::string kRate = "rate-constant: {A: 1.0, b: 0, Ea: 0}";

TEST(MechanismErrors, UnreadableFiles) {
  EXPECT_THROW(Mechanism::fromFile("no/such/file.yaml"), InputError);
  EXPECT_THROW(Mechanism::fromFile("/"), InputError);
  EXPECT_THAT(messageOf(""), HasSubstr("empty"));
  EXPECT_THAT(messageOf("a: [1, 2\nb: 3\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(messageOf("- 1\n- 2\n"), HasSubstr(":1: mechanism file: expected a map"));
  EXPECT_THAT(messageOf("phases: []\nspecies: []\n"), HasSubstr("no ideal-gas phase"));
  EXPECT_THAT(messageOf("units: {length: inch}\n"), AllOf(HasSubstr(":1:"), HasSubstr("expected one of m, cm, mm")));
}

TEST(MechanismErrors, ReactionsThatDoNotBalance) {
  EXPECT_THAT(
      reactionMessage("equation: H + O2 <=> HO2 + H, " + kRate),
      AllOf(HasSubstr(".yaml:12:"), HasSubstr("'H + O2 <=> HO2 + H' does not balance"), HasSubstr("2 on the right")));
}

TEST(MechanismErrors, UndeclaredSpecies) {
  EXPECT_THAT(reactionMessage("equation: H + O3 <=> HO2 + O, " + kRate),
              AllOf(HasSubstr(":12:"), HasSubstr("'O3' is not declared")));
  EXPECT_THAT(reactionMessage("equation: H + O2 + M <=> HO2 + M, efficiencies: {XE: 1}, " + kRate),
              HasSubstr("'XE' is not declared"));
  EXPECT_THAT(messageOf(mechanismText("species: [N2, H]", "\n- {name: N2, composition: {N: 2}, thermo: *t}", "[]")),
              AllOf(HasSubstr(":4:"), HasSubstr("'H' of the phase is not declared")));
}

TEST(MechanismErrors, DuplicatesMustBeMarked) {
  const std::string reaction = "equation: H + O2 + AR <=> HO2 + AR, " + kRate;
  EXPECT_THAT(messageOf(withReaction("- {" + reaction + "}\n  - {" + reaction + "}")),
              AllOf(HasSubstr(":13:"), HasSubstr("at line 12"), HasSubstr("duplicate: true")));
  EXPECT_THAT(messageOf(withReaction("- {" + reaction + ", duplicate: true}\n  - {" + reaction + ", duplicate: true}")),
              "no error");
  EXPECT_THAT(reactionMessage(reaction + ", duplicate: true"), HasSubstr("no other one like it"));
  // The reverse of an irreversible reaction is another reaction; that of a reversible one is not.
  EXPECT_THAT(messageOf(withReaction("- {equation: H + O2 => HO2, " + kRate + "}\n  - {equation: HO2 => H + O2, " +
                                     kRate + "}")),
              "no error");
  EXPECT_THAT(messageOf(withReaction("- {equation: H + O2 <=> HO2, " + kRate + "}\n  - {equation: HO2 => H + O2, " +
                                     kRate + "}")),
              HasSubstr("duplicate: true"));
}

TEST(MechanismErrors, WhatIsNotSupportedYetIsNamed) {
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, type: pressure-dependent-Arrhenius, rate-constants: []"),
              AllOf(HasSubstr(":12:"), HasSubstr("'H + O2 <=> HO2'"),
                    HasSubstr("'pressure-dependent-Arrhenius' is not supported yet")));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, type: Chebyshev"), HasSubstr("not supported yet"));
  EXPECT_THAT(reactionMessage("equation: H + O2 (+M) <=> HO2 (+M), type: chemically-activated"),
              HasSubstr("not supported yet"));
  EXPECT_THAT(reactionMessage("equation: H + O2 (+M) <=> HO2 (+M), type: falloff, SRI: {A: 1, B: 1, C: 1}"),
              HasSubstr("'SRI' is not supported yet"));
  EXPECT_THAT(messageOf(mechanismText("species: [H]",
                                      "\n- name: H\n  composition: {H: 1}\n  thermo: {model: NASA9, data: []}", "[]")),
              AllOf(HasSubstr(":9:"), HasSubstr("'NASA9' is not supported yet")));
}

TEST(MechanismErrors, UnknownKeysNameTheNearest) {
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constnt: {A: 1, b: 0, Ea: 0}"),
              AllOf(HasSubstr(":12:"), HasSubstr("unknown key 'rate-constnt'"), HasSubstr("'rate-constant'")));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: 1, n: 0, Ea: 0}"),
              HasSubstr("unknown key 'n'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, efficiencies: {AR: 1}, " + kRate),
              HasSubstr("unknown key 'efficiencies'"));
}

TEST(MechanismErrors, RatesOutOfRange) {
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: -1.0, b: 0, Ea: 0}"),
              AllOf(HasSubstr(":12:"), HasSubstr("negative 'A'")));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, negative-A: true, rate-constant: {A: -1.0, b: 0, Ea: 0}"),
              "no error");
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: fast, b: 0, Ea: 0}"),
              HasSubstr("expected a number, found 'fast'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: 1, b: 0, Ea: 3 furlong}"),
              HasSubstr("with a unit such as cal/mol"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: .nan, b: 0, Ea: 0}"),
              HasSubstr("expected a number"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2"), HasSubstr("expected 'rate-constant'"));
  EXPECT_THAT(
      reactionMessage("equation: H + O2 (+M) <=> HO2 (+M), type: falloff, high-P-rate-constant: {A: 1, b: 0, Ea: 0}"),
      HasSubstr("expected 'low-P-rate-constant'"));
}

TEST(MechanismErrors, NegativeEfficiencies) {
  for (const char* key : {"default-efficiency: -1", "efficiencies: {AR: -1}"})
    EXPECT_THAT(reactionMessage(std::string("equation: H + O2 + M <=> HO2 + M, ") + key + ", " + kRate),
                AllOf(HasSubstr(":12:"), HasSubstr("efficiency of zero or more")));
}

TEST(MechanismErrors, EquationsThatCannotBeRead) {
  for (const char* equation : {"H + O2 HO2", "H + <=> HO2", "H O2 <=> HO2", "H + O2 + M <=> HO2", "H + O2 (+M) <=> HO2",
                               "-1 H + O2 <=> HO2", "<=> HO2", "M <=> M", "'H + O2 <=> '", "''"})
    EXPECT_THAT(reactionMessage(std::string("equation: ") + equation + ", " + kRate), HasSubstr(":12:")) << equation;
  EXPECT_THAT(reactionMessage("equation: H + O2 (+M) <=> HO2 (+M), " + kRate), HasSubstr("needs 'type: falloff'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, type: falloff"), HasSubstr("needs '(+M)'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, type: three-body, " + kRate),
              HasSubstr("needs 'M' or a collider"));
}

TEST(MechanismErrors, SpeciesThatMakeNoSense) {
  const auto message = [](const std::string& species) {
    return messageOf(mechanismText("species: [H]", "\n" + species, "[]"));
  };
  EXPECT_THAT(message("- {name: H, composition: {Hx: 1}, thermo: *t}"), HasSubstr("unknown element 'Hx'"));
  EXPECT_THAT(message("- {name: H, composition: {}, thermo: *t}"), HasSubstr("no atoms"));
  EXPECT_THAT(message("- {name: H, composition: {H: 1}}"), HasSubstr("species 'H' has no 'thermo'"));
  EXPECT_THAT(message("- {name: H, composition: {H: 1}, thermo: {model: NASA7, temperature-ranges: [200, 1000, 900], "
                      "data: [[1,2,3,4,5,6,7],[1,2,3,4,5,6,7]]}}"),
              HasSubstr("rising temperatures"));
  EXPECT_THAT(message("- {name: H, composition: {H: 1}, thermo: {model: NASA7, temperature-ranges: [200, 1000], "
                      "data: [[1,2,3,4,5,6]]}}"),
              HasSubstr("seven coefficients"));
  EXPECT_THAT(message("- {name: H, composition: {H: 1}, thermo: *t}\n- {name: H, composition: {H: 1}, thermo: *t}"),
              HasSubstr("declared twice"));
  EXPECT_THAT(message("- {name: H, composition: {H: 1}, thermo: *t, transport: {model: gas, geometry: round, "
                      "well-depth: 1, diameter: 1}}"),
              HasSubstr("expected atom, linear or nonlinear, found 'round'"));
}

}  // namespace
