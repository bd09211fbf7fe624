// What a wrong CHEMKIN file says: file, line, and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/chemistry/chemkin_support.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::chemkinHead;
using lampblack::test::chemkinThermo;
using lampblack::test::inputMessage;
using lampblack::test::readChemkinText;
using lampblack::test::thermoCards;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The reaction stands in line 6.
std::string reactionMessage(const std::string& text, const std::string& units = "") {
  return inputMessage([&] { readChemkinText(chemkinHead() + "REACTIONS " + units + "\n" + text + "\nEND\n"); });
}

std::string mechanismMessage(const std::string& text) {
  return inputMessage([&] { readChemkinText(text); });
}

std::string thermoMessage(const std::string& thermo) {
  return inputMessage([&] { readChemkinText("ELEM H O END SPEC H2O END", nullptr, thermo); });
}

std::string transportMessage(const std::string& transport) {
  return inputMessage([&] { readChemkinText("ELEM H O END SPEC H2O END", nullptr, chemkinThermo(), transport); });
}

TEST(ChemkinErrors, Files) {
  EXPECT_THAT(inputMessage([&] {
                readChemkin({"no/such/chem.inp", {}, {}});
              }),
              HasSubstr("no/such/chem.inp: there is no such file; expected a mechanism"));
  EXPECT_THAT(inputMessage([&] {
                readChemkin({"/", {}, {}});
              }),
              HasSubstr("/: this is a folder; expected a mechanism"));
}

TEST(ChemkinErrors, Sections) {
  EXPECT_THAT(mechanismMessage("! nothing"), HasSubstr("chem.inp: no elements; expected a section ELEMENTS"));
  EXPECT_THAT(mechanismMessage("ELEMENTS H END"), HasSubstr("no species; expected a section SPECIES"));
  EXPECT_THAT(mechanismMessage("\nELEMENS H O END"),
              AllOf(StartsWith("chem.inp:2:"), HasSubstr("found 'ELEMENS'; did you mean 'ELEMENTS'?")));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC H END\nH+M=H+M 1 0 0\nREAC\nEND\n"),
              AllOf(StartsWith("chem.inp:2:"), HasSubstr("a reaction behind END")));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC H END\nREAC\nEND\nTHERMOS\n"),
              AllOf(StartsWith("chem.inp:4:"), HasSubstr("'THERMOS' begins no section; did you mean 'THERMO'?")));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC H END\nSITE/PT/ END"), HasSubstr("surfaces are not supported"));
  EXPECT_THAT(thermoMessage("ELEMENTS H O END"), AllOf(StartsWith("therm.dat:1:"), HasSubstr("THERMO")));
  EXPECT_THAT(thermoMessage("THERMO NASA8\n"), AllOf(StartsWith("therm.dat:1:"), HasSubstr("found 'NASA8'")));
}

TEST(ChemkinErrors, FormatsOfOthers) {
  EXPECT_THAT(mechanismMessage("\n<?xml version=\"1.0\"?>\n<ctml/>"),
              AllOf(StartsWith("chem.inp:2: this is XML"), HasSubstr("ctml2yaml")));
  EXPECT_THAT(mechanismMessage("# made\n\nunits(length='cm')\nideal_gas(name='gas')"),
              AllOf(StartsWith("chem.inp:3: this is CTI"), HasSubstr("cti2yaml")));
  EXPECT_THAT(mechanismMessage("FoamFile\n{\n}\nspecies ( O2 N2 );"),
              StartsWith("chem.inp:1: this is a dictionary of"));
}

TEST(ChemkinErrors, ElementsAndSpecies) {
  EXPECT_THAT(mechanismMessage("ELEMENTS\nH QQ\nEND"),
              AllOf(StartsWith("chem.inp:2: unknown element 'QQ'"), HasSubstr("QQ/12.011/")));
  EXPECT_THAT(mechanismMessage("ELEMENTS D/two/ END"), HasSubstr("element 'D': expected an atomic weight above zero"));
  EXPECT_THAT(mechanismMessage("ELEMENTS D/2.014 END"), HasSubstr("element 'D': expected an atomic weight above zero"));
  EXPECT_THAT(mechanismMessage("ELEMENTS D/-2/ END"), HasSubstr("atomic weight above zero"));
  EXPECT_THAT(mechanismMessage("ELEMENTS HYDROGEN END"), HasSubstr("symbol of an element, found 'HYDROGEN'"));
  EXPECT_THAT(mechanismMessage("ELEM H END\nSPEC H M END"),
              AllOf(StartsWith("chem.inp:2:"), HasSubstr("'M' cannot be")));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC 1E5 END"), HasSubstr("'1E5' cannot be the name"));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC H/2/ END"), HasSubstr("cannot be the name"));
  EXPECT_THAT(mechanismMessage("ELEM H END SPEC \xc3\x84 END"), HasSubstr("cannot be the name"));
}

TEST(ChemkinErrors, Thermo) {
  EXPECT_THAT(mechanismMessage("ELEM QQ/1/ END SPEC QQ END"),
              HasSubstr("chem.inp: no thermodynamic data of any species; expected them in a section THERMO"));
  EXPECT_THAT(
      inputMessage([] { readChemkinText("ELEM H O END SPEC\nH2O H2 HO3\nEND", nullptr, thermoCards("H2", "H   2")); }),
      HasSubstr("chem.inp: no thermodynamic data for 2 of 3 species: 'H2O' (line 2), 'HO3' (line 2)"));
  EXPECT_THAT(thermoMessage(std::string("\n") + thermoCards("H2O", "")),
              AllOf(StartsWith("therm.dat:2: thermodynamic data of 'H2O': "), HasSubstr("columns 25 to 44")));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   2C   1")),
              AllOf(StartsWith("therm.dat:1:"), HasSubstr("element 'C' is not declared; declared are H, O")));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   xO   1")), HasSubstr("number of atoms of 'H', found 'x'"));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "?   1O   1")), HasSubstr("columns 25 and 26, found '?'"));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H  -2O   1")), HasSubstr("zero or more atoms of H"));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   2H   1")), HasSubstr("element 'H' has two numbers"));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   2O   1", "  5000.000   300.000 1000.00")),
              HasSubstr("low temperature in columns 46 to 55"));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   2O   1", "  cold      hot")), HasSubstr("low temperature"));
  auto cards = thermoCards("H2O", "H   2O   1");
  EXPECT_THAT(thermoMessage(cards.substr(0, 200)), AllOf(StartsWith("therm.dat:3:"), HasSubstr("expected card 4")));
  EXPECT_THAT(thermoMessage(cards.substr(0, 81) + cards.substr(162)),
              AllOf(StartsWith("therm.dat:2:"), HasSubstr("expected card 2, found a 3 in column 80")));
  cards.replace(100, 3, "x.y");
  EXPECT_THAT(thermoMessage(cards),
              AllOf(StartsWith("therm.dat:2:"), HasSubstr("number in columns 16 to 30, found '1.0x.y0000E-03'")));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "H   2O   1").substr(0, 81) + "0.\n0.\n0.\n"),
              HasSubstr("all coefficients are zero"));
}

// Line 1 of the record stands in line 2.
TEST(ChemkinErrors, Nasa9) {
  const std::string record =
      "THERMO NASA9\nH2O a comment\n 1 note   H   2.00O   1.00    0.00    0.00    0.00 0   18.0152800\n"
      "    200.000   1000.0007 -2.0 -1.0  0.0  1.0  2.0  3.0  4.0  0.0         6197.428\n"
      " 0.000000000D+00 0.000000000D+00 4.000000000D+00\n 0.000000000D+00 0.000000000D+00\n";
  const auto changed = [&](const std::string& from, const std::string& to) {
    auto text = record;
    text.replace(text.find(from), from.size(), to);
    return thermoMessage(text);
  };
  EXPECT_EQ(thermoMessage(record), "no error");
  const std::string species = "thermodynamic data of 'H2O': ";
  EXPECT_THAT(changed(" 1 note", " x note"), StartsWith("therm.dat:2: " + species + "expected the number of ranges"));
  EXPECT_THAT(changed(" 1 note", " 2 note"), HasSubstr("three lines for each of 2 ranges"));
  EXPECT_THAT(changed("H   2.00", "H   x.00"), StartsWith("therm.dat:3: " + species + "expected the symbol"));
  EXPECT_THAT(changed("-2.0 -1.0", "-1.0 -1.0"), StartsWith("therm.dat:4: " + species + "expected seven powers"));
  EXPECT_THAT(changed("   1000.0007", "    100.0007"), HasSubstr("rising temperatures"));
  EXPECT_THAT(changed("4.000000000D+00", "4.00000x000D+00"),
              StartsWith("therm.dat:5: " + species + "expected a number in columns 33 to 48"));
}

// What is in wrong columns is not taken for something else.
TEST(ChemkinErrors, SlippedThermo) {
  auto cards = thermoCards("H2O", "");
  cards.replace(23, 12, "H 1250O 812 ");
  EXPECT_THAT(thermoMessage(cards), AllOf(StartsWith("therm.dat:1:"), HasSubstr("columns 25 and 26, found '1'"),
                                          HasSubstr("columns 27 to 29, found '250'"), HasSubstr("'&'")));
  EXPECT_THAT(thermoMessage(thermoCards("H2O", "  H  O   1")), HasSubstr("columns 25 and 26, found ''"));
  // A number torn in two, its digits in the next field.
  cards = thermoCards("H2O", "H   2O   1");
  cards.replace(81, 30, "  2.5000000E+ 0.1000000000E-02");
  EXPECT_THAT(thermoMessage(cards),
              AllOf(StartsWith("therm.dat:2:"), HasSubstr("columns 1 to 15, found '2.5000000E+ 0'")));
  // The whole card one column to the right: the last exponent would lose a digit.
  cards = thermoCards("H2O", "H   2O   1");
  cards.replace(81, 79, "                                                              4.00000000E-03   ");
  EXPECT_THAT(thermoMessage(cards), AllOf(StartsWith("therm.dat:2:"), HasSubstr("columns 61 to 75")));
}

TEST(ChemkinErrors, Transport) {
  const std::string species = "tran.dat:1: transport data of 'H2O': ";
  EXPECT_EQ(transportMessage("H2O 2 572.4 2.605"),
            species +
                "expected six numbers (geometry, well depth, diameter, dipole moment, polarizability, rotational "
                "relaxation), found 3");
  EXPECT_EQ(transportMessage("H2O 3 572.4 2.605 1.844 0 4"),
            species + "expected a geometry of 0 (atom), 1 (linear) or 2 (nonlinear), found '3'");
  EXPECT_EQ(transportMessage("H2O 2 572.4 2.6O5 1.844 0 4"),
            species + "expected a number for the diameter, found '2.6O5'");
  EXPECT_EQ(transportMessage("H2O 2 0 2.605 1.844 0 4"), species + "expected the well depth above zero, found '0'");
  EXPECT_EQ(transportMessage("H2O  2  572.4  2.605  1.8 0.  0  4"),
            species + "expected six numbers, found a seventh, '4', in column 34");
  EXPECT_EQ(transportMessage("H2O 2 572.4 2.605 -1 0 4"),
            species + "expected the dipole moment of zero or more, found '-1'");
}

TEST(ChemkinErrors, Equations) {
  EXPECT_EQ(reactionMessage("H+O3=O+HO2 1 0 0"),
            "chem.inp:6: equation 'H+O3=O+HO2': species 'O3' is not declared; did you mean 'O2'?");
  EXPECT_THAT(reactionMessage("2XY=O2 1 0 0"), HasSubstr("species 'XY' is not declared"));
  EXPECT_THAT(reactionMessage("H+02=HO2 1 0 0"), HasSubstr("species '02' is not declared; did you mean"));
  EXPECT_THAT(reactionMessage("H+oh=H2O 1 0 0"), HasSubstr("species 'oh' is not declared; did you mean 'OH'?"));
  EXPECT_THAT(reactionMessage("H+=H2O 1 0 0"), HasSubstr("joined by '+'"));
  EXPECT_THAT(reactionMessage("=H2O 1 0 0"), HasSubstr("species on both sides"));
  EXPECT_THAT(reactionMessage("H2O+HV=H+OH 1 0 0"), HasSubstr("reactions driven by light (hv) are not supported"));
  EXPECT_THAT(reactionMessage("H2O+hv=>H+O3 1 0 0"), HasSubstr("(hv)"));
  EXPECT_THAT(reactionMessage("H2O=H+OH+hv 1 0 0\nREV/1 0 0/"),
              HasSubstr("light (hv) that leaves the gas has no reverse"));
  EXPECT_THAT(reactionMessage("2O2=>1.9E0XY 1 0 0"), HasSubstr("species 'XY' is not declared"));
  EXPECT_THAT(reactionMessage("H+OH+M=H2O 1 0 0"), HasSubstr("third body must stand on both sides"));
  EXPECT_THAT(reactionMessage("H+OH(+M)=H2O(+AR) 1 0 0"), HasSubstr("third body must stand on both sides"));
  EXPECT_THAT(reactionMessage("H+OH+M(+M)=H2O+M(+M) 1 0 0"), HasSubstr("either 'M' or '(+M)'"));
  EXPECT_THAT(reactionMessage("H+OH=HO2 1 0 0"),
              AllOf(StartsWith("chem.inp:6: reaction 'H + OH <=> HO2' does not balance"),
                    HasSubstr("2 atoms of H on the left, 1 on the right")));
  EXPECT_EQ(reactionMessage("H+OH=H2O 1 0"),
            "chem.inp:6: reaction 'H+OH=H2O 1 0': expected three numbers A, b and Ea after the equation");
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 x"), HasSubstr("three numbers A, b and Ea after the equation, found 'x'"));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1E 0 0"), HasSubstr("found '1E'"));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0\nH+OH=H2O 2 0 0"),
              AllOf(StartsWith("chem.inp:7:"), HasSubstr("is the same as"), HasSubstr("line 6"),
                    HasSubstr("marked DUPLICATE"), HasSubstr("--permissive")));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1E300 0 1E300\nUNITS/MOLECULES/"), HasSubstr("beyond any rate constant"));
  EXPECT_THAT(reactionMessage("H+OH=H2O &"), HasSubstr("expected a line after '&'"));
}

TEST(ChemkinErrors, Lines) {
  EXPECT_EQ(reactionMessage("H+OH=H2O 1 0 0", "CALS/MOLE").substr(0, 50),
            "chem.inp:5: REACTIONS: unknown unit 'CALS/MOLE'; e");
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0\n UNITS/BTU/"), AllOf(StartsWith("chem.inp:7:"), HasSubstr("'BTU'")));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0\nDUPL"), HasSubstr("'DUPL' is not a keyword; did you mean 'DUP'?"));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0", "KELVINS/MOLE"), HasSubstr("unknown unit 'KELVINS/MOLE'"));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0", "MOLES,BTU"), HasSubstr("unknown unit 'MOLES,BTU'"));
  EXPECT_THAT(reactionMessage("H+OH+H2O 1 0 0"), HasSubstr("expected a reaction (with '=')"));
  EXPECT_EQ(
      reactionMessage("H + OH -> H2O 1 0 0"),
      "chem.inp:6: cannot read 'H + OH -> H2O 1 0 0'; expected '=>' (irreversible), '<=>' or '=' in place of '->'");
  EXPECT_THAT(reactionMessage("H2/2/"), HasSubstr("'H2' stands before the first reaction"));
  EXPECT_THAT(reactionMessage("H+OH+M=H2O+M 1 0 0\nH2/2.0 O2/3/"), HasSubstr("found '3'; is a '/' missing before it?"));
  EXPECT_THAT(reactionMessage("H+OH+M=H2O+M 1 0 0\nH2/"), HasSubstr("expected one efficiency of 'H2', found 0 values"));
  EXPECT_THAT(reactionMessage("H+OH+M=H2O+M 1 0 0\nH2/2.0//"), HasSubstr("stray '/'"));
}

TEST(ChemkinErrors, UnsupportedKeywordsAreNamed) {
  for (const char* keyword :
       {"LT", "RLT", "JAN", "FIT1", "HV", "TDEP", "EXCI", "MOME", "XSMI", "USRPROG", "PLOGSP", "PLOGMX"})
    EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0\n" + std::string(keyword) + " / 1 2 /"),
                AllOf(StartsWith("chem.inp:7: reaction 'H+OH=H2O': the keyword '" + std::string(keyword) + "'"),
                      HasSubstr("is not supported")));
  EXPECT_THAT(reactionMessage("H+OH=H2O 1 0 0\nMOME"), HasSubstr("'MOME' (momentum transfer of electrons) is not"));
}

TEST(ChemkinErrors, AuxiliaryData) {
  const auto message = [](const std::string& equation, const std::string& auxiliary) {
    return reactionMessage(equation + " 1 0 0\n" + auxiliary);
  };
  EXPECT_EQ(message("H+OH+M=H2O+M", "H2OO/6/"),
            "chem.inp:7: reaction 'H+OH+M=H2O+M': 'H2OO' is neither a keyword nor a declared species; did you mean "
            "'H2O'?; --permissive leaves efficiencies of other species out");
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOWW/1 2 3/"), HasSubstr("did you mean 'LOW'?"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2/"),
              AllOf(StartsWith("chem.inp:7:"), HasSubstr("'LOW': expected the three numbers A, b and Ea, found 2")));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 E/"), HasSubstr("'LOW': expected a number, found 'E'"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 3/\nTROE/1 2/"), HasSubstr("three or four numbers"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 3/\nSRI/1 2 3 4/"), HasSubstr("three or five numbers"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 3/ LOW/1 2 3/"), HasSubstr("'LOW' is given twice"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 3/ HIGH/1 2 3/"), HasSubstr("only one of LOW, HIGH"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/0 2 3/"), HasSubstr("'A' of both limits"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/-1 2 3/"), HasSubstr("'A' of both limits"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "H2/2/"), HasSubstr("'(+M)' needs LOW, HIGH, PLOG or CHEB"));
  EXPECT_THAT(message("H+OH+M=H2O+M", "LOW/1 2 3/"), HasSubstr("'(+M)' in place of '+M'"));
  EXPECT_THAT(message("H+OH=H2O", "LOW/1 2 3/"), HasSubstr("need '(+M)' on both sides"));
  EXPECT_THAT(message("H+OH=H2O", "TROE/1 2 3/"), HasSubstr("TROE and SRI need LOW or HIGH"));
  EXPECT_THAT(message("H+OH=H2O", "AR/2/"), HasSubstr("the efficiency of 'AR' needs '+M' or '(+M)'"));
  EXPECT_THAT(message("H+OH(+AR)=H2O(+AR)", "LOW/1 2 3/ AR/2/"), HasSubstr("needs '+M' or '(+M)'"));
  EXPECT_THAT(message("H+OH+M=H2O+M", "AR/-2/"), HasSubstr("efficiency of zero or more of 'AR'"));
  EXPECT_THAT(message("H+OH+M=H2O+M", "AR/2/ AR/2/"), HasSubstr("'AR' is given twice"));
  EXPECT_THAT(message("H+OH+M=H2O+M", "AR/2 3/"), HasSubstr("one efficiency of 'AR', found 2"));
  EXPECT_THAT(message("H+OH=H2O", "REV/1 2/"), HasSubstr("'REV': expected the three numbers"));
  EXPECT_THAT(message("H+OH=>H2O", "REV/1 0 0/"), HasSubstr("REV needs a reversible equation"));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "LOW/1 2 3/ REV/1 0 0/"), HasSubstr("REV is not supported with LOW"));
  EXPECT_THAT(message("H+OH=H2O", "FORD/H 2/"), HasSubstr("FORD needs an irreversible reaction"));
  EXPECT_THAT(message("H+OH=>H2O", "FORD/XX 2/"), HasSubstr("species 'XX' of FORD is not declared"));
  EXPECT_THAT(message("H+OH=>H2O", "FORD/H/"), HasSubstr("a species and its order, found 1"));
  EXPECT_THAT(message("H+OH=>H2O", "FORD/H 2/ FORD/H 2/"), HasSubstr("'FORD' of 'H' is given twice"));
  EXPECT_THAT(message("H+OH=>H2O", "RORD/H2O 2/"), HasSubstr("RORD needs REV"));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/1 2 3/"), HasSubstr("the four numbers p, A, b and Ea"));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/0 1 0 0/"), HasSubstr("a pressure above zero"));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/1 -1 0 0/"),
              AllOf(StartsWith("chem.inp:6:"), HasSubstr("positive sum"), HasSubstr("under one equation")));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/1 -1 0 0/\nDUP\nH+OH=>H2O 1 0 0\nPLOG/1 3 0 0/\nDUP"),
              HasSubstr("under one equation"));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/1 -1 0 0/\nDUP\nH+OH=H2O 1 0 0\nPLOG/2 1 0 0/\nDUP"),
              AllOf(StartsWith("chem.inp:6:"), HasSubstr("its duplicate at line 9 cannot be added"),
                    HasSubstr("expected the same pressures")));
  EXPECT_THAT(message("H+OH=H2O", "PLOG/1 -1 0 0/\nDUP\nH+OH=H2O 1 0 0\nPLOG/1 1 0 0/\nDUP"),
              AllOf(HasSubstr("with its duplicate at line 9"), HasSubstr("add up to zero or less")));
  EXPECT_THAT(message("H+OH(+M)=H2O(+M)", "PLOG/1 1 0 0/ AR/2/"), HasSubstr("no single colliders or efficiencies"));
  EXPECT_THAT(message("H+OH=H2O", "CHEB/2 2 1 2 3/"), HasSubstr("'CHEB': expected 2 x 2 coefficients, found 3"));
  EXPECT_THAT(message("H+OH=H2O", "CHEB/2.5 2 1 2 3/"), HasSubstr("the numbers of coefficients in temperature"));
  EXPECT_THAT(message("H+OH=H2O", "CHEB/1 1 1/ TCHEB/2 1/"), HasSubstr("two rising temperatures"));
  EXPECT_THAT(message("H+OH=H2O", "TCHEB/1 2/"), HasSubstr("TCHEB and PCHEB need CHEB"));
}

}  // namespace
