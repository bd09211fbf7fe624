#include "app/temperature_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"

namespace lampblack {
namespace {

// Two columns of numbers, separated by a comma or blanks.
TemperatureProfile readProfileFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", path.string()));
  std::vector<double> points, temperatures;
  std::string line;
  bool named = false;
  for (int number = 1; std::getline(file, line); ++number) {
    for (char& c : line)
      if (c == ',' || c == '\r') c = ' ';
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    std::istringstream words(line);
    double point = 0, temperature = 0;
    std::string more;
    if (words >> point >> temperature && !(words >> more)) {
      points.push_back(point);
      temperatures.push_back(temperature);
    } else if (std::exchange(named, true) || !points.empty()) {
      throw InputError(fmt::format("{}:{}: expected two numbers, found '{}'", path.string(), number, line));
    }
  }
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
  schema.add(temperatureKey("temperature_profile.temperature", "Temperatures of the points.").list().optional())
      .add(stringKey("temperature_profile.file", "Instead: a CSV file of two columns, " + fileDoc +
                                                     " and temperature in K; a first line of names and lines that "
                                                     "begin with # are skipped. Relative to the deck.")
               .optional());
}

namespace {

TemperatureProfile readPoints(const Deck& deck, const std::string& points) {
  const std::string section = "temperature_profile";
  const bool listed = deck.has(section + "." + points) || deck.has(section + ".temperature");
  if (listed == deck.has(section + ".file"))
    throw deck.error(section, fmt::format("expected either '{}' and 'temperature' or 'file'", points));
  try {
    if (!listed) return readProfileFile(deck.resolvePath(deck.string(section + ".file")));
    for (const std::string& name : {points, std::string("temperature")})
      if (!deck.has(section + "." + name))
        throw InputError(fmt::format("'{}' and 'temperature' belong together", points));
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

}  // namespace lampblack
