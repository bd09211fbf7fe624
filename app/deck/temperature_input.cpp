#include "app/deck/temperature_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/table_column.hpp"

namespace lampblack::app {
namespace {

std::string trimmed(const std::string& line) {
  return line.substr(0, line.find('\r'));
}

// The fields of a line, without the blanks and quotes around them: between commas, or between blanks where there are
// none.
std::vector<std::string> fieldsOf(std::string line) {
  const bool commas = line.find(',') != std::string::npos;
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (c == '"')
      quoted = !quoted;
    else if (!quoted && (commas ? c == ',' : blank))
      fields.emplace_back();
    else if (quoted || !blank)
      fields.back() += c;
  }
  if (!commas) std::erase(fields, "");
  return fields;
}

// NaN and infinities are numbers that nobody wants here, not names.
std::optional<double> numberIn(const std::string& field) {
  const std::string_view digits = field.starts_with('+') ? std::string_view(field).substr(1) : std::string_view(field);
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || status == std::errc::invalid_argument || end != digits.data() + digits.size())
    return std::nullopt;
  return status == std::errc{} ? value : std::numeric_limits<double>::infinity();
}

// Of a header: units behind a blank belong to the name before them where blanks separate the columns.
std::vector<std::string> joinedWithUnits(std::vector<std::string> names) {
  for (std::size_t i = 1; i < names.size();) {
    if (!names[i].starts_with('[') && !names[i].starts_with('(')) {
      ++i;
      continue;
    }
    names[i - 1] += ' ' + names[i];
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return names;
}

// Two columns of numbers, separated by a comma or blanks. The first line may be a header: one without any number, with
// units behind the names or without.
TemperatureProfile readProfileFile(const std::filesystem::path& path, const units::Dimension& pointDimension) {
  std::istringstream file(readTextFile(path, "a profile of two columns"));
  std::vector<double> points, temperatures;
  bool first = true;
  std::size_t number = 0;
  TableColumn pointColumn("", "", pointDimension), temperatureColumn("", "", units::temperature);
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::vector<std::string> fields = fieldsOf(line);
    if (std::all_of(fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); }) ||
        fields[0].starts_with('#'))
      continue;
    const auto refuse = [&](const std::string& why) {
      throw InputError(fmt::format("{}:{}: {}", path.string(), number, why));
    };
    const bool header =
        std::exchange(first, false) &&
        std::none_of(fields.begin(), fields.end(), [](const auto& field) { return numberIn(field).has_value(); });
    if (header) {
      const std::vector<std::string> names = joinedWithUnits(fields);
      if (names.size() != 2) {
        if (line.find_first_of("[(") != std::string::npos)
          refuse(fmt::format("expected the names of two columns, 'z [cm],T [K]', found '{}'", trimmed(line)));
        continue;
      }
      try {
        const auto [pointName, pointUnit] = nameAndUnit(names[0]);
        const auto [temperatureName, temperatureUnit] = nameAndUnit(names[1]);
        pointColumn = TableColumn(pointName, pointUnit, pointDimension);
        temperatureColumn = TableColumn(temperatureName, temperatureUnit, units::temperature);
      } catch (const InputError& error) {
        refuse(error.what());
      }
      continue;
    }
    auto point = numberIn(fields[0]), temperature = fields.size() == 2 ? numberIn(fields[1]) : std::nullopt;
    if (!point || !temperature || !std::isfinite(*point) || !std::isfinite(*temperature))
      refuse(fmt::format("expected two numbers, found '{}'", trimmed(line)));
    point = pointColumn.inSI(*point);
    temperature = temperatureColumn.inSI(*temperature);
    if (!points.empty() && !(*point > points.back()))
      refuse(fmt::format("the points have to rise; {} follows {}", *point, points.back()));
    try {
      static_cast<void>(TemperatureProfile(*temperature));
    } catch (const InputError& error) {
      refuse(error.what());
    }
    points.push_back(*point);
    temperatures.push_back(*temperature);
  }
  if (points.empty()) throw InputError(fmt::format("{}: expected lines of two numbers, found none", path.string()));
  return {std::move(points), std::move(temperatures)};
}

}  // namespace

DeckKey temperatureKey(std::string path, std::string doc) {
  return quantityKey(std::move(path), units::temperature, std::move(doc))
      .atLeast(Thermo::minTemperature)
      .atMost(Thermo::maxTemperature);
}

TemperatureRange allowedTemperatures(const Mechanism& mechanism, TemperatureUse use) {
  const TemperatureRange range = temperatureRange(mechanism);
  // Reactors and flames need room beyond what they start from.
  switch (use) {
    case TemperatureUse::reactor:
      return range.within({Thermo::minTemperature + 50, Thermo::maxTemperature - 500});
    case TemperatureUse::transport:
      return range.within({Transport::minTemperature, Transport::maxTemperature});
    case TemperatureUse::properties:
      break;
  }
  return range;
}

std::string temperatureProblem(double temperature, const Mechanism& mechanism, TemperatureUse use) {
  const TemperatureRange range = allowedTemperatures(mechanism, use);
  if (range.contains(temperature)) return {};
  const char* whose = use == TemperatureUse::transport ? "thermodynamic and transport data" : "thermodynamic data";
  return fmt::format("expected a temperature from {:g} to {:g} K, as far as the {} of {} are used; found {:g} K",
                     range.low, range.high, whose, std::filesystem::path(mechanism.fileName()).filename().string(),
                     temperature);
}

void requireTemperature(const Deck& deck, const std::string& key, double temperature, const Mechanism& mechanism,
                        TemperatureUse use) {
  if (const std::string problem = temperatureProblem(temperature, mechanism, use); !problem.empty())
    throw deck.error(key, problem);
}

double readTemperature(const Deck& deck, const std::string& key, const Mechanism& mechanism, TemperatureUse use) {
  const double temperature = deck.quantity(key);
  requireTemperature(deck, key, temperature, mechanism, use);
  return temperature;
}

void addTemperatureProfileKeys(DeckSchema& schema, const std::string& fileDoc) {
  schema
      .add(
          temperatureKey("temperature_profile.temperature", "Temperatures of the gas at the points.").list().optional())
      .add(stringKey("temperature_profile.file", "CSV file with the points, in place of lists, of two columns, " +
                                                     fileDoc +
                                                     " and temperature in K; a first line of names may say other "
                                                     "units, 'z [cm],T [degC]', and lines that begin with # are "
                                                     "skipped. Relative to the deck.")
               .optional());
}

namespace {

TemperatureProfile readPoints(const Deck& deck, const std::string& points) {
  const units::Dimension dimension = points == "time" ? units::time : units::length;
  const std::string section = "temperature_profile";
  const bool listed = deck.has(section + "." + points) || deck.has(section + ".temperature");
  if (listed == deck.has(section + ".file"))
    throw deck.error(section, fmt::format("expected either '{}' and 'temperature' or 'file'", points));
  try {
    if (!listed) return readProfileFile(deck.resolvePath(deck.string(section + ".file")), dimension);
    for (const std::string& name : {points, std::string("temperature")})
      if (!deck.has(section + "." + name))
        throw InputError(fmt::format("'{}' and 'temperature' belong together: give both or neither", points));
    return {deck.quantities(section + "." + points), deck.quantities(section + ".temperature")};
  } catch (const InputError& error) {
    throw deck.error(listed ? section : section + ".file", error.what());
  }
}

}  // namespace

TemperatureProfile readTemperatureProfile(const Deck& deck, const std::string& points, const Mechanism& mechanism,
                                          TemperatureUse use) {
  TemperatureProfile profile = readPoints(deck, points);
  const std::string section = "temperature_profile.", file = section + "file";
  for (std::size_t i = 0; i < profile.temperatures().size(); ++i)
    requireTemperature(deck, deck.has(file) ? file : fmt::format("{}temperature[{}]", section, i),
                       profile.temperatures()[i], mechanism, use);
  return profile;
}

}  // namespace lampblack::app
