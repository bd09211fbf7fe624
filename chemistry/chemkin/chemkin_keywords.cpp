#include "chemistry/chemkin/chemkin_keywords.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "core/constants.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

constexpr std::array<std::string_view, 14> kSupported{"LOW",   "HIGH", "TROE",      "SRI", "PLOG", "CHEB", "TCHEB",
                                                      "PCHEB", "DUP",  "DUPLICATE", "REV", "FORD", "RORD", "UNITS"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 20> kUnsupported{{
    {"LT", "Landau-Teller rates"},
    {"RLT", "Landau-Teller rates of the reverse"},
    {"JAN", "the rate formula of Janev, Langer and others"},
    {"FIT1", "a rate formula with powers of 1/T"},
    {"HV", "reactions of light"},
    {"TDEP", "rates at a species' own temperature"},
    {"EXCI", "energy losses of electrons"},
    {"MOME", "momentum transfer of electrons"},
    {"XSMI", "collision cross sections of ions"},
    {"USRPROG", "rates of a user's own program"},
    {"COLLEFF", "collision frequencies as rates"},
    {"COLLEF", "collision frequencies as rates"},
    {"COV", "coverages of surfaces"},
    {"STICK", "sticking coefficients"},
    {"MWON", "sticking coefficients"},
    {"MWOFF", "sticking coefficients"},
    {"EIM", "rates at the electrons' temperature"},
    {"USER", "rates of a user's own program"},
    {"PLOGSP", "rates over pressure of each collider"},
    {"PLOGMX", "rates over pressure of each collider"},
}};

}  // namespace

bool isChemkinKeyword(std::string_view word) {
  const auto upper = upperCase(word);
  std::string_view meaning;
  return std::ranges::find(kSupported, upper) != kSupported.end() || isUnsupportedChemkinKeyword(word, meaning);
}

bool isUnsupportedChemkinKeyword(std::string_view word, std::string_view& meaning) {
  const auto upper = upperCase(word);
  for (const auto& [name, purpose] : kUnsupported) {
    if (name != upper) continue;
    meaning = purpose;
    return true;
  }
  return false;
}

std::string suggestChemkinKeyword(std::string_view word) {
  return didYouMean(word, {kSupported.begin(), kSupported.end()});
}

ChemkinUnits::ChemkinUnits() : activationTemperature(constants::thermochemicalCalorie / constants::gasConstant) {}

bool ChemkinUnits::set(std::string_view word) {
  const auto units = chemkinWords(word, ",");  // "MOLES,KCAL/MOLE"
  return !units.empty() && std::ranges::all_of(units, [this](std::string_view unit) { return setOne(unit); });
}

bool ChemkinUnits::setOne(std::string_view word) {
  constexpr double perJoule = 1 / constants::gasConstant;
  constexpr double electronVolt = 1.602176634e-19;  // J (SI)
  const auto whole = upperCase(word);
  std::string_view unit = whole;
  const auto slash = unit.find('/');
  const bool perMole = slash != std::string_view::npos;
  if (perMole) {
    const auto amount = unit.substr(slash);
    if (amount != "/MOLE" && amount != "/MOL" && amount != "/MOLES") return false;
    unit = unit.substr(0, slash);
  }
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, unit) != names.end();
  };
  if (is({"CAL"}))
    activationTemperature = constants::thermochemicalCalorie * perJoule;
  else if (is({"KCAL"}))
    activationTemperature = 1e3 * constants::thermochemicalCalorie * perJoule;
  else if (is({"JOULES", "JOULE", "JOUL", "J"}))
    activationTemperature = perJoule;
  else if (is({"KJOULES", "KJOULE", "KJOUL", "KJOU", "KJ"}))
    activationTemperature = 1e3 * perJoule;
  else if (perMole)
    return false;
  else if (is({"MOLES", "MOLE", "MOL"}))
    quantity = 1;
  else if (is({"MOLECULES", "MOLECULE", "MOLEC"}))
    quantity = 1 / constants::avogadro;
  else if (is({"KELVINS", "KELVIN", "KELV", "K"}))
    activationTemperature = 1;
  else if (is({"EVOLTS", "EVOLT", "EVOL", "EV"}))
    activationTemperature = electronVolt / constants::boltzmann;
  else
    return false;
  return true;
}

std::string_view ChemkinUnits::expected() {
  return "CAL/MOLE, KCAL/MOLE, JOULES/MOLE, KJOULES/MOLE, KELVINS, EVOLTS, MOLES or MOLECULES";
}

}  // namespace lampblack::chemistry
