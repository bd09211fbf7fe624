// The words that CHEMKIN keeps for itself in REACTIONS sections, and its units.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// A keyword of auxiliary data, whether Lampblack can use it or not; letters in either case.
bool isChemkinKeyword(std::string_view word);
// A keyword that Lampblack cannot use; `meaning` says what such a keyword is for.
bool isUnsupportedChemkinKeyword(std::string_view word, std::string_view& meaning);
// "; did you mean 'TROE'?" or nothing
std::string suggestChemkinKeyword(std::string_view word);

// Units of rate constants, in SI: A in (cm3/quantity)^(order-1)/s, Ea in energy.
struct ChemkinUnits {
  double quantity = 1;               // mol
  double activationTemperature = 0;  // K for one unit of Ea

  // Calories per mole and moles.
  ChemkinUnits();
  // Takes a word such as KCAL/MOLE or MOLECULES, or several between commas; false if one is no unit.
  bool set(std::string_view word);
  static std::string_view expected();  // the words, for messages

 private:
  bool setOne(std::string_view word);
};

}  // namespace lampblack::chemistry
