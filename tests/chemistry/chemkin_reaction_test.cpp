// Rate parameters of CHEMKIN reactions against numbers converted by hand: 1 cm3/mol = 1e-6 m3/mol, 1 cal = 4.184 J.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/chemkin_support.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::kelvinPerCalorie;
using lampblack::test::readChemkinReactions;
using ::testing::HasSubstr;

constexpr double kR = 8.31446261815324;  // J/mol/K

void expectRate(const Arrhenius& rate, double A, double b, double Ta) {
  EXPECT_NEAR(rate.A, A, 1e-14 * std::abs(A));
  EXPECT_EQ(rate.b, b);
  EXPECT_NEAR(rate.activationTemperature, Ta, 1e-14 * std::abs(Ta));
}

std::string terms(const Mechanism& mechanism, const std::vector<StoichiometricTerm>& side) {
  std::string text;
  for (const auto& term : side) {
    char coefficient[32];
    std::snprintf(coefficient, sizeof coefficient, "%g ", term.coefficient);
    text += coefficient + mechanism.speciesName(term.species) + " ";
  }
  return text;
}

TEST(ChemkinReaction, OrderSetsTheUnitOfA) {
  const auto mechanism = readChemkinReactions(
      "\nH+O2=O+OH 2.0E14 -0.4 16600\n"
      "2H+M=H2+M 1.0E18 -1.0 0.\n"
      "H2O2=2OH 1.D15 0 50.\n"
      "HO2=>O+OH 1.0+15 0 50.\nDUP\nHO2=>O+OH -1.0+14 0 0\nDUP");
  expectRate(mechanism.reaction(0).rate, 2e8, -0.4, 16600 * kelvinPerCalorie);
  EXPECT_EQ(mechanism.reaction(0).type, Reaction::Type::Elementary);
  EXPECT_TRUE(mechanism.reaction(0).reversible);
  EXPECT_EQ(mechanism.reaction(0).equation, "H + O2 <=> O + OH");
  EXPECT_EQ(mechanism.reaction(0).line, 6);
  expectRate(mechanism.reaction(1).rate, 1e6, -1, 0);
  EXPECT_EQ(mechanism.reaction(1).type, Reaction::Type::ThreeBody);
  EXPECT_EQ(mechanism.reaction(1).equation, "2 H + M <=> H2 + M");
  expectRate(mechanism.reaction(2).rate, 1e15, 0, 50 * kelvinPerCalorie);
  EXPECT_FALSE(mechanism.reaction(3).reversible);
  EXPECT_TRUE(mechanism.reaction(3).duplicate);
  expectRate(mechanism.reaction(4).rate, -1e14, 0, 0);
}

TEST(ChemkinReaction, Units) {
  const struct {
    const char* units;
    double A, Ta;
  } forms[] = {
      {"", 1e14, kelvinPerCalorie},
      {"CAL/MOLE MOLES", 1e14, kelvinPerCalorie},
      {"kcal/mole", 1e14, 1e3 * kelvinPerCalorie},
      {"JOULES/MOLE", 1e14, 1 / kR},
      {"KJOULES/MOLE", 1e14, 1e3 / kR},
      {"Kelvins", 1e14, 1},
      {"EVOLTS", 1e14, 11604.518121550082},                   // e/k_B
      {"MOLECULES", 1e14 * 6.02214076e23, kelvinPerCalorie},  // cm3/molecule/s
      {"KELVINS molecules", 1e14 * 6.02214076e23, 1},
      {"JOUL/MOLE", 1e14, 1 / kR},
      {"kj/mol", 1e14, 1e3 / kR},
      {"MOLECULES, KELVINS", 1e14 * 6.02214076e23, 1},
      {"MOLES,KCAL/MOLE", 1e14, 1e3 * kelvinPerCalorie},
  };
  for (const auto& form : forms) {
    SCOPED_TRACE(form.units);
    const auto mechanism = readChemkinReactions(form.units + std::string("\nH+O2=O+OH 1.0E14 0 1.0"));
    expectRate(mechanism.reaction(0).rate, form.A * 1e-6, 0, form.Ta);
    if (std::string(form.units).empty()) continue;
    const auto own = readChemkinReactions("JOULES/MOLE\nH2+O2=2OH 1.0 0 1.0\nH+O2=O+OH 1.0E14 0 1.0\n UNITS/" +
                                          std::string(form.units) + "/");
    expectRate(own.reaction(0).rate, 1e-6, 0, 1 / kR);
    const bool noEnergy = std::string(form.units) == "MOLECULES";
    expectRate(own.reaction(1).rate, form.A * 1e-6, 0, noEnergy ? 1 / kR : form.Ta);
  }
}

TEST(ChemkinReaction, ThirdBodies) {
  const auto mechanism = readChemkinReactions(
      "\n2H+M=H2+M 1.0E18 -1.0 0.\n H2O/6.0/ AR/.7/\nH2/0/N2 / 2 /\n"
      "H+O2+AR=HO2+AR 1E18 0 0\n"
      "H+O2 (+H2O) = HO2 ( +H2O ) 1E12 0 0\nlow/2E18 -1 100/\n"
      "CH2(S)+H2(+CH2(S))=CH4(+CH2(S)) 1E12 0 0\nLOW/2E18 -1 100/");
  const auto& body = *mechanism.reaction(0).thirdBody;
  EXPECT_EQ(body.defaultEfficiency, 1);
  EXPECT_EQ(terms(mechanism, body.efficiencies), "6 H2O 0.7 AR 0 H2 2 N2 ");
  EXPECT_EQ(mechanism.reaction(1).type, Reaction::Type::Elementary);
  expectRate(mechanism.reaction(1).rate, 1e6, 0, 0);
  EXPECT_EQ(mechanism.reaction(2).equation, "H + O2 (+H2O) <=> HO2 (+H2O)");
  EXPECT_EQ(mechanism.reaction(2).thirdBody->defaultEfficiency, 0);
  EXPECT_EQ(terms(mechanism, mechanism.reaction(2).thirdBody->efficiencies), "1 H2O ");
  EXPECT_EQ(mechanism.reaction(3).equation, "CH2(S) + H2 (+CH2(S)) <=> CH4 (+CH2(S))");
}

TEST(ChemkinReaction, FallOff) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinReactions(
      "\n2CH3(+M)=C2H6(+M) 6.0E13 -0.5 620.\n LOW / 3.0E41 -7.0 2760. / TROE/ 0.62 73. 1180. 9999. /\n H2O/6/\n"
      "CH3+H(+M)=CH4(+M) 1E13 0 0\nLOW/1E30 -4 0/\nTROE/0.5 100 1E5/\n"
      "2OH(+M)=H2O2(+M) 1E13 0 0\nLOW/1E18 0 0/\n"
      "H+O2(+M)=HO2(+M) 1E13 0 0\nLOW/1E18 0 0/\nSRI/0.45 797. 979./\n"
      "CH2+H2(+M)=CH4(+M) 1E13 0 0\nLOW/1E18 0 0/\nSRI/0.45 797. 979. 1.5 0.25/\n"
      "H+OH(+M)=H2O(+M) 1E13 0 0\nLOW/1E18 0 0/\nTROE/0.5 100 1E5 0/",
      &warnings);
  const auto& troe = mechanism.reaction(0);
  EXPECT_EQ(troe.type, Reaction::Type::Falloff);
  EXPECT_EQ(troe.equation, "2 CH3 (+M) <=> C2H6 (+M)");
  expectRate(troe.rate, 6e7, -0.5, 620 * kelvinPerCalorie);
  expectRate(troe.lowPressureRate, 3e29, -7, 2760 * kelvinPerCalorie);
  EXPECT_EQ(troe.troe->A, 0.62);
  EXPECT_EQ(troe.troe->T3, 73);
  EXPECT_EQ(troe.troe->T1, 1180);
  EXPECT_EQ(troe.troe->T2.value(), 9999);
  EXPECT_EQ(terms(mechanism, troe.thirdBody->efficiencies), "6 H2O ");
  EXPECT_FALSE(mechanism.reaction(1).troe->T2);
  EXPECT_FALSE(mechanism.reaction(2).troe);
  const auto& sri = *mechanism.reaction(3).sri;
  EXPECT_EQ(sri.a, 0.45);
  EXPECT_EQ(sri.b, 797);
  EXPECT_EQ(sri.c, 979);
  EXPECT_EQ(sri.d, 1);
  EXPECT_EQ(sri.e, 0);
  EXPECT_EQ(mechanism.reaction(4).sri->d, 1.5);
  EXPECT_EQ(mechanism.reaction(4).sri->e, 0.25);
  EXPECT_FALSE(mechanism.reaction(5).troe->T2);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("chem.inp:20: reaction 'H+OH(+M)=H2O(+M)': T2 of zero"));
}

TEST(ChemkinReaction, FallOffWhoseCentreIsZero) {
  std::vector<std::string> warnings;
  readChemkinReactions(
      "\nCH3+H(+M)=CH4(+M) 1E13 0 0\nLOW/1E30 -4 0/\nTROE/0.5 0 0/\n2OH(+M)=H2O2(+M) 1E13 0 0\nLOW/1E18 0 0/\n"
      "TROE/0.5 1E-30 1E30/\n2CH3(+M)=C2H6(+M) 1E13 0 0\nLOW/1E18 0 0/\nTROE/0 0 1E30 100/\n"
      "H+OH(+M)=H2O(+M) 1E13 0 0\nLOW/1E18 0 0/\nTROE/1 1E30 1E-30/",
      &warnings);
  EXPECT_THAT(warnings,
              ::testing::ElementsAre(
                  AllOf(HasSubstr("chem.inp:6: reaction 'CH3 + H (+M) <=> CH4 (+M)'"),
                        HasSubstr("T3 = 0 and T1 = 0 the centre of its fall-off is zero at all temperatures")),
                  HasSubstr("reaction 'H + OH (+M) <=> H2O (+M)': with T3 = 1e+30 and T1 = 1e-30")));
}

// The line of the equation holds the low-pressure limit, of the reaction's own order; HIGH is one order lower.
TEST(ChemkinReaction, ChemicallyActivated) {
  const auto mechanism =
      readChemkinReactions("\nCH3+OH(+M)=CH2(S)+H2O(+M) 1.5E12 0.5 -100.\n HIGH/ 4E7 1.5 2000/\nTROE/.5 1 2 3/");
  const auto& reaction = mechanism.reaction(0);
  EXPECT_EQ(reaction.type, Reaction::Type::ChemicallyActivated);
  expectRate(reaction.lowPressureRate, 1.5e6, 0.5, -100 * kelvinPerCalorie);
  expectRate(reaction.rate, 4e7, 1.5, 2000 * kelvinPerCalorie);
  EXPECT_EQ(reaction.troe->T2.value(), 3);
}

TEST(ChemkinReaction, PressureLog) {
  const auto mechanism = readChemkinReactions(
      "\nCH3+H=CH2+H2 1E1 0 0\nPLOG/10. 3E13 0 30/\nPLOG / 0.1 1E13 1 10/\nPLOG/10. 5E12 0.5 50/\nPLOG/1 2E13 0 20/");
  const auto& reaction = mechanism.reaction(0);
  EXPECT_EQ(reaction.type, Reaction::Type::PressureLog);
  EXPECT_FALSE(reaction.thirdBody);
  const double expected[][4] = {{0.1, 1e7, 1, 10}, {1, 2e7, 0, 20}, {10, 3e7, 0, 30}, {10, 5e6, 0.5, 50}};
  ASSERT_EQ(reaction.pressureRates.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(reaction.pressureRates[i].pressure, expected[i][0] * constants::oneAtmosphere);
    expectRate(reaction.pressureRates[i].rate, expected[i][1], expected[i][2], expected[i][3] * kelvinPerCalorie);
  }
}

// The constants of the table are those of a reaction without [M].
TEST(ChemkinReaction, PressureLogWithMIsOneOfTheMixture) {
  std::vector<std::string> warnings;
  const auto mechanism =
      readChemkinReactions("\nH2O+M=H+OH+M 1 0 0\nPLOG/0.1 3E13 0 30/\nPLOG/10 2E14 1 20/", &warnings);
  const auto& reaction = mechanism.reaction(0);
  EXPECT_EQ(reaction.type, Reaction::Type::PressureLog);
  EXPECT_FALSE(reaction.thirdBody);
  expectRate(reaction.pressureRates[0].rate, 3e13, 0, 30 * kelvinPerCalorie);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("chem.inp:6: reaction 'H2O+M=H+OH+M': '+M' is taken as '(+M)'"));
}

TEST(ChemkinReaction, Chebyshev) {
  const auto mechanism = readChemkinReactions(
      "\nCH3+H(+M)=CH4(+M) 1 0 0\nTCHEB/290 3000/ PCHEB/0.01 10/\nCHEB/2 3 8.25 -0.5/\nCHEB/ 0.125 1 2/\nCHEB/3/\n"
      "H2O2=2OH 1 0 0\nCHEB/ 1 2 5. 6. /");
  const auto& rate = *mechanism.reaction(0).chebyshev;
  EXPECT_EQ(mechanism.reaction(0).type, Reaction::Type::Chebyshev);
  EXPECT_EQ(mechanism.reaction(0).equation, "CH3 + H <=> CH4");
  EXPECT_EQ(rate.minTemperature, 290);
  EXPECT_EQ(rate.maxTemperature, 3000);
  EXPECT_DOUBLE_EQ(rate.minPressure, 0.01 * constants::oneAtmosphere);
  EXPECT_DOUBLE_EQ(rate.maxPressure, 10 * constants::oneAtmosphere);
  EXPECT_EQ(rate.numTemperature, 2U);
  EXPECT_EQ(rate.numPressure, 3U);
  EXPECT_NEAR(rate.coefficients[0], 2.25, 1e-14);  // 1 cm3/mol/s = 10^-6 m3/mol/s
  EXPECT_EQ(std::vector<double>(rate.coefficients.begin() + 1, rate.coefficients.end()),
            (std::vector<double>{-0.5, 0.125, 1, 2, 3}));
  const auto& standard = *mechanism.reaction(1).chebyshev;
  EXPECT_EQ(standard.coefficients, (std::vector<double>{5, 6}));  // 1/s has no unit to convert
  EXPECT_EQ(standard.minTemperature, 300);
  EXPECT_EQ(standard.maxTemperature, 2500);
  EXPECT_DOUBLE_EQ(standard.minPressure, 0.001 * constants::oneAtmosphere);
  EXPECT_DOUBLE_EQ(standard.maxPressure, 100 * constants::oneAtmosphere);
}

TEST(ChemkinReaction, ReverseRatesMakeTwoIrreversibleReactions) {
  const auto mechanism = readChemkinReactions(
      "\nH+O2=O+OH 2.0E14 0 16600\n REV/ 3E13 0.5 100 /\n"
      "2H+M=H2+M 1.0E18 0 0\n H2O/6/ REV/5E14 0 1E5/\n"
      "H2O2=2OH 1.D15 0 50.\nREV/0 0 0/");
  ASSERT_EQ(mechanism.numReactions(), 5U);
  EXPECT_EQ(mechanism.reaction(0).equation, "H + O2 => O + OH");
  EXPECT_EQ(mechanism.reaction(1).equation, "O + OH => H + O2");
  expectRate(mechanism.reaction(1).rate, 3e7, 0.5, 100 * kelvinPerCalorie);
  EXPECT_EQ(mechanism.reaction(3).equation, "H2 + M => 2 H + M");
  expectRate(mechanism.reaction(3).rate, 5e8, 0, 1e5 * kelvinPerCalorie);
  EXPECT_EQ(terms(mechanism, mechanism.reaction(3).thirdBody->efficiencies), "6 H2O ");
  EXPECT_EQ(mechanism.reaction(4).equation, "H2O2 => 2 OH");
}

// Two marked reactions, one of which goes only one way: the direction that is alone is no duplicate.
TEST(ChemkinReaction, DuplicatesWithReverseRates) {
  const auto mechanism = readChemkinReactions(
      "\nH+O2=O+OH 2.0E14 0 16600\n REV/ 3E13 0.5 100 /\nDUP\nH+O2=O+OH 1.0E10 0 0\nREV/0 0 0/ DUPLICATE");
  ASSERT_EQ(mechanism.numReactions(), 3U);
  EXPECT_TRUE(mechanism.reaction(0).duplicate);
  EXPECT_FALSE(mechanism.reaction(1).duplicate);
  EXPECT_TRUE(mechanism.reaction(2).duplicate);
}

TEST(ChemkinReaction, OrdersOfTheirOwn) {
  const auto mechanism = readChemkinReactions(
      "\nCH4+O2=>CH2+H2O+O 1.0E10 0 0\nFORD/CH4 0.5/ FORD / O2 1.25 /\n ford/H2O -0.5/\n"
      "H+O2=O+OH 2.0E14 0 0\nREV/3E13 0 0/ FORD/H 1/ FORD/O2 2/ RORD/OH 0.5/\n"
      "C5H5O(1,3)=>C5H5O(1,3) 1 0 0\nFORD/C5H5O(1,3) 2/");
  const auto& global = mechanism.reaction(0);
  EXPECT_EQ(terms(mechanism, global.orders), "0.5 CH4 1.25 O2 -0.5 H2O ");
  EXPECT_NEAR(global.rate.A, 1e10 * std::pow(1e-6, 0.25), 1e-4);  // order 1.25
  const auto &forward = mechanism.reaction(1), &reverse = mechanism.reaction(2);
  EXPECT_EQ(terms(mechanism, forward.orders), "2 O2 ");
  expectRate(forward.rate, 2e14 * 1e-12, 0, 0);
  EXPECT_EQ(terms(mechanism, reverse.orders), "0.5 OH ");
  EXPECT_NEAR(reverse.rate.A, 3e13 * 1e-3, 1e-3);  // order 1.5
  EXPECT_EQ(terms(mechanism, mechanism.reaction(3).orders), "2 C5H5O(1,3) ");
}

TEST(ChemkinReaction, NamesThatMakeEquationsHardToRead) {
  const struct {
    const char *text, *equation;
  } forms[] = {
      {"H+O2=O+OH", "H + O2 <=> O + OH"},
      {" H + O2  <=> O\t+ OH", "H + O2 <=> O + OH"},
      {"2OH=>O+H2O", "2 OH => O + H2O"},
      {"OH+OH=H2O+O", "2 OH <=> H2O + O"},
      {"0.5O2+H=0.5H2O2", "0.5 O2 + H <=> 0.5 H2O2"},
      {"1.5 O2 + 1H2 = H2O2 + .5O2", "1.5 O2 + H2 <=> H2O2 + 0.5 O2"},
      {"NO++E=NO", "NO+ + E <=> NO"},
      {"NO=NO++E", "NO <=> NO+ + E"},
      {"NO+E+H=NO+H+E", "NO + E + H <=> NO + H + E"},
      {"2-C4H8=C4H8", "2-C4H8 <=> C4H8"},
      {"22-C4H8=2C4H8", "2 2-C4H8 <=> 2 C4H8"},
      {"C=C=C2H4", "C=C <=> C2H4"},
      {"C2H4=>C=C", "C2H4 => C=C"},
      {"2C=C<=>C2H4+C=C", "2 C=C <=> C2H4 + C=C"},
      {"CH2(S)+M=CH2+M", "CH2(S) + M <=> CH2 + M"},
      {"C5H5O(1,3)+H=C5H5O(1,3)+H", "C5H5O(1,3) + H <=> C5H5O(1,3) + H"},
  };
  for (const auto& form : forms) {
    SCOPED_TRACE(form.text);
    const auto mechanism = readChemkinReactions(std::string("\n") + form.text + " 1.0 0 0");
    EXPECT_EQ(mechanism.reaction(0).equation, form.equation);
  }
}

TEST(ChemkinReaction, LinesThatGoOn) {
  const auto mechanism = readChemkinReactions(
      "\nH+O2 & ! the products follow\n =O+OH & \n 2.0E14 -0.4 16600\n"
      "2H+M=H2+M 1.0E18 -1.0 0.   ! and what they say\nH2O/6.0/ & \n N2/2.0/\n"
      "C=C+M=C2H4+M 1 0 0\nC=C/2.0/ C2H4/3/ ! a name with '=' in front of a slash is no reaction");
  ASSERT_EQ(mechanism.numReactions(), 3U);
  expectRate(mechanism.reaction(0).rate, 2e8, -0.4, 16600 * kelvinPerCalorie);
  EXPECT_EQ(terms(mechanism, mechanism.reaction(1).thirdBody->efficiencies), "6 H2O 2 N2 ");
  EXPECT_EQ(terms(mechanism, mechanism.reaction(2).thirdBody->efficiencies), "2 C=C 3 C2H4 ");
}

TEST(ChemkinReaction, CoefficientsWithExponents) {
  const auto mechanism = readChemkinReactions(
      "\nH2+O2=>1.9E0OH+.5E-1H2+5.0E-2O2 1E10 0 0\n"
      "2E-1C4H8+1d0O=>2.0D-1 2-C4H8+O 1 0 0\n"
      "NO=NO++E 1 0 0\nNO+E=>NO++2E 1 0 0");
  EXPECT_EQ(terms(mechanism, mechanism.reaction(0).products), "1.9 OH 0.05 H2 0.05 O2 ");
  EXPECT_EQ(terms(mechanism, mechanism.reaction(1).reactants), "0.2 C4H8 1 O ");
  EXPECT_EQ(terms(mechanism, mechanism.reaction(1).products), "0.2 2-C4H8 1 O ");
  // An E that is a species, and no exponent.
  EXPECT_EQ(terms(mechanism, mechanism.reaction(3).products), "1 NO+ 2 E ");
}

// Light that leaves the gas is a note: a reaction of the order of its reactants, and irreversible.
TEST(ChemkinReaction, LightAmongTheProducts) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinReactions(
      "\nCH2(S)=>CH2+hv 1.45E6 0 0\nDUP\nCH2(S)<=>HV+CH2 2E6 0 0\nHV/300/\nDUP\nCH2(S)=>CH2 2E6 0 0\nDUP", &warnings);
  ASSERT_EQ(mechanism.numReactions(), 3U);
  expectRate(mechanism.reaction(0).rate, 1.45e6, 0, 0);
  for (const auto& reaction : mechanism.reactions()) {
    EXPECT_FALSE(reaction.reversible);
    EXPECT_EQ(reaction.equation, "CH2(S) => CH2");
  }
  EXPECT_THAT(warnings,
              ::testing::ElementsAre(HasSubstr("chem.inp:6: reaction 'CH2(S)=>CH2+hv': the light (hv) is passed "
                                               "over"),
                                     HasSubstr("irreversible, as if written with '=>'")));
}

TEST(ChemkinReaction, ALastSlashMayBeMissing) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinReactions(
      "\nH+OH+M=H2O+M 1 0 0\nH2/2.0/ O2/0.4\nH+OH=H2O 1 0 0\nPLOG/1 2 0 0\nPLOG/10 3 0 0/", &warnings);
  EXPECT_EQ(terms(mechanism, mechanism.reaction(0).thirdBody->efficiencies), "2 H2 0.4 O2 ");
  EXPECT_EQ(mechanism.reaction(1).pressureRates.size(), 2U);
  EXPECT_THAT(warnings, ::testing::ElementsAre(HasSubstr("chem.inp:7: the last '/' behind the values of 'O2'"),
                                               HasSubstr("chem.inp:9: ")));
}

// A sum of tables written as two reactions of which one is negative or zero somewhere.
TEST(ChemkinReaction, TablesThatArePositiveTogether) {
  std::vector<std::string> warnings;
  const auto joined = readChemkinReactions(
      "\nH2+OH=2H+OH 1 0 0\nPLOG/0.1 1E12 0 0/\nPLOG/10 3E12 0 0/\nDUP\n"
      "H+O2=O+OH 1 0 0\n"
      "H2+OH=2H+OH 1 0 0\nPLOG/0.1 -2E11 0 0/\nPLOG/10 0 0 0/\nDUPLICATE",
      &warnings);
  ASSERT_EQ(joined.numReactions(), 2U);
  EXPECT_EQ(joined.reaction(1).equation, "H + O2 <=> O + OH");
  const auto& rates = joined.reaction(0).pressureRates;
  ASSERT_EQ(rates.size(), 3U);
  EXPECT_EQ(rates[0].pressure, rates[1].pressure);
  EXPECT_NEAR(rates[0].rate.A + rates[1].rate.A, 8e5, 1e-8);
  EXPECT_NEAR(rates[2].rate.A, 3e6, 1e-8);
  EXPECT_FALSE(joined.reaction(0).duplicate);
  EXPECT_THAT(warnings, ::testing::ElementsAre(HasSubstr("chem.inp:6: reaction 'H2 + OH <=> 2 H + OH': its rates and "
                                                         "those of its duplicate at line 11 are added")));
  // Where all are positive each stays for itself.
  const auto apart =
      readChemkinReactions("\nH+OH=H2O 1 0 0\nPLOG/1 1 0 0/\nDUP\nH+OH=H2O 1 0 0\nPLOG/10 2 0 0/\nDUP", &warnings);
  EXPECT_EQ(apart.numReactions(), 2U);
  EXPECT_THAT(warnings, ::testing::IsEmpty());
  // A third of another kind keeps its partner.
  const auto three = readChemkinReactions(
      "\nH+OH=H2O 1 0 0\nPLOG/1 3 0 0/\nDUP\nH+OH=H2O 1 0 0\nPLOG/1 -2 0 0/\nDUP\nH2O=H+OH 1 0 0\nDUP", &warnings);
  ASSERT_EQ(three.numReactions(), 2U);
  EXPECT_TRUE(three.reaction(0).duplicate);
  EXPECT_TRUE(three.reaction(1).duplicate);
}

TEST(ChemkinReaction, ATableOfZerosIsARateOfZero) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinReactions("\nH+OH=H2O 1 0 0\nPLOG/0.1 0 0 0/\nPLOG/1 0 0 0/", &warnings);
  EXPECT_EQ(mechanism.reaction(0).type, Reaction::Type::Elementary);
  expectRate(mechanism.reaction(0).rate, 0, 0, 0);
  EXPECT_THAT(warnings,
              ::testing::ElementsAre(HasSubstr("chem.inp:6: reaction 'H + OH <=> H2O': the rate constants are "
                                               "zero at all pressures")));
}

// Marks of duplicates that are missing, or too many.
TEST(ChemkinReaction, MarksOfDuplicates) {
  std::vector<std::string> warnings;
  const auto marked = readChemkinReactions(
      "\nH2+OH=>2H+OH 1E10 0 0\nDUP\nH2+OH=>2H+OH 2E10 0 0\nDUP\n2H+OH=>H2+OH 2E10 0 0\nDUP\nH+O2=O+OH 1 0 0\nDUP",
      &warnings);
  EXPECT_TRUE(marked.reaction(0).duplicate);
  EXPECT_TRUE(marked.reaction(1).duplicate);
  EXPECT_FALSE(marked.reaction(2).duplicate);
  EXPECT_FALSE(marked.reaction(3).duplicate);
  EXPECT_THAT(warnings, ::testing::ElementsAre(HasSubstr("chem.inp:10: reaction '2 H + OH => H2 + OH' is marked as a "
                                                         "duplicate, but there is no other"),
                                               HasSubstr("chem.inp:12: ")));
  const std::string text = lampblack::test::chemkinHead() +
                           "REACTIONS\nH2+O2=OH+OH 1.7E13 0 47780\nOH+OH=H2+O2 1E9 0 0\nO+H2=H+OH 1 0 0\n"
                           "H2+O2=2OH 1 0 0\nH+OH+M=H2O+M 1 0 0\n H2/2/ XE/3/ O2/0.5/\nEND\n";
  const ChemkinText thermo{"therm.dat", lampblack::test::chemkinThermo()};
  EXPECT_THROW(parseChemkin({"chem.inp", text}, thermo, std::nullopt), InputError);
  const auto permissive = parseChemkin({"chem.inp", text}, thermo, std::nullopt, true);
  ASSERT_EQ(permissive.numReactions(), 5U);
  EXPECT_EQ(permissive.reaction(4).thirdBody->efficiencies.size(), 2U);
  for (const std::size_t r : {0, 1, 3}) EXPECT_TRUE(permissive.reaction(r).duplicate);
  EXPECT_FALSE(permissive.reaction(2).duplicate);
  expectRate(permissive.reaction(1).rate, 1e3, 0, 0);
  EXPECT_THAT(
      permissive.warnings(),
      ::testing::ElementsAre(HasSubstr("chem.inp:11: reaction 'H+OH+M=H2O+M': the efficiency of 'XE' is left out"),
                             HasSubstr("chem.inp:7: reaction '2 OH <=> H2 + O2' is marked as a duplicate: it is the "
                                       "same as 'H2 + O2 <=> 2 OH' at line 6"),
                             HasSubstr("chem.inp:9: ")));
}

}  // namespace
