#include "chemistry/reactor/reactor_replay.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <span>

#include "chemistry/mechanism/yaml_access.hpp"
#include "core/text_file.hpp"

namespace lampblack::chemistry {

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

YAML::Node load(const std::string& path) {
  try {
    return YAML::Load(readTextFile(path, "a cell that a run kept, failed_cell_<number>.yaml"));
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}: {}", path, error.mark.line + 1, error.msg));
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : yaml_(path), file_(yaml_, load(path), "a replay file") {
    file_.allowOnly({"mechanism", "temperature", "pressure", "duration", "first_step", "relative_tolerance",
                     "absolute_tolerance", "max_steps", "rosenbrock_steps", "negligible_change", "mass_fractions",
                     "source", "heating", "rate_factor", "reason"});
  }

  std::string mechanism() const {
    namespace fs = std::filesystem;
    const fs::path path = yaml_.text(file_.at("mechanism"), "mechanism");
    if (path.is_absolute()) return path.string();
    return (fs::path(yaml_.file()).parent_path() / path).lexically_normal().string();
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
    positive("max_steps");
    cell.options.maxSteps = whole("max_steps");
    cell.options.rosenbrockSteps = whole("rosenbrock_steps");
    cell.Y = bySpecies(mechanism, "mass_fractions");
    if (file_.has("source")) cell.source = bySpecies(mechanism, "source");
    cell.heating = value("heating");
    cell.rateFactor = value("rate_factor");
    cell.reason = yaml_.text(file_.at("reason"), "reason");
    return cell;
  }

 private:
  // Any number, .nan and .inf among them.
  double number(const YAML::Node& node, const std::string& what) const {
    double result = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, result))
      yaml_.fail(node, fmt::format("{}: expected a number", what));
    return result;
  }
  double value(const char* key) const { return number(file_.at(key), key); }

  int whole(const char* key) const {
    const double result = value(key);
    if (!(result >= 0) || result != std::floor(result) || result > 1e9)
      yaml_.fail(file_.at(key), fmt::format("{}: expected a whole number", key));
    return static_cast<int>(result);
  }

  double positive(const char* key) const {
    const double result = value(key);
    if (!(result > 0) || !std::isfinite(result))
      yaml_.fail(file_.at(key), fmt::format("{}: expected a number above zero", key));
    return result;
  }

  std::vector<double> bySpecies(const Mechanism& mechanism, const char* key) const {
    const YamlMap map(yaml_, file_.at(key), key);
    std::vector<double> values(mechanism.numSpecies());
    for (const auto& entry : map.entries()) {
      std::size_t k = 0;
      try {
        k = mechanism.speciesIndex(entry.key);
      } catch (const InputError& error) {
        yaml_.fail(entry.keyNode, error.what());
      }
      values[k] = number(entry.value, fmt::format("{} of {}", key, entry.key));
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!map.has(mechanism.speciesName(k)))
        yaml_.fail(map.node(), fmt::format("{}: '{}' is missing; expected a value for each of the {} species of {}",
                                           key, mechanism.speciesName(k), values.size(), mechanism.fileName()));
    return values;
  }

  YamlAccess yaml_;
  YamlMap file_;
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
  add("first_step", exact(cell.firstStep), "  # s, of the Rosenbrock method; 0: the whole duration");
  add("relative_tolerance", exact(cell.options.relativeTolerance), "");
  add("absolute_tolerance", exact(cell.options.absoluteTolerance), "  # of a mass fraction");
  add("max_steps", fmt::format("{}", cell.options.maxSteps), "  # of CVODE");
  add("rosenbrock_steps", fmt::format("{}", cell.options.rosenbrockSteps), "  # before CVODE takes over");
  add("negligible_change", exact(cell.options.negligibleChange), "");
  text += "mass_fractions:\n" + bySpecies(mechanism, cell.Y);
  if (!cell.source.empty()) text += "source:  # 1/s\n" + bySpecies(mechanism, cell.source);
  add("heating", exact(cell.heating), "  # W/kg");
  add("rate_factor", exact(cell.rateFactor), "  # on the rates of the reactions");
  add("reason", quoted(cell.reason), "");
  return text;
}

Replay readReplay(const std::string& path) {
  const Reader reader(path);
  Mechanism mechanism = Mechanism::fromFile(reader.mechanism());
  FailedCell cell = reader.cell(mechanism);
  return {std::move(mechanism), std::move(cell)};
}

}  // namespace lampblack::chemistry
