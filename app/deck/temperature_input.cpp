#include "app/deck/temperature_input.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "app/deck/two_columns.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

DeckKey temperatureKey(std::string path, std::string doc) {
  return quantityKey(std::move(path), units::temperature, std::move(doc))
      .atLeast(Thermo::minTemperature)
      .atMost(Thermo::maxTemperature);
}

DeckKey temperatureRules() {
  return temperatureKey({}, {});
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
  SectionKeys keys("temperature_profile");
  keys.quantity("temperature", units::temperature, temperatureRules().list().optional(),
                "Temperatures of the gas at the points.");
  keys.text("file", rules().optional(),
            "CSV file with the points, in place of lists, of two columns, " + fileDoc +
                " and temperature in K; a first line of names, in a comment or not, may say other units, 'z [cm],T "
                "[degC]'; other lines that begin with # are skipped. Relative to the deck.");
  schema.add(keys.schema());
}

namespace {

TemperatureProfile readPoints(const Deck& deck, const std::string& points) {
  const units::Dimension dimension = points == "time" ? units::time : units::length;
  const std::string section = "temperature_profile";
  const bool listed = deck.has(section + "." + points) || deck.has(section + ".temperature");
  if (listed == deck.has(section + ".file"))
    throw deck.error(section, fmt::format("expected either '{}' and 'temperature' or 'file'", points));
  try {
    if (!listed) {
      TwoColumns columns =
          readTwoColumns(deck.resolvePath(deck.string(section + ".file")), dimension, units::temperature,
                         "z [cm],T [K]", [](double T) { static_cast<void>(TemperatureProfile(T)); });
      return {std::move(columns.points), std::move(columns.values)};
    }
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
