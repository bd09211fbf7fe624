// Small CHEMKIN mechanisms written out in a test.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "chemistry/chemkin/chemkin_reader.hpp"
#include "core/errors.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Four cards of a species in the columns they belong to. `elements` fills columns 25 to 44, five for each element
// ("C   1H   4"); `temperatures` columns 46 to 73. The coefficients of the upper range are 2.5, 1e-3, 0, 0, 0, -1000,
// 4; those of the lower 1.5, 2e-3, 0, 0, 0, -500 and
// 9.90775528, which makes both the same at 1000 K.
inline std::string thermoCards(const std::string& name, const std::string& elements,
                               const std::string& temperatures = "   300.000  5000.000 1000.00") {
  char first[100];
  std::snprintf(first, sizeof first, "%-24.24s%-20.20sG%-28.28s      1\n", name.c_str(), elements.c_str(),
                temperatures.c_str());
  return first + std::string(
                     " 2.50000000E+00 1.00000000E-03 0.00000000E+00 0.00000000E+00 0.00000000E+00    2\n"
                     "-1.00000000E+03 4.00000000E+00 1.50000000E+00 2.00000000E-03 0.00000000E+00    3\n"
                     " 0.00000000E+00 0.00000000E+00-5.00000000E+02 9.90775528E+00                   4\n");
}

// Lines 1 to 4: elements H, O, N, C, Ar, E; species with names that make equations hard to read.
inline std::string chemkinHead() {
  return "ELEMENTS H O N C AR E END\n"
         "SPECIES\n"
         "H H2 O O2 OH H2O HO2 H2O2 N2 AR NO NO+ E CH2 CH2(S) CH3 CH4 C2H6 C4H8 2-C4H8 C=C C2H4 C5H5O(1,3)\n"
         "END\n";
}

// The thermodynamic data of these species, as a section.
inline std::string chemkinThermo() {
  std::string text = "THERMO ALL\n   300.000  1000.000  5000.000\n";
  const char* species[][2] = {{"H", "H   1"},
                              {"H2", "H   2"},
                              {"O", "O   1"},
                              {"O2", "O   2"},
                              {"OH", "O   1H   1"},
                              {"H2O", "H   2O   1"},
                              {"HO2", "H   1O   2"},
                              {"H2O2", "H   2O   2"},
                              {"N2", "N   2"},
                              {"AR", "AR  1"},
                              {"NO", "N   1O   1"},
                              {"NO+", "N   1O   1E  -1"},
                              {"E", "E   1"},
                              {"CH2", "C   1H   2"},
                              {"CH2(S)", "C   1H   2"},
                              {"CH3", "C   1H   3"},
                              {"CH4", "C   1H   4"},
                              {"C2H6", "C   2H   6"},
                              {"C4H8", "C   4H   8"},
                              {"2-C4H8", "C   4H   8"},
                              {"C=C", "C   2H   4"},
                              {"C2H4", "C   2H   4"},
                              {"C5H5O(1,3)", "C   5H   5O   1"}};
  for (const auto& [name, elements] : species) text += thermoCards(name, elements);
  return text + "END\n";
}

inline Mechanism readChemkinText(const std::string& mechanism, std::vector<std::string>* warnings = nullptr,
                                 const std::optional<std::string>& thermo = chemkinThermo(),
                                 const std::optional<std::string>& transport = std::nullopt) {
  const auto file = [](const char* name, const std::optional<std::string>& text) -> std::optional<ChemkinText> {
    if (!text) return std::nullopt;
    return ChemkinText{name, *text};
  };
  auto result = parseChemkin({"chem.inp", mechanism}, file("therm.dat", thermo), file("tran.dat", transport));
  if (warnings != nullptr) *warnings = result.warnings();
  return result;
}

// `reactions` begins in line 5 with the units behind REACTIONS; its second line is line 6.
inline Mechanism readChemkinReactions(const std::string& reactions, std::vector<std::string>* warnings = nullptr) {
  return readChemkinText(chemkinHead() + "REACTIONS " + reactions + "\nEND\n", warnings);
}

// What an InputError says; "no error" without one.
template <typename Read>
std::string inputMessage(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace lampblack::test
