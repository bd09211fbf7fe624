// What decks of molecules become, and what is refused.
#include "app/problems/pah/pah_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "core/errors.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

const std::string pyreneMolecule = "{name: pyrene}";
const std::string hotGas =
    "{temperature: 1500 K, pressure: 1 atm, mole_fractions: {H: 0.01, H2: 0.1, C2H2: 0.1}, end: 1 ms}";

PahCase readPah(const std::string& molecule, const std::string& gas, const std::string& more = "") {
  return readPahCase(Deck::parse(fmt::format("problem: pah\nmolecule: {}\ngas: {}\n{}", molecule, gas, more),
                                 "deck.yaml", {}, pahSchema()));
}

std::string refused(const std::string& molecule, const std::string& gas, const std::string& more = "") {
  return test::messageOf<InputError>([&] { (void)readPah(molecule, gas, more); });
}

TEST(PahCase, AMoleculeIsNamedOrGivenByCells) {
  EXPECT_EQ(readPah(pyreneMolecule, hotGas).start().carbon(), 16U);
  const PahCase made = readPah("{cells: [0, 0, 1, 0], five_rings: [0, 1], most_rings: 5}", hotGas);
  EXPECT_EQ(made.start().carbon(), 12U);
  EXPECT_EQ(made.start().fiveRings(), 1U);
  EXPECT_EQ(made.mostRings, 5U);
  EXPECT_EQ(readPah(pyreneMolecule, hotGas).mostRings, MoleculeGrowth::noLimit);
}

TEST(PahCase, AGasThatStaysIsOneIntervalARow) {
  const PahCase made = readPah(pyreneMolecule, hotGas, "output: {interval: 0.25 ms, spectra: [0.3 ms]}\nrepeats: 7");
  ASSERT_EQ(made.recorded.size(), 6U);
  EXPECT_DOUBLE_EQ(made.timeOf(1), 0.25e-3);
  EXPECT_DOUBLE_EQ(made.timeOf(2), 0.3e-3);
  EXPECT_EQ(made.spectra, (std::vector<std::size_t>{2, 5}));
  EXPECT_EQ(made.growth.intervals.size(), 5U);
  EXPECT_EQ(made.growth.records, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(made.repeats, 7U);
  EXPECT_EQ(made.drawn, 7U);
  // mol/m3: p/(R T) of 1 atm and 1500 K is 8.124.
  EXPECT_NEAR(made.path.points[0].concentrations[SootSpecies::C2H2], 0.8124, 1e-4);
}

TEST(PahCase, ProcessesAndRatesAreTheDecks) {
  const PahCase some = readPah(pyreneMolecule, hotGas, "processes: [G6R_AC, G5R_ZZ]\nrates: {ways_armchair: 4}");
  const PahCase all = readPah(pyreneMolecule, hotGas);
  for (std::size_t p = 0; p < pahProcessCount; ++p) {
    const double rate = some.growth.intervals[0].rates[p], published = all.growth.intervals[0].rates[p];
    const std::string name = pahProcesses[p].name;
    EXPECT_DOUBLE_EQ(rate, name == "G6R_AC" ? 2 * published : name == "G5R_ZZ" ? published : 0) << name;
  }
  const PahCase channels = readPah(pyreneMolecule, hotGas, "rates: {growth_free_edge: [1, 2, 3, 4, 5, 6]}");
  ASSERT_EQ(channels.constants.growthFreeEdge.size(), 2U);
  EXPECT_EQ(channels.constants.growthFreeEdge[1].n, 5);
  EXPECT_EQ(readPah(pyreneMolecule, hotGas, "rates: {close_by_h: [1, 0, 0]}").constants.surface.closeByH.A, 1);
}

TEST(PahCase, WhatIsNoMoleculeIsRefused) {
  EXPECT_THAT(refused("{most_rings: 5}", hotGas), HasSubstr("either 'name'"));
  EXPECT_THAT(refused("{name: pyrene, cells: [0, 0]}", hotGas), HasSubstr("either 'name'"));
  EXPECT_THAT(refused("{name: pyren}", hotGas), HasSubstr("pyrene"));
  EXPECT_THAT(refused("{cells: [0, 0, 1]}", hotGas), HasSubstr("two numbers for each cell, found 3"));
  EXPECT_THAT(refused("{cells: [0, 0, 2, 0]}", hotGas), HasSubstr("one piece without a hole"));
  EXPECT_THAT(refused("{cells: [0, 0, 5000000, 0]}", hotGas), HasSubstr("too far away"));
  EXPECT_THAT(refused("{name: benzene, five_rings: [1, 0]}", hotGas), HasSubstr("not on a zigzag"));
  EXPECT_THAT(refused("{name: pyrene, most_rings: 3}", hotGas), HasSubstr("expected 4 or more"));
}

// What takes no part may be named, before and behind what does, and changes nothing.
TEST(PahCase, GasesWithoutPartMayBeNamed) {
  const auto concentrations = [](const std::string& x) {
    return readPah(pyreneMolecule, "{temperature: 1500 K, pressure: 1 atm, mole_fractions: {" + x + "}, end: 1 ms}")
        .path.points[0]
        .concentrations;
  };
  const std::vector<double> without = concentrations("H: 0.01, C2H2: 0.1");
  EXPECT_EQ(concentrations("N2: 0.5, H: 0.01, AR: 0.2, C2H2: 0.1, CO: 0.1"), without);
  EXPECT_EQ(std::ranges::count(without, 0.0), 4);
  EXPECT_EQ(concentrations("h: 0.01, c2h2: 0.1"), without) << "in any case";
}

TEST(PahCase, WhatIsNoGasIsRefused) {
  EXPECT_THAT(refused(pyreneMolecule, "{temperature: 1500 K, pressure: 1 atm, end: 1 s}"),
              HasSubstr("needs the key 'mole_fractions'"));
  const auto fractions = [](const std::string& x) {
    return "{temperature: 1500 K, pressure: 1 atm, mole_fractions: {" + x + "}, end: 1 ms}";
  };
  for (const std::string slip : {"N3: 0.9", "H20: 0.1", "C2H: 0.1"})
    EXPECT_THAT(refused(pyreneMolecule, fractions(slip)),
                HasSubstr("H, H2, OH, H2O, O2, C2H2 only; of others N2, Ar, He, Ne, Kr, CO, CO2, CH4 may be named"));
  for (const std::string twice : {"C2H2: 0.1, c2h2: 0.1", "H: 0.1, AR: 0.1, Ar: 0.1"})
    EXPECT_THAT(refused(pyreneMolecule, fractions(twice)), HasSubstr("given twice, as '"));
  EXPECT_THAT(refused(pyreneMolecule, fractions("H: 0.6, H2: 0.6")), HasSubstr("add up to 1.2"));
  EXPECT_THAT(refused(pyreneMolecule, fractions("H: 0.6, AR: 0.6")), HasSubstr("add up to 1.2"));
  EXPECT_THAT(refused(pyreneMolecule, "{file: gas.csv, temperature: 1500 K}", "mechanism: a.yaml"),
              HasSubstr("leave this out"));
  EXPECT_THAT(refused(pyreneMolecule, "{file: gas.csv}"), HasSubstr("'mechanism' is needed"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "mechanism: a.yaml"), HasSubstr("belongs to 'gas.file'"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "output: {spectra: [2 ms]}"), HasSubstr("outside the run"));
}

TEST(PahCase, WhatIsNoRateIsRefused) {
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "rates: {close_bay: [1, 2]}"), HasSubstr("three numbers A, n, E"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "rates: {close_bay: [-1, 2, 3]}"), HasSubstr("zero or more"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "rates: {five_equilibrium: [0, 0, 0]}"), HasSubstr("above zero"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "rates: {close_bey: [1, 2, 3]}"), HasSubstr("did you mean 'close_bay'"));
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "processes: [G6R_AB]"), HasSubstr("G6R_AC"));
  const test::ScratchFolder scratch;
  const std::string file = (scratch.path() / "rates.yaml").string();
  std::ofstream(file) << "close_bay: [1, 2]\n";
  EXPECT_THAT(refused(pyreneMolecule, hotGas, "rates: {file: " + file + "}"), HasSubstr("three numbers A, n, E"));
}

}  // namespace
}  // namespace lampblack::app
