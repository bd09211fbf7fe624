// Transport lines of CHEMKIN files, in a file of their own or beside the mechanism.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(ChemkinTransport, TheSecondFileMayBeTransportData) {
  const std::string mechanism = "ELEM H END SPEC H2 END\nTHERMO\n" + thermoCards("H2", "H   2") + "END\n";
  for (const std::string heading : {"", "TRANSPORT\n", "! a comment\n"})
    EXPECT_EQ(
        readChemkinText(mechanism, nullptr, heading + "H2 1 38. 2.92 0.0 .79 280.\n").species(0).transport->wellDepth,
        38);
  EXPECT_THAT(lampblack::test::inputMessage([&] {
                readChemkinText(mechanism, nullptr, "H2 1 38. 2.92 0.0 .79 280.\n", "H2 1 38. 2.92 0.0 .79 280.\n");
              }),
              AllOf(HasSubstr("therm.dat: "), HasSubstr("found transport data")));
  // Without thermodynamic data anywhere it is these that are missing.
  EXPECT_THAT(lampblack::test::inputMessage(
                  [] { readChemkinText("ELEM H END SPEC H2 END", nullptr, "H2 1 38. 2.92 0.0 .79 280.\n"); }),
              HasSubstr("no thermodynamic data of any species"));
}

// A mistake in the first line does not make it thermodynamic data of no species.
TEST(ChemkinTransport, ASecondFileWithAMistakeInItsFirstLineIsTransportData) {
  const std::string mechanism = "ELEM H END SPEC H2 END\nTHERMO\n" + thermoCards("H2", "H   2") + "END\n";
  const auto message = [&](const std::string& line) {
    return lampblack::test::inputMessage([&] { readChemkinText(mechanism, nullptr, line); });
  };
  EXPECT_THAT(message("H2 3 38. 2.92 0.0 .79 280.\n"),
              HasSubstr("therm.dat:1: transport data of 'H2': expected a geometry"));
  EXPECT_THAT(message("H2 1 38. 2.92 0.0 .79\n"),
              HasSubstr("therm.dat:1: transport data of 'H2': expected six numbers"));
  // Limits of temperature and cards without a heading are what they were.
  EXPECT_EQ(readChemkinText("ELEM H END SPEC H2 END", nullptr, thermoCards("H2", "H   2")).species(0).thermo.high,
            (std::array{2.5, 1e-3, 0.0, 0.0, 0.0, -1000.0, 4.0}));
}

TEST(ChemkinTransport, TransportDataThatNoMoleculeHasAreAWarning) {
  const auto warningsOf = [](const std::string& species, const std::string& data) {
    std::vector<std::string> warnings;
    readChemkinText("ELEM H O E END SPEC " + species + " END", &warnings, chemkinThermo(), species + " " + data);
    return warnings;
  };
  for (const auto& [species, data] : {std::pair("H2O", "2 572.4 1.0 1.844 0 4"), std::pair("OH", "1 80. 2.75 0 0 0"),
                                      std::pair("H", "0 145. 2.05 0 0 0"), std::pair("E", "0 850. 425. 0 0 1")})
    EXPECT_THAT(warningsOf(species, data), IsEmpty()) << species;
  EXPECT_THAT(warningsOf("H2O", "2 572.4 2.605E-10 1.844 0 4"),
              ElementsAre(AllOf(HasSubstr("chem.inp:1: species 'H2O'"), HasSubstr("a diameter of 2.6e-10 Angstrom"))));
  EXPECT_THAT(warningsOf("H2O", "0 572.4 2.605 1.844 0 4"),
              ElementsAre(HasSubstr("the geometry 'atom', but the species has 3 atom(s)")));
  EXPECT_THAT(warningsOf("H", "1 145. 2.05 0 0 0"),
              ElementsAre(HasSubstr("with the geometry 'linear', but the species has 1 atom(s)")));
  EXPECT_THAT(warningsOf("OH", "2 80. 2.75 0 0 0"),
              ElementsAre(HasSubstr("the geometry 'nonlinear', but the species has 2 atom(s)")));
}

TEST(ChemkinTransport, TransportIsConverted) {
  const auto mechanism = readChemkinText("ELEM H O END SPEC H2O END", nullptr, chemkinThermo(),
                                         "TRANSPORT ALL\nH2O 2 572.400 2.605 1.844 1.5 4.000\nEND");
  const auto& t = *mechanism.species(0).transport;
  EXPECT_EQ(t.shape, MoleculeShape::Nonlinear);
  EXPECT_EQ(t.wellDepth, 572.4);
  EXPECT_DOUBLE_EQ(t.diameter, 2.605e-10);
  EXPECT_DOUBLE_EQ(t.dipole, 1.844 * 3.33564095198e-30);
  EXPECT_DOUBLE_EQ(t.polarizability, 1.5e-30);
  EXPECT_EQ(t.rotationalRelaxation, 4);
}

}  // namespace
