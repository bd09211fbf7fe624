#include "io/unit_symbols.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/letter_case.hpp"

namespace lampblack::io::units {
namespace {

struct Symbol {
  std::string_view name;
  Unit unit;
  bool takesPrefix = false;
};

constexpr double degree = std::numbers::pi / 180.0;

// Defining constants: BIPM, The International System of Units, 9th edition (2019); atm and Torr: CGPM 1954.
constexpr std::array<Symbol, 32> symbols{{
    {"m", {1.0, 0.0, length}, true},
    {"g", {1e-3, 0.0, mass}, true},
    {"s", {1.0, 0.0, time}, true},
    {"K", {1.0, 0.0, temperature}, true},
    {"mol", {1.0, 0.0, amount}, true},
    {"rad", {1.0, 0.0, angle}, true},
    {"deg", {degree, 0.0, angle}},
    {"°", {degree, 0.0, angle}},
    {"degC", {1.0, 273.15, temperature}},
    {"°C", {1.0, 273.15, temperature}},
    {"min", {60.0, 0.0, time}},
    {"h", {3600.0, 0.0, time}},
    {"Hz", {1.0, 0.0, frequency}, true},
    {"N", {1.0, 0.0, force}, true},
    {"Pa", {1.0, 0.0, pressure}, true},
    {"bar", {1e5, 0.0, pressure}, true},
    {"atm", {101325.0, 0.0, pressure}},
    {"Torr", {101325.0 / 760.0, 0.0, pressure}},
    {"J", {1.0, 0.0, energy}, true},
    {"cal", {4.184, 0.0, energy}, true},
    {"eV", {1.602176634e-19, 0.0, energy}, true},
    {"W", {1.0, 0.0, watt}, true},
    {"L", {1e-3, 0.0, volume}, true},
    {"l", {1e-3, 0.0, volume}, true},
    {"P", {0.1, 0.0, viscosity}, true},
    {"t", {1e3, 0.0, mass}},
    {"rpm", {degree * 6.0, 0.0, angularVelocity}},
    {"%", {1e-2, 0.0, dimensionless}},
    {"ppm", {1e-6, 0.0, dimensionless}},
    {"ppb", {1e-9, 0.0, dimensionless}},
    {"Å", {1e-10, 0.0, length}},
    {"um", {1e-6, 0.0, length}},
}};

struct Prefix {
  std::string_view name;
  double factor;
};

constexpr std::array<Prefix, 15> prefixes{{{"f", 1e-15},
                                           {"p", 1e-12},
                                           {"n", 1e-9},
                                           {"u", 1e-6},
                                           {"\u00b5", 1e-6},
                                           {"\u03bc", 1e-6},
                                           {"m", 1e-3},
                                           {"c", 1e-2},
                                           {"d", 1e-1},
                                           {"h", 1e2},
                                           {"k", 1e3},
                                           {"M", 1e6},
                                           {"G", 1e9},
                                           {"T", 1e12},
                                           {"da", 1e1}}};

// What people write for a unit, in letters of any case, and how to give it here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 38> otherUnits{{
    {"c", "write degC"},
    {"celsius", "write degC"},
    {"f", "write K or degC"},
    {"degf", "write K or degC"},
    {"kelvin", "write K"},
    {"°k", "write K"},
    {"r", "one of Rankine is 5/9 K"},
    {"dyn", "one is 1e-5 N"},
    {"cad", "write deg"},
    {"ca", "write deg"},
    {"sec", "write s"},
    {"secs", "write s"},
    {"second", "write s"},
    {"seconds", "write s"},
    {"msec", "write ms"},
    {"usec", "write us"},
    {"mins", "write min"},
    {"minute", "write min"},
    {"minutes", "write min"},
    {"hr", "write h"},
    {"hour", "write h"},
    {"hours", "write h"},
    {"day", "one is 24 h"},
    {"days", "one is 24 h"},
    {"micron", "write um"},
    {"microns", "write um"},
    {"a", "write Å, or tenths of nm"},
    {"angstrom", "write Å, or tenths of nm"},
    {"in", "one is 25.4 mm"},
    {"inch", "one is 25.4 mm"},
    {"ft", "one is 0.3048 m"},
    {"psi", "one is 6894.757 Pa"},
    {"mmhg", "write Torr"},
    {"cc", "write cm^3"},
    {"#", "write 1, as in 1/cm^3"},
    {"sccm", "standard volumes are not read; give the mass flow, '1 g/min', or the velocity that it makes"},
    {"slm", "standard volumes are not read; give the mass flow, '1 g/min', or the velocity that it makes"},
    {"slpm", "standard volumes are not read; give the mass flow, '1 g/min', or the velocity that it makes"},
}};

}  // namespace

std::optional<Unit> unitOfSymbol(std::string_view name) {
  for (const Symbol& symbol : symbols) {
    if (symbol.name == name) return symbol.unit;
  }
  for (const Symbol& symbol : symbols) {
    if (!symbol.takesPrefix || !name.ends_with(symbol.name)) continue;
    const std::string_view front = name.substr(0, name.size() - symbol.name.size());
    for (const Prefix& prefix : prefixes) {
      if (prefix.name == front) return Unit{prefix.factor * symbol.unit.factor, 0.0, symbol.unit.dimension};
    }
  }
  return std::nullopt;
}

std::string unitAsWrittenHere(std::string_view name) {
  std::string meant;
  std::vector<std::string> told;
  const auto consider = [&](std::string_view prefix, const Symbol& symbol) {
    const std::string known = std::string(prefix).append(symbol.name);
    if (std::ranges::find(told, known) != told.end()) return;  // "um" stands for itself and is a prefixed m
    if (!sameInAnyCase(name, known)) return;
    told.push_back(known);
    meant += (meant.empty() ? "; did you mean " : " or ") + known;
  };
  for (const Symbol& symbol : symbols) {
    consider("", symbol);
    for (const Prefix& prefix : prefixes)
      if (symbol.takesPrefix) consider(prefix.name, symbol);
  }
  if (!meant.empty()) return meant + '?';
  for (const auto& [other, here] : otherUnits)
    if (sameInAnyCase(name, other)) return fmt::format("; {}", here);
  return {};
}

}  // namespace lampblack::io::units
