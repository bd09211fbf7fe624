// Small mechanisms written out in a test, read through a temporary file.
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/constants.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace lampblack::test {

inline constexpr double kelvinPerCalorie =
    constants::thermochemicalCalorie / constants::gasConstant;  // activation energies in cal/mol

// Writes the text to a file, reads it as a mechanism, removes the file.
inline Mechanism readFileText(const std::string& text, const std::string& phase = "") {
  const test::ScratchFolder folder;
  return Mechanism::fromFile(folder.file("mechanism.yaml", text), phase);
}

// Lines 1 to 6 are fixed; the phase's species stand in line 4, `species` starts after line 6. *t and *u are
// thermodynamic data of something at least as smooth as nitrogen.
inline std::string mechanismText(const std::string& phaseSpecies, const std::string& species,
                                 const std::string& reactions) {
  return "units: {length: cm, quantity: mol, activation-energy: cal/mol}\n"
         "thermo: [&t {model: NASA7, temperature-ranges: [200, 1000, 6000], data: [[3.5, 1e-4, 0, 0, 0, -900, 4], "
         "[3.52, 1e-4, 0, 0, 0, -920, 3.861845]]}, &u {model: NASA7, temperature-ranges: [200, 6000], data: [[2.9, "
         "2e-4, "
         "1e-8, 0, 0, -5900, 3]]}]\n"
         "phases:\n"
         "- {name: gas, thermo: ideal-gas, kinetics: gas, " +
         phaseSpecies +
         "}\n"
         "\n"
         "species:" +
         species + "\nreactions:\n  " + reactions + "\n";
}

inline Mechanism readText(const std::string& phaseSpecies, const std::string& species, const std::string& reactions) {
  return readFileText(mechanismText(phaseSpecies, species, reactions));
}

}  // namespace lampblack::test
