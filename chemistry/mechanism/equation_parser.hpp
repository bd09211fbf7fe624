// Splits the text of a reaction equation ("H + O2 (+M) <=> HO2 (+M)") into species names and coefficients.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ParsedEquation {
  using Side = std::vector<std::pair<std::string, double>>;  // each species once, coefficients added up
  Side reactants;
  Side products;
  bool reversible = true;
  bool hasM = false;            // "+ M" on both sides
  std::string falloffCollider;  // "M" or a species for "(+M)"; empty if there is none
};

// Throws InputError whose text says what is wrong with the equation (without file and line).
ParsedEquation parseEquation(std::string_view equation);

}  // namespace lampblack::chemistry
