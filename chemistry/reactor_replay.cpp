#include "chemistry/reactor_replay.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <span>

#include "chemistry/yaml_access.hpp"

namespace lampblack {

namespace {

std::string exact(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return fmt::format("{:.17g}", value);
}

// Text between double quotes, as YAML and JSON have it.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::string bySpecies(const Mechanism& mechanism, std::span<const double> values) {
  std::string out;
  for (std::size_t k = 0; k < values.size(); ++k)
    out += fmt::format("  {}: {}\n", quoted(mechanism.speciesName(k)), exact(values[k]));
  return out;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : yaml_(path) {
    try {
      root_ = YAML::LoadFile(path);
    } catch (const YAML::BadFile&) {
      throw InputError(fmt::format("{}: cannot be opened", path));
    } catch (const YAML::Exception& error) {
      throw InputError(fmt::format("{}:{}: {}", path, error.mark.line + 1, error.msg));
    }
    yaml_.requireMap(root_, "a replay file");
    yaml_.allowOnly(root_,
                    {"mechanism", "temperature", "pressure", "duration", "first_step", "relative_tolerance",
                     "absolute_tolerance", "max_steps", "negligible_change", "mass_fractions", "source", "reason"},
                    "a replay file");
  }

  std::string mechanism() const {
    namespace fs = std::filesystem;
    const fs::path path = yaml_.text(member("mechanism"), "mechanism");
    return path.is_absolute() ? path.string()
                              : (fs::path(yaml_.file()).parent_path() / path).lexically_normal().string();
  }

  FailedCell cell(const Mechanism& mechanism) const {
    FailedCell cell;
    cell.temperature = value("temperature");
    cell.pressure = value("pressure");
    cell.duration = value("duration");
    cell.firstStep = value("first_step");
    cell.options.relativeTolerance = positive("relative_tolerance");
    cell.options.absoluteTolerance = positive("absolute_tolerance");
    cell.options.negligibleChange = value("negligible_change");
    const double steps = positive("max_steps");
    if (steps != std::floor(steps) || steps > 1e9)
      yaml_.fail(member("max_steps"), "max_steps: expected a whole number");
    cell.options.maxSteps = static_cast<int>(steps);
    cell.Y = bySpecies(mechanism, "mass_fractions");
    if (root_["source"].IsDefined()) cell.source = bySpecies(mechanism, "source");
    cell.reason = yaml_.text(member("reason"), "reason");
    return cell;
  }

 private:
  YAML::Node member(const char* key) const { return yaml_.member(root_, key, "a replay file"); }

  // Any number, .nan and .inf among them.
  double number(const YAML::Node& node, const std::string& what) const {
    double result = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, result))
      yaml_.fail(node, fmt::format("{}: expected a number", what));
    return result;
  }
  double value(const char* key) const { return number(member(key), key); }

  double positive(const char* key) const {
    const double result = value(key);
    if (!(result > 0) || !std::isfinite(result))
      yaml_.fail(member(key), fmt::format("{}: expected a number above zero", key));
    return result;
  }

  std::vector<double> bySpecies(const Mechanism& mechanism, const char* key) const {
    const YAML::Node map = member(key);
    yaml_.requireMap(map, key);
    std::vector<double> values(mechanism.numSpecies());
    std::vector<char> given(values.size(), 0);
    for (const auto& entry : map) {
      const std::string name = yaml_.text(entry.first, key);
      std::size_t k = 0;
      try {
        k = mechanism.speciesIndex(name);
      } catch (const InputError& error) {
        yaml_.fail(entry.first, error.what());
      }
      if (given[k] != 0) yaml_.fail(entry.first, fmt::format("{}: '{}' is given twice", key, name));
      given[k] = 1;
      values[k] = number(entry.second, fmt::format("{} of {}", key, name));
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      if (given[k] == 0)
        yaml_.fail(map, fmt::format("{}: '{}' is missing; expected a value for each of the {} species of {}", key,
                                    mechanism.speciesName(k), values.size(), mechanism.fileName()));
    return values;
  }

  YamlAccess yaml_;
  YAML::Node root_;
};

}  // namespace

std::string replayText(const Mechanism& mechanism, const FailedCell& cell) {
  std::string text = "# A cell whose chemistry could not be advanced. To try it again: lampblack replay <this file>\n";
  const auto add = [&](const char* key, const std::string& value, const char* unit) {
    text += fmt::format("{}: {}{}\n", key, value, unit);
  };
  add("mechanism", quoted(std::filesystem::absolute(mechanism.fileName()).string()), "");
  add("temperature", exact(cell.temperature), "  # K");
  add("pressure", exact(cell.pressure), "  # Pa");
  add("duration", exact(cell.duration), "  # s");
  add("first_step", exact(cell.firstStep), "  # s; 0: the solver's choice");
  add("relative_tolerance", exact(cell.options.relativeTolerance), "");
  add("absolute_tolerance", exact(cell.options.absoluteTolerance), "  # of a mass fraction");
  add("max_steps", fmt::format("{}", cell.options.maxSteps), "");
  add("negligible_change", exact(cell.options.negligibleChange), "");
  text += "mass_fractions:\n" + bySpecies(mechanism, cell.Y);
  if (!cell.source.empty()) text += "source:  # 1/s\n" + bySpecies(mechanism, cell.source);
  add("reason", quoted(cell.reason), "");
  return text;
}

Replay readReplay(const std::string& path) {
  const Reader reader(path);
  Mechanism mechanism = Mechanism::fromFile(reader.mechanism());
  FailedCell cell = reader.cell(mechanism);
  return {std::move(mechanism), std::move(cell)};
}

}  // namespace lampblack
