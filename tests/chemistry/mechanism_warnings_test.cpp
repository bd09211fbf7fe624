// What a mechanism warns of: data that jump, and colliders that act twice.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "chemistry/mechanism/known_species.hpp"
#include "chemistry/mechanism/like_warnings.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readFileText;
using lampblack::test::readText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Constant heat capacities of 3.5 R below 1000 K and `cp` above; h and s meet for b1 = -900, b2 = 4 if cp = 3.5.
std::vector<std::string> warningsOf(double cp, double b1, double b2) {
  return readText(
             "species: [N2]",
             fmt::format("\n- name: N2\n  composition: {{N: 2}}\n  thermo: {{model: NASA7, temperature-ranges: [200, "
                         "1000, 3000], data: [[3.5, 0, 0, 0, 0, -900, 4], [{}, 0, 0, 0, 0, {}, {}]]}}",
                         cp, b1, b2),
             "[]")
      .warnings();
}

TEST(MechanismWarnings, RangesThatJump) {
  EXPECT_THAT(warningsOf(3.5, -900, 4), IsEmpty());
  EXPECT_THAT(warningsOf(3.5, -903.4, 4), IsEmpty());  // 0.001 cp/R = 0.0035
  EXPECT_THAT(warningsOf(3.5, -903.6, 4),
              ElementsAre(AllOf(HasSubstr(".yaml:7: species 'N2': the thermodynamic data jump at 1000 K: h/RT by "
                                          "-0.0036 (2.6 below, 2.5964 above)"),
                                Not(HasSubstr("cp/R")), Not(HasSubstr("s/R")))));
  // s/R = 3.5 ln 1000 + 4 = 28.177; 0.001 of s/R + cp/R is 0.0317
  EXPECT_THAT(warningsOf(3.5, -900, 4.031), IsEmpty());
  EXPECT_THAT(warningsOf(3.5, -900, 4.5), ElementsAre(HasSubstr("1000 K: s/R by 0.5 (28.1771 below, 28.6771 above)")));
  EXPECT_THAT(warningsOf(3.6, -900, 4), ElementsAre(AllOf(HasSubstr("cp/R by 0.1 (3.5 below, 3.6 above), h/RT by 0.1"),
                                                          HasSubstr("s/R by 0.69"))));
}

TEST(MechanismWarnings, RangesOfNasa9ThatJump) {
  const auto mechanism =
      readText("species: [N2]",
               "\n- {name: N2, composition: {N: 2}, thermo: {model: NASA9, temperature-ranges: [200, "
               "500, 1000, 3000], data: [[0, 0, 3.5, 0, 0, 0, 0, 0, 4], [0, 0, 3.5, 0, 0, 0, 0, 0, 4], "
               "[0, 0, 3.5, 0, 0, 0, 0, 10, 4]]}}",
               "[]");
  EXPECT_THAT(mechanism.warnings(), ElementsAre(HasSubstr("jump at 1000 K: h/RT by 0.01 (3.5 below, 3.51 above)")));
}

// Three of the fits of KM2 do not meet in enthalpy by more than half an RT; GRI-Mech's all do.
TEST(MechanismWarnings, OfPublishedMechanisms) {
  EXPECT_THAT(Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/methane_gri30_53.yaml")).warnings(),
              IsEmpty());
  const auto warnings =
      Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/ethylene_km2_202.yaml")).warnings();
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("species 'C4H5-2': the thermodynamic data jump at 1000 K")));
  EXPECT_EQ(warnings.size(), 5U);
}

// Lines 7 to 10 hold the species, 12 and 13 the reactions.
Mechanism colliders(const std::string& phase, const std::string& mixture, const std::string& named) {
  const std::string rate = "rate-constant: [1, 0, 0]";
  return readText("species: [H, O2, HO2, AR]" + phase, R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: AR, composition: {Ar: 1}, thermo: *t})",
                  "- {equation: H + O2 + M <=> HO2 + M, " + mixture + rate +
                      "}\n  - {equation: H + O2 + AR <=> HO2 + AR, " + named + rate + "}");
}

TEST(MechanismWarnings, CollidersThatActTwice) {
  EXPECT_THAT(
      colliders("", "", "").warnings(),
      ElementsAre(AllOf(HasSubstr(".yaml:13: reaction 'H + O2 + AR <=> HO2 + AR' has the collider AR of 'H + O2 + M "
                                  "<=> HO2 + M' at line 12 a second time"))));
  EXPECT_THAT(colliders("", "efficiencies: {AR: 0}, ", "").warnings(), IsEmpty());
  EXPECT_THAT(colliders("", "duplicate: true, ", "duplicate: true, ").warnings(), IsEmpty());
}

TEST(MechanismWarnings, CollidersAsThePhaseWantsThem) {
  const std::string key = ", explicit-third-body-duplicates: ";
  EXPECT_EQ(colliders(key + "warn", "", "").warnings().size(), 1U);
  EXPECT_THROW(colliders(key + "error", "", ""), InputError);
  EXPECT_THAT(colliders(key + "mark-duplicate", "", "").warnings(), IsEmpty());
  const auto modified = colliders(key + "modify-efficiency", "efficiencies: {AR: 0.5, H: 2}, ", "");
  EXPECT_THAT(modified.warnings(), IsEmpty());
  double H = 0, AR = 1;
  for (const auto& e : modified.reaction(0).thirdBody->efficiencies) (e.species == 0 ? H : AR) = e.coefficient;
  EXPECT_EQ(H, 2);
  EXPECT_EQ(AR, 0);
}

// Marked as duplicates, reactions of different types belong together; unmarked they are no error.
TEST(MechanismWarnings, DuplicatesOfDifferentTypes) {
  const std::string plog = "type: pressure-dependent-Arrhenius, rate-constants: [{P: 1, A: 1, b: 0, Ea: 0}]";
  for (const std::string mark : {"", ", duplicate: true"}) {
    const auto mechanism = readText("species: [H, O2, HO2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t})",
                                    "- {equation: H + O2 <=> HO2, rate-constant: [1, 0, 0]" + mark +
                                        "}\n  - {equation: HO2 <=> H + O2, " + plog + mark + "}");
    EXPECT_THAT(mechanism.warnings(), IsEmpty());
  }
}

TEST(MechanismWarnings, OwnKeysOfAPhase) {
  const auto mechanism = readText("species: [H], n_lumped: 1, specis: [H]", R"(
- {name: H, composition: {H: 1}, thermo: *t})",
                                  "[]");
  EXPECT_EQ(mechanism.numSpecies(), 1U);
  EXPECT_THAT(mechanism.warnings(),
              ElementsAre(HasSubstr(".yaml:4: phase 'gas': unknown key 'n_lumped'; the nearest known key is "),
                          HasSubstr("unknown key 'specis'; the nearest known key is 'species'; it is passed over")));
}

// Fields of other programs, also in what a species has; a slip stays an error.
TEST(MechanismWarnings, OwnKeysOfASpecies) {
  const auto with = [](const std::string& species, const std::string& thermo, const std::string& transport) {
    return readText("species: [H]",
                    "\n- {name: H, composition: {H: 1}" + species + ", thermo: {model: constant-cp" + thermo +
                        "}, transport: {model: gas, geometry: atom, diameter: 2, "
                        "well-depth: 145" +
                        transport + "}}",
                    "[]");
  };
  EXPECT_THAT(with(", extra-field: blue, literal: [1]", ", bonus-field: green", ", bogus-field: red").warnings(),
              ElementsAre(HasSubstr(":7: species 'H': unknown key 'extra-field'"), HasSubstr("'literal'"),
                          HasSubstr("species 'H', 'thermo': unknown key 'bonus-field'"),
                          HasSubstr("species 'H', 'transport': unknown key 'bogus-field'")));
  EXPECT_THROW(with(", transprt: 1", "", ""), InputError);
  EXPECT_THROW(with("", ", T_max: 3000", ""), InputError);
  EXPECT_THROW(with("", "", ", dipol: 1"), InputError);
}

// What no type of reaction has is for another program; what another type has would be lost in silence.
TEST(MechanismWarnings, OwnKeysOfAReaction) {
  const auto with = [](const std::string& more) {
    return readText("species: [H, O2, HO2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t})",
                    "- {equation: H + O2 <=> HO2, rate-constant: [1, 0, 0]" + more + "}");
  };
  EXPECT_THAT(with(", uncertainty: {f: 2}, my-tag: 1").warnings(),
              ElementsAre(HasSubstr("reaction 'H + O2 <=> HO2': unknown key 'uncertainty'; the nearest known key is "),
                          HasSubstr("'my-tag'")));
  for (const std::string foreign : {"Troe: {}", "colliders: []", "data: []", "rate-constants: []"})
    EXPECT_THROW(with(", " + foreign), InputError) << foreign;
  EXPECT_THROW(with(", efficiences: {H: 2}"), InputError) << "a slip";
  for (const std::string rate :
       {"third-body-efficiencies: {H: 2}", "collider-efficiencies: {H: 2}", "default-eff: 0", "forward-orders: {H: 2}",
        "reversible: false", "multiplier: 2", "rate_multiplier: 2", "falloff: Troe", "Troe-parameters: {}",
        "nonreactant-forward-orders: {}", "reverse-rate-constant: [1, 0, 0]"})
    EXPECT_THAT(lampblack::test::messageOf<InputError>([&] { with(", " + rate); }),
                HasSubstr(fmt::format("unknown key '{}', which may be meant to change the rate; the nearest known",
                                      rate.substr(0, rate.find(':')))));
  EXPECT_THAT(with(", data-source: here").warnings(), ElementsAre(HasSubstr("'data-source'")));
}

// A rate that is zero at all pressures, and one mark too many, in YAML.
TEST(MechanismWarnings, TablesOfZerosAndMarksTooMany) {
  const auto mechanism = readText("species: [H, O2, HO2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t})",
                                  "- {equation: H + O2 <=> HO2, duplicate: true, type: pressure-dependent-Arrhenius, "
                                  "rate-constants: [{P: 1 atm, A: 0, b: 0, Ea: 0}, {P: 2 atm, A: 0, b: 0, Ea: 0}]}");
  EXPECT_EQ(mechanism.reaction(0).rate.A, 0);
  EXPECT_FALSE(mechanism.reaction(0).duplicate);
  EXPECT_THAT(mechanism.warnings(),
              ElementsAre(HasSubstr(":11: reaction 'H + O2 <=> HO2': the rate constants are zero"),
                          HasSubstr(":11: reaction 'H + O2 <=> HO2' is marked as a duplicate")));
}

TEST(MechanismWarnings, EachUnknownKeyIsAKindOfItsOwn) {
  const std::string of = ": reaction 'H + O2 <=> HO2': unknown key ", near = "; the nearest known key is 'note'";
  EXPECT_THAT(
      oneOfEachKind(std::vector<std::string>{"a.yaml:1" + of + "'my-tag'" + near, "a.yaml:2" + of + "'f'" + near,
                                             "a.yaml:3" + of + "'my-tag'" + near}),
      ElementsAre("a.yaml:1" + of + "'my-tag'" + near + " (1 more like this)", "a.yaml:2" + of + "'f'" + near));
}

TEST(MechanismWarnings, OneOfEachKind) {
  const std::string jump = ": the thermodynamic data jump at ", marked = "' is marked as a duplicate, but";
  EXPECT_THAT(
      oneOfEachKind(std::vector<std::string>{
          "a b.yaml:1: species 'CH2'" + jump + "1000 K: cp/R by 0.1: much",
          "chem.inp:17: reaction 'H + O2 (+M) => HO2" + marked, "no transport data for 2 of 3 species: H2, OH",
          "a b.yaml:22: species 'H: b'" + jump + "1382.5 K: h/RT by 0.2",
          "chem.inp:19: reaction 'C4H8-2 => OH" + marked, "a b.yaml:23: species 'H'" + jump + "999 K: cp/R by 1",
          "chem.inp:19: reaction 'H + O2 (+M) => HO2': T2 of zero"}),
      ElementsAre("a b.yaml:1: species 'CH2'" + jump + "1000 K: cp/R by 0.1: much (2 more like this)",
                  "chem.inp:17: reaction 'H + O2 (+M) => HO2" + marked + " (1 more like this)",
                  "no transport data for 2 of 3 species: H2, OH",
                  "chem.inp:19: reaction 'H + O2 (+M) => HO2': T2 of zero"));
}

// Species the program looks for: by name, by the name in another case, or by a composition that only one has.
TEST(KnownSpecies, ByNameCaseAndComposition) {
  const auto mechanism = readText("species: [h2o, WATER2, dioxide, CO, C2H2, vinylidene, hydroxyl, oh*, a4, NO+]", R"(
- {name: h2o, composition: {H: 2, O: 1}, thermo: *t}
- {name: WATER2, composition: {H: 2, O: 1}, thermo: *t}
- {name: dioxide, composition: {C: 1, O: 2}, thermo: *t}
- {name: CO, composition: {C: 1, O: 1}, thermo: *t}
- {name: C2H2, composition: {C: 2, H: 2}, thermo: *t}
- {name: vinylidene, composition: {C: 2, H: 2}, thermo: *t}
- {name: hydroxyl, composition: {H: 1, O: 1}, thermo: *t}
- {name: oh*, composition: {H: 1, O: 1}, thermo: *t}
- {name: a4, composition: {C: 16, H: 10}, thermo: *t}
- {name: NO+, composition: {N: 1, O: 1, E: -1}, thermo: *t})",
                                  "[]");
  using Found = std::optional<std::size_t>;
  EXPECT_EQ(findKnownSpecies(mechanism, "H2O"), Found(0));
  EXPECT_EQ(findKnownSpecies(mechanism, "CO2"), Found(2));
  EXPECT_EQ(findKnownSpecies(mechanism, "CO"), Found(3));
  EXPECT_EQ(findKnownSpecies(mechanism, "C2H2"), Found(4));
  EXPECT_EQ(findKnownSpecies(mechanism, "OH"), Found());
  EXPECT_EQ(findKnownSpecies(mechanism, "A4"), Found(8));
  EXPECT_EQ(findKnownSpecies(mechanism, "C16H10"), Found(8));
  EXPECT_EQ(findKnownSpecies(mechanism, "NO"), Found());
  EXPECT_EQ(findKnownSpecies(mechanism, "CH4"), Found());
  try {
    static_cast<void>(knownSpecies(mechanism, "OH", "ensembles need"));
    ADD_FAILURE() << "found";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ensembles need the species 'OH'"));
    EXPECT_THAT(error.what(), HasSubstr("('hydroxyl', 'oh*')"));
  }
}

}  // namespace
