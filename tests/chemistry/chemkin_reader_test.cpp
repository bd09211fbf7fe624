// Sections and thermodynamic cards of CHEMKIN files, tidy and untidy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "chemistry/mechanism/elements.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/chemkin_support.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::chemkinThermo;
using lampblack::test::readChemkinText;
using lampblack::test::thermoCards;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::array<double, 7> kHigh{2.5, 1e-3, 0, 0, 0, -1000, 4};
const std::array<double, 7> kLow{1.5, 2e-3, 0, 0, 0, -500, 9.90775528};

TEST(ChemkinReader, ElementsWithWeightsOfTheirOwn) {
  const auto mechanism = readChemkinText("elements h d /2.014/ E/5.5E-4/\n AR HE\nspecies H AR end", nullptr);
  ASSERT_EQ(mechanism.numElements(), 5U);
  EXPECT_EQ(mechanism.elementName(3), "Ar");  // as the YAML format has it
  EXPECT_EQ(mechanism.atomicWeight(0), *standardAtomicWeight("H"));
  EXPECT_EQ(mechanism.atomicWeight(1), 2.014 * 1e-3);
  EXPECT_EQ(mechanism.atomicWeight(2), 5.5e-4 * 1e-3);
  EXPECT_EQ(mechanism.elementName(4), "He");
  // Without a weight, an electron is one of CODATA 2018: 5.485 799 090 65e-4 g/mol.
  EXPECT_NEAR(readChemkinText("ELEM E H END SPEC H END").atomicWeight(0), 5.48579909065e-7, 1e-20);
}

TEST(ChemkinReader, SectionsMayBeShortAndLackTheirEnds) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinText(
      "! of somebody\nELEM\nH O\nH\nSPECIE\nH2 O2\nOH H2\nther\n" + thermoCards("OH", "H   1O   1") +
          thermoCards("H2", "H   2") +
          "TRANSP\nO2 1 107.4 3.458 0 1.6 3.8\nREAC\nH2+O2=2OH 1E13 0 0\nEND\nno more than a note\nand another\n",
      &warnings, thermoCards("O2", "O   2"));
  EXPECT_EQ(mechanism.numSpecies(), 3U);
  EXPECT_EQ(mechanism.numReactions(), 1U);
  EXPECT_EQ(mechanism.description(), "of somebody");
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("chem.inp:22:"), HasSubstr("text behind END is ignored")),
                                    AllOf(HasSubstr("chem.inp:4:"), HasSubstr("element 'H' is declared twice")),
                                    AllOf(HasSubstr("chem.inp:7:"), HasSubstr("'H2' is declared already in line 6")),
                                    HasSubstr("no transport data for 2 of 3 species: H2, OH")));
}

// Behind the END of REACTIONS there may be notes, also such as begin like a section or look like a reaction.
TEST(ChemkinReader, TextBehindTheReactionsIsPassedOver) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinText(
      "ELEM H O END SPEC H2 O2 OH END\nREAC\nH2+O2=2OH 1E13 0 0\nEND\n\nSources of the rates\n"
      "Species such as H2 and XY follow\nReactions of [1]: 1 kcal = 4.184 kJ\nThermo from [2]\nEND\n"
      "2OH=H2+O2 1E10 0 0\n",
      &warnings);
  EXPECT_EQ(mechanism.numReactions(), 1U);
  EXPECT_EQ(mechanism.numSpecies(), 3U);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("chem.inp:6:"), HasSubstr("text behind END is ignored")),
                                    AllOf(HasSubstr("chem.inp:11:"),
                                          HasSubstr("a reaction behind END is ignored: '2OH=H2+O2 1E10 0 0'"))));
  EXPECT_EQ(readChemkinText("ELEM H END SPEC H END", &warnings,
                            "THERMO\n" + thermoCards("H", "H   1") + "END\nReactions of H = H, see 1 2 3\n")
                .numSpecies(),
            1U);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("therm.dat:7:"), HasSubstr("a reaction behind END is ignored"))));
  // Data may follow the reactions.
  EXPECT_EQ(readChemkinText("ELEM H END SPEC H END REAC\nEND\nTHERMO ALL\n" + thermoCards("H", "H   1"), nullptr,
                            std::nullopt)
                .species(0)
                .thermo.maxTemperature,
            5000);
}

// As Fortran reads it: " 2.50000000E+00\t1.00000000E-03". Tabulators to the next of every eight columns: Tabulators.
TEST(ChemkinReader, ATabulatorIsOneColumn) {
  auto text = thermoCards("H2", "H   2");
  text.replace(96, 1, "\t");
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinText("ELEM H END SPEC H2 END", &warnings, text);
  EXPECT_EQ(mechanism.species(0).thermo.high[0], 2.5);
  EXPECT_EQ(mechanism.species(0).thermo.high[1], 1e-3);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("therm.dat:2:"), HasSubstr("taken as one column"))));
}

TEST(ChemkinReader, ThePhaseInTheFieldOfAFourthElement) {
  for (const std::string field : {"              G ", "             G  ", "            0 G ", "          0 0 G "}) {
    std::vector<std::string> warnings;
    const auto mechanism =
        readChemkinText("ELEM H END SPEC H2 END", &warnings, thermoCards("H2", "H   2").replace(29, 16, field));
    EXPECT_EQ(mechanism.atoms(0, 0), 2) << field;
    EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("therm.dat:1:"), HasSubstr("'G'"), HasSubstr("column 45"))));
  }
}

// cp/R = a1/T^2 + ... + a7 T^4, of two ranges and of a record that is not wanted between them.
TEST(ChemkinReader, Nasa9) {
  const auto record = [](const std::string& name, const std::string& elements) {
    return name + " a comment\n 2 note   " + elements +
           "    0.00    0.00    0.00 0   18.0152800          0.000\n"
           "    200.000   1000.0007 -2.0 -1.0  0.0  1.0  2.0  3.0  4.0  0.0         6197.428\n"
           " 1.000000000D+03-2.000000000D+00 4.000000000D+00 1.000000000D-03 2.000000000D-06\n"
           "-3.000000000D-10 4.000000000D-14                -3.000000000D+04 5.000000000D+00\n"
           "   1000.000   6000.0007 -2.0 -1.0  0.0  1.0  2.0  3.0  4.0  0.0         6197.428\n"
           "\t0.000000000D+00 0.000000000D+00 7.000000000D+00 0.000000000D+00 0.000000000D+00\n"
           " 0.000000000D+00 0.000000000D+00                -3.100000000D+04 6.000000000D+00\n";
  };
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinText(
      "ELEM H O END SPEC H2O H2 END\nTHERMO NASA9 ALL\n   200.000  1000.000  6000.000 20000.000   1/01/26\n" +
          record("XY", "X   2.00Y   1.00") + record("H2O", "H   2.00O   1.00") + record("H2O", "H   2.00O   1.00") +
          "END\n",
      &warnings, thermoCards("H2", "H   2"));
  ASSERT_TRUE(mechanism.species(0).nasa9);
  EXPECT_FALSE(mechanism.species(1).nasa9);
  const auto& data = *mechanism.species(0).nasa9;
  EXPECT_THAT(data.temperatures, ElementsAre(200, 1000, 6000));
  EXPECT_THAT(data.ranges[0], ElementsAre(1000, -2, 4, 1e-3, 2e-6, -3e-10, 4e-14, -3e4, 5));
  EXPECT_THAT(data.ranges[1], ElementsAre(0, 0, 7, 0, 0, 0, 0, -3.1e4, 6));
  EXPECT_EQ(mechanism.species(0).thermo.maxTemperature, 6000);
  EXPECT_EQ(mechanism.atoms(0, *mechanism.findElement("H")), 2);
  EXPECT_EQ(mechanism.atoms(0, *mechanism.findElement("O")), 1);
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("'H2O' has thermodynamic data already at chem.inp:12")));
}

// What a mechanism says itself goes before the separate files; neither is a duplicate.
TEST(ChemkinReader, DataOfTheMechanismGoFirst) {
  std::vector<std::string> warnings;
  const auto mechanism = readChemkinText(
      "ELEM H END SPEC H2 H END\nTHERMO\n" + thermoCards("H2", "H   2", "   200.000  6000.000 1000.00") +
          "END\nTRANSPORT\nH2 1 40 3 0 0 300\nEND",
      &warnings, thermoCards("H2", "H   2") + thermoCards("H", "H   1") + thermoCards("H", "H   1"),
      "H2 1 38. 2.92 0.0 .79 280. ! a comment\nH 0 145 2.05 0 0 0 Warnatz\nXX what\nH 0 145 2.05 0 0 0\nEND");
  EXPECT_EQ(mechanism.species(0).thermo.minTemperature, 200);
  EXPECT_EQ(mechanism.species(0).transport->wellDepth, 40);
  EXPECT_EQ(mechanism.species(1).transport->shape, MoleculeShape::Atom);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("therm.dat:9:"), HasSubstr("'H' has thermodynamic data already at "
                                                                               "therm.dat:5; the first holds")),
                                    AllOf(HasSubstr("tran.dat:4:"), HasSubstr("at tran.dat:2"))));
}

// `chem.inp tran.dat`: with THERMO in the mechanism the second file may be the transport data.
// One species, the given text as its data.
Mechanism withThermo(const std::string& thermo, std::vector<std::string>* warnings = nullptr,
                     const std::string& name = "CH4") {
  return readChemkinText("ELEMENTS C H O N AR SI END SPECIES " + name + " END", warnings, thermo);
}

void expectMethane(const Mechanism& mechanism) {
  const auto& species = mechanism.species(0);
  EXPECT_EQ(mechanism.atoms(0, 0), 1);
  EXPECT_EQ(mechanism.atoms(0, 1), 4);
  EXPECT_NEAR(species.molecularWeight, 0.012011 + 4 * 0.001008, 1e-16);
  EXPECT_EQ(species.thermo.high, kHigh);
  EXPECT_EQ(species.thermo.low, kLow);
  EXPECT_EQ(species.thermo.minTemperature, 300);
  EXPECT_EQ(species.thermo.midTemperature, 1000);
  EXPECT_EQ(species.thermo.maxTemperature, 5000);
}

TEST(ChemkinThermo, Columns) {
  for (const char* header :
       {"THERMO ALL\n 200. 1000. 6000.\n", "THERMO\n", "", "thermo all\n 200 1000 6000 9/9/99\n"}) {
    SCOPED_TRACE(header);
    std::vector<std::string> warnings;
    expectMethane(withThermo(header + thermoCards("CH4 of somebody", "C   1H   4"), &warnings));
    EXPECT_THAT(warnings, IsEmpty());
  }
}

TEST(ChemkinThermo, BlankTemperaturesAreTheDefaults) {
  const auto read = [](const std::string& header, const std::string& temperatures) {
    const auto T = withThermo(header + thermoCards("CH4", "C   1H   4", temperatures)).species(0).thermo;
    return std::vector<double>{T.minTemperature, T.midTemperature, T.maxTemperature};
  };
  const std::string header = "THERMO\n   250.000  1200.000  4000.000\n";
  EXPECT_THAT(read(header, "   300.000  5000.000"), ElementsAre(300, 1200, 5000));
  EXPECT_THAT(read(header, ""), ElementsAre(250, 1200, 4000));
  EXPECT_THAT(read("THERMO\n", "   300.000  5000.000"), ElementsAre(300, 1000, 5000));
  EXPECT_THAT(read(header, "   300.000  5000.0001391.500"), ElementsAre(300, 1391.5, 5000));
  // Out of their columns.
  EXPECT_THAT(read(header, " 300.  5000.  1391."), ElementsAre(300, 1391, 5000));
  EXPECT_THAT(read(header, "     0300.00   5000.00  1391.00"), ElementsAre(300, 1391, 5000));
}

TEST(ChemkinThermo, ElementsInEveryForm) {
  const auto atoms = [](const std::string& thermo) {
    const auto mechanism = withThermo(thermo);
    return mechanism.species(0).atoms;  // of C, H, O, N, Ar, Si
  };
  EXPECT_THAT(atoms(thermoCards("CH4", "C   1H   4O   2N   3")), ElementsAre(1, 4, 2, 3, 0, 0));
  EXPECT_THAT(atoms(thermoCards("CH4", "c  1.h  4.     0    0")), ElementsAre(1, 4, 0, 0, 0, 0));
  EXPECT_THAT(atoms(thermoCards("CH4", "C   1H   400  0AR  0")), ElementsAre(1, 4, 0, 0, 0, 0));
  EXPECT_THAT(atoms(thermoCards("CH4", "C 1  H 4  SI01.N 0.5")), ElementsAre(1, 4, 0, 0.5, 0, 1));
  EXPECT_THAT(atoms(thermoCards("CH4", "C  10H  20")), ElementsAre(10, 20, 0, 0, 0, 0));
  // The fifth element, in columns 74 to 78.
  auto cards = thermoCards("CH4", "C   1H   4O   2N   3");
  cards.replace(73, 5, "AR  5");
  EXPECT_THAT(atoms(cards), ElementsAre(1, 4, 2, 3, 5, 0));
  // Behind column 80, in fields of ten or free; a note there is none of them.
  cards = thermoCards("CH4", "C   0H   0");
  EXPECT_THAT(atoms(cards.substr(0, 80) + "C      1250H       812" + cards.substr(80)),
              ElementsAre(1250, 812, 0, 0, 0, 0));
  EXPECT_THAT(atoms(cards.substr(0, 80) + " C 12 H 120 O2.5" + cards.substr(80)), ElementsAre(12, 120, 2.5, 0, 0, 0));
  cards = thermoCards("CH4", "C   1H   4");
  for (const char* note : {" from a table", " O2 and N2", "O"})
    EXPECT_THAT(atoms(cards.substr(0, 80) + note + cards.substr(80)), ElementsAre(1, 4, 0, 0, 0, 0)) << note;
  // As many as there are, behind '&'.
  const auto rest = thermoCards("CH4", "").substr(81);
  auto first = thermoCards("CH4", "").substr(0, 80);
  EXPECT_THAT(atoms(first + "&\nC 12 H 120 &\nO 2.5\n" + rest), ElementsAre(12, 120, 2.5, 0, 0, 0));
  first = thermoCards("CH4", "C   1H   4").substr(0, 80);
  EXPECT_THAT(atoms(first + " &\n N 2\n" + rest), ElementsAre(1, 4, 0, 2, 0, 0));
}

TEST(ChemkinThermo, UntidyCards) {
  const auto tidy = thermoCards("CH4", "C   1H   4");
  // No numbers of the cards, comments and blank lines between them, text behind.
  const auto first = tidy.substr(0, 79), second = tidy.substr(81, 75), third = tidy.substr(162, 75),
             fourth = tidy.substr(243, 60);
  expectMethane(
      withThermo("! data\n" + first + "\n\n" + second + "\n! more\n" + third + " ! x\n" + fourth + "\nEND\nrest"));
  expectMethane(withThermo(std::string("\n") + first + "1 from a table\r\n" + second + "    2\r\n" + third +
                           "    3\r\n" + fourth + " 1.0000000E+01     4\r\n"));
  // Blank coefficients are zero.
  const std::string blank(15, ' ');
  expectMethane(withThermo(first + "1\n" + second.substr(0, 30) + blank + blank + blank + "    2\n" + third +
                           "    3\n" + fourth + "                   4\n"));
  // Numbers as Fortran writes them, in the second card.
  expectMethane(withThermo(first +
                           "1\n  2.5           1.0-03         0.             0.D+00         0              2\n" +
                           third + "    3\n" + fourth + "\n"));
  expectMethane(withThermo(first +
                           "1\n 0.25000000E 01 1.00000000D-03 0.00000000E+00 0.00000000E+00 0.00000000E+00    2\n" +
                           third + "    3\n" + fourth + "\n"));
  // Out of columns, but as many words as coefficients.
  expectMethane(withThermo(first + "1\n2.5 1.0e-3 0. 0. 0. 2\n-1000. 4.0 1.5 2e-3 0. 3\n0 0 -5.0e2 9.90775528 4\n"));
  // Tabulators instead of blanks.
  expectMethane(withThermo("CH4\t\t\tC   1H   4\t    G   300.000  5000.000 1000.00      1\n" + second + "\n" + third +
                           "\n" + fourth + "\n"));
  // Other species around it, even damaged ones, do not matter.
  expectMethane(withThermo(thermoCards("CH5", "??  1") + "notes\n" + thermoCards("CO", "C   1O   1").substr(0, 200) +
                           "\n" + tidy + thermoCards("X", "").substr(0, 100)));
}

TEST(ChemkinThermo, LongNames) {
  const std::string name = "C10H7CH2OOH-12345X";
  auto cards = thermoCards(name + "L12/95", "C   1H   4");
  expectMethane(withThermo(cards, nullptr, name));
  expectMethane(withThermo(thermoCards("A-name-of-22-letters-X", "C   1H   4"), nullptr, "A-name-of-22-letters-X"));
}

TEST(ChemkinThermo, OneRange) {
  const auto tidy = thermoCards("CH4", "C   1H   4");
  std::vector<std::string> warnings;
  // The middle temperature is the highest: the lower range holds.
  auto thermo =
      withThermo(thermoCards("CH4", "C   1H   4", "   300.000  5000.0005000.00"), &warnings).species(0).thermo;
  EXPECT_EQ(thermo.low, kLow);
  EXPECT_EQ(thermo.high, kLow);
  EXPECT_EQ(thermo.midTemperature, 5000);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("therm.dat:1: species 'CH4' has one range of temperature")));
  // The coefficients of the lower range are missing.
  thermo = withThermo(tidy.substr(0, 162) + tidy.substr(162, 30) + "\n" + "\n  0.\n", &warnings).species(0).thermo;
  EXPECT_EQ(thermo.low, kHigh);
  EXPECT_EQ(thermo.high, kHigh);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("one range")));
}

}  // namespace
