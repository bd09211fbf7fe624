#include "chemistry/yaml_access.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack {

int YamlAccess::line(const YAML::Node& node) {
  if (!node.IsDefined()) return 0;
  const auto mark = node.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

void YamlAccess::fail(const YAML::Node& node, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", file_, line(node), message));
}

YAML::Node YamlAccess::member(const YAML::Node& map, const char* key, std::string_view what) const {
  requireMap(map, what);
  const YAML::Node found = map[key];
  if (!found.IsDefined()) fail(map, fmt::format("{} has no '{}'", what, key));
  return found;
}

std::string YamlAccess::text(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsScalar()) fail(node, fmt::format("{}: expected text", what));
  return node.Scalar();
}

double YamlAccess::number(const YAML::Node& node, std::string_view what) const {
  double value = 0;
  if (!node.IsDefined() || !node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    fail(node, fmt::format("{}: expected a number{}", what,
                           node.IsDefined() && node.IsScalar() ? fmt::format(", found '{}'", node.Scalar()) : ""));
  return value;
}

bool YamlAccess::flag(const YAML::Node& node, std::string_view what) const {
  bool value = false;
  if (!node.IsDefined() || !node.IsScalar() || !YAML::convert<bool>::decode(node, value))
    fail(node, fmt::format("{}: expected true or false", what));
  return value;
}

void YamlAccess::requireMap(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsMap()) fail(node, fmt::format("{}: expected a map of keys and values", what));
}

void YamlAccess::requireSequence(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsSequence()) fail(node, fmt::format("{}: expected a list", what));
}

void YamlAccess::allowOnly(const YAML::Node& map, std::initializer_list<std::string_view> keys,
                           std::string_view what) const {
  const std::vector<std::string_view> known(keys);
  for (const auto& entry : map) {
    const auto key = text(entry.first, what);
    bool allowed = false;
    for (const auto k : known) allowed = allowed || k == key;
    if (!allowed)
      fail(entry.first,
           fmt::format("{}: unknown key '{}'; the nearest known key is '{}'", what, key, closestName(key, known)));
  }
}

double activationUnitInKelvin(std::string_view unit) {
  constexpr double R = constants::gasConstant;
  constexpr double cal = constants::thermochemicalCalorie;
  if (unit == "K") return 1.0;
  if (unit == "cal/mol" || unit == "kcal/kmol") return cal / R;
  if (unit == "kcal/mol") return 1e3 * cal / R;
  if (unit == "J/mol" || unit == "kJ/kmol") return 1.0 / R;
  if (unit == "kJ/mol") return 1e3 / R;
  if (unit == "J/kmol") return 1e-3 / R;
  if (unit == "eV") return 1.602176634e-19 / constants::boltzmann;
  return 0.0;
}

FileUnits FileUnits::read(const YamlAccess& yaml, const YAML::Node& units) {
  FileUnits result;
  result.activationTemperature = activationUnitInKelvin("J/kmol");
  if (!units.IsDefined()) return result;
  yaml.requireMap(units, "units");
  yaml.allowOnly(
      units, {"length", "time", "quantity", "activation-energy", "mass", "energy", "pressure", "temperature"}, "units");
  double energy = 1;
  const auto choose = [&](const char* key, double& value,
                          std::initializer_list<std::pair<std::string_view, double>> options) {
    const YAML::Node node = units[key];
    if (!node.IsDefined()) return false;
    const auto given = yaml.text(node, fmt::format("units '{}'", key));
    std::string expected;
    for (const auto& [name, factor] : options) {
      if (name == given) {
        value = factor;
        return true;
      }
      expected += fmt::format("{}{}", expected.empty() ? "" : ", ", name);
    }
    yaml.fail(node, fmt::format("units '{}': unknown unit '{}'; expected one of {}", key, given, expected));
  };
  choose("length", result.length, {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}});
  choose("time", result.time, {{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}, {"hr", 3600.0}});
  choose("quantity", result.quantity,
         {{"mol", 1.0}, {"gmol", 1.0}, {"kmol", 1e3}, {"molec", 1.0 / constants::avogadro}});
  const bool energyGiven = choose("energy", energy,
                                  {{"J", 1.0},
                                   {"kJ", 1e3},
                                   {"cal", constants::thermochemicalCalorie},
                                   {"kcal", 1e3 * constants::thermochemicalCalorie},
                                   {"erg", 1e-7}});
  // Without a unit of its own, an activation energy is in energy per quantity of the file.
  if (energyGiven || units["quantity"].IsDefined())
    result.activationTemperature = energy / result.quantity / constants::gasConstant;
  if (const YAML::Node node = units["activation-energy"]; node.IsDefined()) {
    const auto given = yaml.text(node, "units 'activation-energy'");
    result.activationTemperature = activationUnitInKelvin(given);
    if (result.activationTemperature == 0)
      yaml.fail(node, fmt::format("units 'activation-energy': unknown unit '{}'; expected K, J/mol, kJ/mol, J/kmol, "
                                  "cal/mol, kcal/mol or eV",
                                  given));
  }
  return result;
}

}  // namespace lampblack
