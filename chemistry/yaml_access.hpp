// Reading YAML nodes with messages a user can act on: every error carries file and line and what was expected.
#pragma once

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <string>
#include <string_view>

namespace lampblack {

class YamlAccess {
 public:
  explicit YamlAccess(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  // One-based line of a node; 0 where yaml-cpp does not know.
  static int line(const YAML::Node& node);
  [[noreturn]] void fail(const YAML::Node& node, std::string_view message) const;

  // The named member of a map; InputError at the map's line if it is missing.
  YAML::Node member(const YAML::Node& map, const char* key, std::string_view what) const;
  std::string text(const YAML::Node& node, std::string_view what) const;
  double number(const YAML::Node& node, std::string_view what) const;
  bool flag(const YAML::Node& node, std::string_view what) const;
  void requireMap(const YAML::Node& node, std::string_view what) const;
  void requireSequence(const YAML::Node& node, std::string_view what) const;
  // InputError naming the nearest allowed key if the map has another one.
  void allowOnly(const YAML::Node& map, std::initializer_list<std::string_view> keys, std::string_view what) const;

 private:
  std::string file_;
};

// The units of a file in SI: 1 file unit = factor SI units. Cantera's defaults are SI with kmol.
struct FileUnits {
  double length = 1;                 // m
  double time = 1;                   // s
  double quantity = 1e3;             // mol
  double activationTemperature = 0;  // K per file unit of Ea

  static FileUnits read(const YamlAccess& yaml, const YAML::Node& units);
};

// Factor to K of an activation energy unit such as "cal/mol" or "K"; 0 if unknown.
double activationUnitInKelvin(std::string_view unit);

}  // namespace lampblack
