// Reads the rate constant of a reaction: Arrhenius, fall-off, tabulated over pressure, Chebyshev.
#pragma once

#include <string>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Fills the rate constants of a reaction whose type, reactants and orders are known. InputError with file, line and
// equation; warnings (file and line) are appended.
void readRates(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry, Reaction& reaction,
               std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
