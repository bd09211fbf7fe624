#include "chemistry/mechanism/yaml_access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

struct NumberAndRest {
  double value = 0;
  std::string_view rest;
};

// Empty unless the text starts with a finite decimal number.
std::optional<NumberAndRest> leadingNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  NumberAndRest result;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), result.value);
  if (parsed.ec != std::errc{} || !std::isfinite(result.value)) return std::nullopt;
  result.rest = text.substr(static_cast<std::size_t>(parsed.ptr - text.data()));
  return result;
}

}  // namespace

int YamlAccess::line(const YAML::Node& node) {
  if (!node.IsDefined()) return 0;
  const auto mark = node.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

void YamlAccess::fail(const YAML::Node& node, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", file_, line(node), message));
}

const std::string& YamlAccess::text(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsScalar()) fail(node, fmt::format("{}: expected text", what));
  return node.Scalar();
}

double YamlAccess::number(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsScalar()) fail(node, fmt::format("{}: expected a number", what));
  const auto parsed = leadingNumber(node.Scalar());
  if (!parsed || !parsed->rest.empty())
    fail(node, fmt::format("{}: expected a number, found '{}'", what, node.Scalar()));
  return parsed->value;
}

bool YamlAccess::flag(const YAML::Node& node, std::string_view what) const {
  bool value = false;
  if (!node.IsDefined() || !node.IsScalar() || !YAML::convert<bool>::decode(node, value))
    fail(node, fmt::format("{}: expected true or false", what));
  return value;
}

double YamlAccess::quantity(const YAML::Node& node, const MechanismUnit& expected, double factor,
                            std::string_view what) const {
  const auto& given = text(node, what);
  const auto parsed = leadingNumber(given);
  if (!parsed || !(parsed->rest.empty() || parsed->rest.front() == ' '))
    fail(node, fmt::format("{}: expected a number, with or without a unit, found '{}'", what, given));
  if (parsed->rest.empty()) return parsed->value * factor;
  try {
    const auto unit = parseMechanismUnit(parsed->rest);
    if (!unit.sameDimension(expected))
      throw InputError(fmt::format("'{}' has the wrong unit; expected one like {}", given, describe(expected)));
    return parsed->value * unit.factor;
  } catch (const InputError& error) {
    fail(node, fmt::format("{}: {}", what, error.what()));
  }
}

double YamlAccess::activationTemperature(const YAML::Node& node, const UnitSystem& units, std::string_view what) const {
  const auto& given = text(node, what);
  const auto parsed = leadingNumber(given);
  if (!parsed || !(parsed->rest.empty() || parsed->rest.front() == ' '))
    fail(node, fmt::format("{}: expected a number or a number with a unit such as cal/mol, found '{}'", what, given));
  if (parsed->rest.empty()) return parsed->value * units.activationTemperature();
  try {
    return parsed->value * activationUnitInKelvin(parsed->rest);
  } catch (const InputError& error) {
    fail(node, fmt::format("{}: {}", what, error.what()));
  }
}

std::vector<YAML::Node> YamlAccess::values(const YAML::Node& node, std::initializer_list<std::string_view> keys,
                                           std::string_view what) const {
  std::vector<YAML::Node> result;
  if (node.IsDefined() && node.IsSequence()) {
    if (node.size() != keys.size()) {
      std::string names;
      for (const auto key : keys) names.append(names.empty() ? "" : ", ").append(key);
      fail(node, fmt::format("{}: expected {}; found {} values", what, names, node.size()));
    }
    for (const auto& value : node) result.push_back(value);
    return result;
  }
  const YamlMap map(*this, node, std::string(what));
  map.allowOnly(keys);
  for (const auto key : keys) result.push_back(map.at(key));
  return result;
}

void YamlAccess::requireMap(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsMap()) fail(node, fmt::format("{}: expected a map of keys and values", what));
}

void YamlAccess::requireSequence(const YAML::Node& node, std::string_view what) const {
  if (!node.IsDefined() || !node.IsSequence()) fail(node, fmt::format("{}: expected a list", what));
}

UnitSystem YamlAccess::units(const YAML::Node& map, UnitSystem around) const {
  const YamlMap entries(*this, map, "units");
  for (const auto& entry : entries.entries()) {
    const auto& unit = text(entry.value, fmt::format("units '{}'", entry.key));
    bool known = false;
    try {
      known = around.set(entry.key, unit);
    } catch (const InputError& error) {
      fail(entry.value, fmt::format("units: {}", error.what()));
    }
    if (!known)
      fail(entry.keyNode, fmt::format("units: unknown quantity '{}'; expected length, time, quantity, mass, energy, "
                                      "pressure, temperature or activation-energy",
                                      entry.key));
  }
  return around;
}

YamlMap::YamlMap(const YamlAccess& yaml, const YAML::Node& map, std::string what)
    : yaml_(yaml), node_(map), what_(std::move(what)) {
  yaml_.requireMap(map, what_);
  entries_.reserve(map.size());
  for (const auto& entry : map) entries_.push_back({yaml_.text(entry.first, what_), entry.first, entry.second});
  std::vector<std::string_view> keys;
  for (const auto& entry : entries_) keys.push_back(entry.key);
  std::sort(keys.begin(), keys.end());
  if (const auto twice = std::adjacent_find(keys.begin(), keys.end()); twice != keys.end())
    yaml_.fail(map, fmt::format("{}: the key '{}' is given twice", what_, *twice));
}

const YAML::Node* YamlMap::find(std::string_view key) const {
  for (const auto& entry : entries_)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

const YAML::Node& YamlMap::at(std::string_view key) const {
  if (const auto* found = find(key)) return *found;
  yaml_.fail(node_, fmt::format("{} has no '{}'", what_, key));
}

std::string YamlMap::unknownKeyText(const Entry& entry, const std::vector<std::string_view>& keys) const {
  return fmt::format("{}: unknown key '{}'; the nearest known key is '{}'", what_, entry.key,
                     closestName(entry.key, keys));
}

void YamlMap::allowOnly(const std::vector<std::string_view>& keys) const {
  for (const auto& entry : entries_)
    if (std::find(keys.begin(), keys.end(), entry.key) == keys.end())
      yaml_.fail(entry.keyNode, unknownKeyText(entry, keys));
}

void YamlMap::warnOfOthers(const std::vector<std::string_view>& keys, std::vector<std::string>& warnings,
                           Slips slips) const {
  for (const auto& entry : entries_) {
    if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
    if (slips == Slips::Refused && !nearestName(entry.key, {keys.begin(), keys.end()}).empty())
      yaml_.fail(entry.keyNode, unknownKeyText(entry, keys));
    warnings.push_back(fmt::format("{}:{}: {}; it is passed over", yaml_.file(), YamlAccess::line(entry.keyNode),
                                   unknownKeyText(entry, keys)));
  }
}

bool YamlMap::flag(std::string_view key, bool standard) const {
  const auto* found = find(key);
  return found == nullptr ? standard : yaml_.flag(*found, fmt::format("{}, '{}'", what_, key));
}

double YamlMap::number(std::string_view key, double standard) const {
  const auto* found = find(key);
  return found == nullptr ? standard : yaml_.number(*found, fmt::format("{}, '{}'", what_, key));
}

}  // namespace lampblack::chemistry
