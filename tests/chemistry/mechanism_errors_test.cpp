// What a wrong mechanism file says: file, line, reaction or species, and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::mechanismText;
using lampblack::test::readFileText;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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
  EXPECT_THAT(messageOf("units: {length: inch}\n"), AllOf(HasSubstr(":1:"), HasSubstr("'inch' is not a known unit")));
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
              HasSubstr("'XE' of 'efficiencies' is not declared"));
  EXPECT_THAT(messageOf(mechanismText("species: [N2, H]", "\n- {name: N2, composition: {N: 2}, thermo: *t}", "[]")),
              AllOf(HasSubstr(":4:"), HasSubstr("'H' of the phase is not declared")));
}

TEST(MechanismErrors, DuplicatesMustBeMarked) {
  const std::string reaction = "equation: H + O2 + AR <=> HO2 + AR, " + kRate;
  EXPECT_THAT(messageOf(withReaction("- {" + reaction + "}\n  - {" + reaction + "}")),
              AllOf(HasSubstr(":13:"), HasSubstr("at line 12"), HasSubstr("duplicate: true")));
  EXPECT_THAT(messageOf(withReaction("- {" + reaction + ", duplicate: true}\n  - {" + reaction + ", duplicate: true}")),
              "no error");
  // The reverse of an irreversible reaction is another reaction; that of a reversible one is not.
  EXPECT_THAT(messageOf(withReaction("- {equation: H + O2 => HO2, " + kRate + "}\n  - {equation: HO2 => H + O2, " +
                                     kRate + "}")),
              "no error");
  EXPECT_THAT(messageOf(withReaction("- {equation: H + O2 <=> HO2, " + kRate + "}\n  - {equation: HO2 => H + O2, " +
                                     kRate + "}")),
              HasSubstr("duplicate: true"));
}

TEST(MechanismErrors, WhatIsNotSupportedIsNamed) {
  for (const std::string type : {"two-temperature-plasma", "electron-collision-plasma", "interface-Arrhenius",
                                 "sticking-Arrhenius", "electrochemical", "interface-Blowers-Masel"})
    EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, type: " + type + ", rate-constant: [1, 0, 0, 0]"),
                AllOf(HasSubstr(":12:"), HasSubstr("'H + O2 <=> HO2'"), HasSubstr("'" + type + "' is not supported"),
                      HasSubstr("Blowers-Masel and linear-Burke")));
  EXPECT_THAT(
      messageOf(mechanismText("species: [H]",
                              "\n- name: H\n  composition: {H: 1}\n  thermo: {model: piecewise-Gibbs, h0: 1}", "[]")),
      AllOf(HasSubstr(":9:"), HasSubstr("'piecewise-Gibbs' is not supported; supported are NASA7, NASA9, "
                                        "Shomate and constant-cp")));
}

// Each of these forgets or contradicts something of its type; all stand in line 12.
TEST(MechanismErrors, RatesThatMakeNoSense) {
  const std::string limits = "high-P-rate-constant: [1, 0, 0], low-P-rate-constant: [1, 0, 0], ";
  const std::string falloff = "equation: H + O2 (+M) <=> HO2 (+M), type: falloff, " + limits;
  const std::string plog = "equation: H + O2 <=> HO2, type: pressure-dependent-Arrhenius, rate-constants: ";
  const std::string chebyshev = "equation: H + O2 <=> HO2, type: Chebyshev, ";
  const std::string ranges = "temperature-range: [300, 2000], pressure-range: [1, 2], ";
  const std::string burke = "equation: H + O2 => HO2, type: linear-Burke, colliders: ";
  const std::string all = "name: M, type: falloff, low-P-rate-constant: [1, 0, 0], high-P-rate-constant: [1, 0, 0]";
  const std::pair<std::string, std::string> cases[] = {
      {falloff + "Troe: {A: 1, T3: 1}", "'Troe' has no 'T1'"},
      {falloff + "Troe: {A: 1, T3: 1, T1: 1, T4: 1}", "unknown key 'T4'"},
      {falloff + "Troe: {A: 1, T3: 1 cm, T1: 1}", "'1 cm' has the wrong unit; expected one like K"},
      {falloff + "SRI: {A: 1, B: 1, C: -1}", "expected a and c of zero or more"},
      {falloff + "SRI: {A: 1, B: 1, C: 1, D: 0}", "a positive d"},
      {falloff + "SRI: {A: 1, B: 1, C: 1}, Troe: {A: 1, T3: 1, T1: 1}", "only one of"},
      {falloff + "Tsang: {A: 1, B: 1}, Troe: {A: 1, T3: 1, T1: 1}", "only one of"},
      {falloff + "Tsang: {B: 1}", "'Tsang' has no 'A'"},
      {"equation: H + O2 (+M) <=> HO2 (+M), type: falloff, negative-A: true, high-P-rate-constant: [-1, 0, 0], "
       "low-P-rate-constant: [1, 0, 0]",
       "of one sign"},
      {"equation: H + O2 (+M) <=> HO2 (+M), type: chemically-activated, low-P-rate-constant: [1, 0, 0]",
       "expected 'high-P-rate-constant'"},
      {"equation: H + O2 <=> HO2, type: chemically-activated, " + limits + "id: a", "needs '(+M)'"},
      {plog + "[]", "at least one pressure"},
      {plog + "[{A: 1, b: 0, Ea: 0}]", "has no 'P'"},
      {plog + "[{P: -1, A: 1, b: 0, Ea: 0}]", "a positive pressure"},
      {plog + "[{P: 1 m, A: 1, b: 0, Ea: 0}]", "expected one like Pa"},
      {plog + "[{P: 1, A: 1, b: 0, Ea: 0}, {P: 1, A: -2, b: 0, Ea: 0}]", "of 1 Pa add up to zero or less at 300 K"},
      {"equation: H + O2 + M <=> HO2 + M, type: pressure-dependent-Arrhenius, rate-constants: []", "no third body"},
      {chebyshev + "data: [[1]]", "has no 'temperature-range'"},
      {chebyshev + "temperature-range: [300, 200], pressure-range: [1, 2], data: [[1]]", "two rising positive values"},
      {chebyshev + ranges + "data: [[1, 2], [3]]", "the same number"},
      {chebyshev + ranges + "data: []", "expected rows"},
      {chebyshev + ranges + "data: 3", "'data': expected a list"},
      {chebyshev + ranges + "data: [[a]]", "expected a number, found 'a'"},
      {"equation: H + O2 => HO2, rate-constant: [1 cm^6/mol^2/s, 0, 0]", "expected one like m^3/s/mol"},
      {"equation: H + O2 => HO2, rate-constant: [1 furlong/s, 0, 0]", "'furlong' is not a known unit"},
      {"equation: H + O2 => HO2, rate-constant: [1, 0, 1 m]", "not a unit of an activation energy"},
      {"equation: H + O2 => HO2, rate-constant: [1]", "expected A, b, Ea; found 1 values"},
      {"equation: H + O2 => HO2, rate-constant: [1, 0]", "expected A, b, Ea; found 2 values"},
      {"equation: H + O2 => HO2, rate-constant: {A: 1, b: 0}", "'rate-constant' has no 'Ea'"},
      {plog + "[{P: 1, A: 1, b: 0}]", "has no 'Ea'"},
      {"equation: H + O2 => HO2, type: Blowers-Masel, rate-constant: {A: 1, b: 0, Ea: 0}", "unknown key 'Ea'"},
      {"equation: H + O2 => HO2, type: Blowers-Masel, rate-constant: [1, 0, 0]", "expected A, b, Ea0, w"},
      {"equation: H + O2 => HO2, type: Blowers-Masel, rate-constant: [1, 0, 500, 400]", "a bond energy 'w' above it"},
      {"equation: H + O2 => HO2, type: Blowers-Masel, rate-constant: [1, 0, -5, 400]", "'Ea0' of zero or more"},
      {burke + "[]", "'M' as the first"},
      {burke + "[{name: AR, efficiency: {A: 1, b: 0, Ea: 0}}]", "'M' as the first of 'colliders', found 'AR'"},
      {burke + "[{" + all + "}, {name: AR}]", "expected 'efficiency'"},
      {burke + "[{" + all + "}, {name: AR, eig0: [1, 0, 0]}]", "expected 'efficiency'"},
      {burke + "[{" + all + ", eig0: [1, 0, 0]}, {name: AR, efficiency: [1, 0, 0]}]", "expected 'eig0'"},
      {burke + "[{" + all + ", efficiency: [2, 0, 0]}]", "an efficiency of one"},
      {burke + "[{" + all + "}, {name: AR, efficiency: [-1, 0, 0]}]", "a positive 'A'"},
      {burke + "[{" + all + "}, {name: N2, efficiency: [1, 0, 0]}]", "collider 'N2': the species is not declared"},
      {burke + "[{" + all + "}, {name: AR, efficiency: [1, 0, 0]}, {name: AR, efficiency: [1, 0, 0]}]", "there twice"},
      {burke + "[{" + all + ", eig0: [1e-300, 0, 0]}, {name: AR, eig0: [1e300, 0, 0]}]", "efficiency is out of range"},
      {burke + "[{name: M}]", "expected a 'type'"},
      {burke + "[{name: M, type: Arrhenius, rate-constant: [1, 0, 0]}]", "unknown key 'rate-constant'"},
      {burke + "[{" + all + "}, {name: AR, efficiency: [1, 0, 0], Troe: {}}]", "unknown key 'Troe'"},
      {"equation: H + O2 => HO2, type: linear-Burke", "has no 'colliders'"},
      {"equation: H + O2 <=> HO2, orders: {H: 2}, rate-constant: [1, 0, 0]", "need an irreversible reaction"},
      {"equation: H + O2 => HO2, orders: {AR: 2}, rate-constant: [1, 0, 0]", "expected 'nonreactant-orders: true'"},
      {"equation: H + O2 => HO2, orders: {H: -2}, rate-constant: [1, 0, 0]", "expected 'negative-orders: true'"},
      {"equation: H + O2 + AR <=> HO2 + AR, efficiencies: {H: 1}, rate-constant: [1, 0, 0]",
       "excludes 'efficiencies' of others"},
      {"equation: H + O2 + AR <=> HO2 + AR, default-efficiency: 1, rate-constant: [1, 0, 0]",
       "excludes a default efficiency"},
      {"equation: H + O2 <=> HO2, efficiencies: {H: 1}, rate-constant: [1, 0, 0]", "need a third body"},
      {"equation: H + O2 + M + M <=> HO2 + M + M, rate-constant: [1, 0, 0]", "expected 'M' once"},
      {"equation: H + O2 <=> HO2, duplicate: maybe, rate-constant: [1, 0, 0]", "expected true or false"},
      {"equation: H + O2 <=> HO2, duplicate: true, duplicate: true, rate-constant: [1, 0, 0]", "given twice"},
  };
  for (const auto& [entry, expected] : cases)
    EXPECT_THAT(reactionMessage(entry), AllOf(HasSubstr(".yaml:12:"), HasSubstr(expected))) << entry;
}

TEST(MechanismErrors, EquationsWithoutBlanksSayWhatIsMissing) {
  for (const char* entry :
       {"equation: H+O2 <=> HO2, rate-constant: [1, 0, 0]", "equation: H+O2<=>HO2, rate-constant: [1, 0, 0]"})
    EXPECT_THAT(reactionMessage(entry), HasSubstr("'H+O2' is not declared in the phase; expected blanks around '+'"));
  EXPECT_THAT(reactionMessage("equation: H + O3 <=> HO2, rate-constant: [1, 0, 0]"),
              AllOf(HasSubstr("'O3' is not"), Not(HasSubstr("blanks"))));
  for (const std::string ion : {"NO+", "O++"})
    EXPECT_THAT(reactionMessage("equation: H + " + ion + " <=> HO2, rate-constant: [1, 0, 0]"),
                AllOf(HasSubstr("'" + ion + "' is not declared"), Not(HasSubstr("blanks"))));
}

TEST(MechanismErrors, UnknownKeysNameTheNearest) {
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constnt: {A: 1, b: 0, Ea: 0}"),
              AllOf(HasSubstr(":12:"), HasSubstr("unknown key 'rate-constnt'"), HasSubstr("'rate-constant'")));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: 1, n: 0, Ea: 0}"),
              HasSubstr("unknown key 'n'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, efficiencies: {AR: 1}, " + kRate),
              HasSubstr("efficiencies need a third body"));
}

TEST(MechanismErrors, RatesOutOfRange) {
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: -1.0, b: 0, Ea: 0}"),
              AllOf(HasSubstr(":12:"), HasSubstr("negative 'A'")));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, negative-A: true, rate-constant: {A: -1.0, b: 0, Ea: 0}"),
              "no error");
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: fast, b: 0, Ea: 0}"),
              HasSubstr("expected a number, with or without a unit, found 'fast'"));
  EXPECT_THAT(reactionMessage("equation: H + O2 <=> HO2, rate-constant: {A: 1, b: 0, Ea: 3 furlong}"),
              HasSubstr("'furlong' is not a known unit"));
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
