// Reading YAML nodes with messages a user can act on: every error carries file and line and what was expected.
#pragma once

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/mechanism/mechanism_units.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class YamlAccess {
 public:
  explicit YamlAccess(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  // One-based line of a node; 0 where yaml-cpp does not know.
  static int line(const YAML::Node& node);
  [[noreturn]] void fail(const YAML::Node& node, std::string_view message) const;

  const std::string& text(const YAML::Node& node, std::string_view what) const;
  double number(const YAML::Node& node, std::string_view what) const;
  bool flag(const YAML::Node& node, std::string_view what) const;
  // A number that stands alone times `factor`, or one with a unit of the expected dimension ("10 bar"), in SI with mol.
  double quantity(const YAML::Node& node, const MechanismUnit& expected, double factor, std::string_view what) const;
  // The same for an activation energy, in K.
  double activationTemperature(const YAML::Node& node, const UnitSystem& units, std::string_view what) const;
  // The values of these keys in a map that has no others, or in a list in this order.
  std::vector<YAML::Node> values(const YAML::Node& node, std::initializer_list<std::string_view> keys,
                                 std::string_view what) const;
  void requireMap(const YAML::Node& node, std::string_view what) const;
  void requireSequence(const YAML::Node& node, std::string_view what) const;

  // The units of a `units` map on top of those that hold around it.
  UnitSystem units(const YAML::Node& map, UnitSystem around) const;

 private:
  std::string file_;
};

// The entries of a map node, listed once; a key given twice is an error. Keeps a reference to the YamlAccess.
class YamlMap {
 public:
  // `what` names the map in messages.
  YamlMap(const YamlAccess& yaml, const YAML::Node& map, std::string what);

  struct Entry {
    std::string_view key;
    YAML::Node keyNode, value;
  };
  const std::vector<Entry>& entries() const { return entries_; }
  const YAML::Node& node() const { return node_; }
  const std::string& what() const { return what_; }
  void rename(std::string what) { what_ = std::move(what); }

  // The value of a key; null if it is missing.
  const YAML::Node* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  // The value of a key; InputError at the map's line if it is missing.
  const YAML::Node& at(std::string_view key) const;
  // InputError naming the nearest allowed key if the map has another one.
  void allowOnly(const std::vector<std::string_view>& keys) const;
  // A warning for each other key, which is for another program. One that hardly differs from an allowed key is a slip:
  // an InputError unless slips are warnings too.
  enum class Slips { Refused, Warnings };
  void warnOfOthers(const std::vector<std::string_view>& keys, std::vector<std::string>& warnings,
                    Slips slips = Slips::Refused) const;

  // The values of optional keys.
  bool flag(std::string_view key, bool standard) const;
  double number(std::string_view key, double standard) const;

 private:
  std::string unknownKeyText(const Entry& entry, const std::vector<std::string_view>& keys) const;

  const YamlAccess& yaml_;
  YAML::Node node_;
  std::string what_;
  std::vector<Entry> entries_;
};

}  // namespace lampblack::chemistry
