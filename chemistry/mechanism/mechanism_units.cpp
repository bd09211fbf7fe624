#include "chemistry/mechanism/mechanism_units.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

constexpr double kElementaryCharge = 1.602176634e-19;  // C, exact since 2019

using Exponents = std::array<double, 5>;
constexpr Exponents kMass{1, 0, 0, 0, 0}, kLength{0, 1, 0, 0, 0}, kTime{0, 0, 1, 0, 0}, kTemperature{0, 0, 0, 1, 0},
    kAmount{0, 0, 0, 0, 1}, kEnergy{1, 2, -2, 0, 0}, kForce{1, 1, -2, 0, 0}, kPressure{1, -1, -2, 0, 0},
    kVolume{0, 3, 0, 0, 0};

struct KnownUnit {
  std::string_view name;
  MechanismUnit unit;
};

constexpr std::array<KnownUnit, 32> kUnits{{
    {"1", {1.0, {}}},
    {"kg", {1.0, kMass}},
    {"g", {1e-3, kMass}},
    {"m", {1.0, kLength}},
    {"micron", {1e-6, kLength}},
    {"angstrom", {1e-10, kLength}},
    {"Å", {1e-10, kLength}},
    {"s", {1.0, kTime}},
    {"min", {60.0, kTime}},
    {"hr", {3600.0, kTime}},
    {"K", {1.0, kTemperature}},
    {"C", {1.0, kTemperature}},  // a difference, as in J/C
    {"mol", {1.0, kAmount}},
    {"gmol", {1.0, kAmount}},
    {"mole", {1.0, kAmount}},
    {"kmol", {1e3, kAmount}},
    {"kgmol", {1e3, kAmount}},
    {"molec", {1.0 / constants::avogadro, kAmount}},
    {"J", {1.0, kEnergy}},
    {"cal", {constants::thermochemicalCalorie, kEnergy}},
    {"erg", {1e-7, kEnergy}},
    {"eV", {kElementaryCharge, kEnergy}},
    {"N", {1.0, kForce}},
    {"dyn", {1e-5, kForce}},
    {"Pa", {1.0, kPressure}},
    {"atm", {constants::oneAtmosphere, kPressure}},
    {"bar", {1e5, kPressure}},
    {"m³", {1.0, kVolume}},
    {"liter", {1e-3, kVolume}},
    {"L", {1e-3, kVolume}},
    {"l", {1e-3, kVolume}},
    {"cc", {1e-6, kVolume}},
}};

constexpr std::array<std::pair<char, double>, 19> kPrefixes{{{'Y', 1e24},
                                                             {'Z', 1e21},
                                                             {'E', 1e18},
                                                             {'P', 1e15},
                                                             {'T', 1e12},
                                                             {'G', 1e9},
                                                             {'M', 1e6},
                                                             {'k', 1e3},
                                                             {'h', 1e2},
                                                             {'d', 1e-1},
                                                             {'c', 1e-2},
                                                             {'m', 1e-3},
                                                             {'u', 1e-6},
                                                             {'n', 1e-9},
                                                             {'p', 1e-12},
                                                             {'f', 1e-15},
                                                             {'a', 1e-18},
                                                             {'z', 1e-21},
                                                             {'y', 1e-24}}};

std::optional<MechanismUnit> findUnit(std::string_view name) {
  for (const auto& known : kUnits)
    if (known.name == name) return known.unit;
  for (const auto& [prefix, factor] : kPrefixes) {
    if (name.empty() || name.front() != prefix) continue;
    for (const auto& known : kUnits)
      if (known.name == name.substr(1)) return MechanismUnit{factor * known.unit.factor, known.unit.exponents};
  }
  return std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// "cm^3" to the power of `sign`, multiplied to the unit.
void multiply(MechanismUnit& unit, std::string_view group, double sign, std::string_view all) {
  double exponent = 1;
  auto name = group;
  if (const auto caret = group.find('^'); caret != std::string_view::npos) {
    name = group.substr(0, caret);
    const auto power = trimmed(group.substr(caret + 1));
    const auto parsed = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (parsed.ec != std::errc{} || parsed.ptr != power.data() + power.size() || !(std::abs(exponent) <= 100))
      throw InputError(fmt::format("unit '{}': expected a number after '^', found '{}'", all, power));
  }
  const auto known = findUnit(trimmed(name));
  if (!known) throw InputError(fmt::format("unit '{}': '{}' is not a known unit", all, trimmed(name)));
  exponent *= sign;
  unit.factor *= std::pow(known->factor, exponent);
  for (std::size_t i = 0; i < unit.exponents.size(); ++i) unit.exponents[i] += exponent * known->exponents[i];
}

}  // namespace

// Decimal orders of reactions make decimal powers of units, which agree only to rounding.
bool MechanismUnit::sameDimension(const MechanismUnit& other) const {
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (std::abs(exponents[i] - other.exponents[i]) > 1e-9) return false;
  return true;
}

MechanismUnit parseMechanismUnit(std::string_view text) {
  text = trimmed(text);
  MechanismUnit unit;
  double sign = 1;
  for (std::size_t start = 0;;) {
    const auto stop = std::min(text.find_first_of("*/", start), text.size());
    multiply(unit, text.substr(start, stop - start), sign, text);
    if (stop == text.size()) break;
    sign = text[stop] == '/' ? -1 : 1;
    start = stop + 1;
  }
  if (!std::isfinite(unit.factor) || !(unit.factor > 0))
    throw InputError(fmt::format("unit '{}': its size is out of range", text));
  return unit;
}

MechanismUnit rateConstantUnit(double order) {
  return {1.0, {0, 3 * (order - 1), -1, 0, 1 - order}};
}

std::string describe(const MechanismUnit& unit) {
  static constexpr std::array<std::string_view, 5> names{"kg", "m", "s", "K", "mol"};
  if (unit.exponents == kPressure) return "Pa";
  std::string text;
  for (const bool numerator : {true, false})
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double exponent = unit.exponents[i];
      if (exponent == 0 || (exponent > 0) != numerator) continue;
      text += numerator ? (text.empty() ? "" : "*") : (text.empty() ? "1/" : "/");
      text += names[i];
      if (std::abs(exponent) != 1) text += fmt::format("^{:.4g}", std::abs(exponent));
    }
  return text.empty() ? "1" : text;
}

double activationUnitInKelvin(std::string_view text) {
  const auto unit = parseMechanismUnit(text);
  if (unit.exponents == kTemperature) return unit.factor;
  if (unit.exponents == kEnergy) return unit.factor / constants::boltzmann;
  auto perAmount = kEnergy;
  perAmount[MechanismUnit::Amount] = -1;
  if (unit.exponents == perAmount) return unit.factor / constants::gasConstant;
  throw InputError(
      fmt::format("'{}' is not a unit of an activation energy; expected one such as cal/mol, kJ/mol, K or "
                  "eV",
                  text));
}

bool UnitSystem::set(std::string_view quantity, std::string_view text) {
  if (quantity == "activation-energy") {
    activation_ = activationUnitInKelvin(text);
    return true;
  }
  double unused = 1;
  struct Known {
    std::string_view quantity;
    Exponents exponents;
    double* value;
    std::string_view examples;
  };
  const std::array<Known, 7> known{{{"length", kLength, &length_, "m, cm or mm"},
                                    {"time", kTime, &time_, "s, min or hr"},
                                    {"quantity", kAmount, &amount_, "mol, kmol or molec"},
                                    {"energy", kEnergy, &energy_, "J, kJ, cal or kcal"},
                                    {"pressure", kPressure, &pressure_, "Pa, atm or bar"},
                                    {"mass", kMass, &unused, "kg or g"},
                                    {"temperature", kTemperature, &unused, "K"}}};
  for (const auto& entry : known) {
    if (entry.quantity != quantity) continue;
    const auto unit = findUnit(text) ? *findUnit(text) : parseMechanismUnit(text);
    if (unit.exponents != entry.exponents || (quantity == "temperature" && text != "K"))
      throw InputError(
          fmt::format("'{}' is not a unit of {}; expected one such as {}", text, quantity, entry.examples));
    *entry.value = unit.factor;
    return true;
  }
  return false;
}

double UnitSystem::rateConstant(double order) const {
  return std::pow(length_ * length_ * length_ / amount_, order - 1) / time_;
}

double UnitSystem::activationTemperature() const {
  return activation_ > 0 ? activation_ : energy_ / amount_ / constants::gasConstant;
}

}  // namespace lampblack::chemistry
