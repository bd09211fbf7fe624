// Temperatures in a deck: in the range of the mechanism's data, which is the same for every problem; and those given by
// points, `temperature_profile`, in the same words for reactors and flames.
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/temperature_profile.hpp"
#include "chemistry/thermo/temperature_range.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// A temperature of a gas: in the range that any mechanism may have.
DeckKey temperatureKey(std::string path, std::string doc);
// Its range alone, of a key that is bound (io/deck_keys.hpp).
DeckKey temperatureRules();

// What a temperature is for: transport properties and the solvers of reactors narrow the range of a mechanism.
enum class TemperatureUse { properties, reactor, transport };
TemperatureRange allowedTemperatures(const Mechanism& mechanism, TemperatureUse use);

// The temperature at a key; InputError with the range where it is outside.
double readTemperature(const Deck& deck, const std::string& key, const Mechanism& mechanism, TemperatureUse use);
// The same for a temperature that has been read already.
void requireTemperature(const Deck& deck, const std::string& key, double temperature, const Mechanism& mechanism,
                        TemperatureUse use);
// "expected a temperature from 200 to 4000 K (the data of ...), found 150 K"; empty where it is in the range.
std::string temperatureProblem(double temperature, const Mechanism& mechanism, TemperatureUse use);

// Adds `temperature` and `file` to the section `temperature_profile`; the file's first column is what `fileDoc` says.
// The section itself and its points, `time` or `position`, are the caller's.
void addTemperatureProfileKeys(DeckSchema& schema, const std::string& fileDoc);

// The section, whose points stand in the key `points` ("time" or "position") or in a file. InputError.
TemperatureProfile readTemperatureProfile(const Deck& deck, const std::string& points, const Mechanism& mechanism,
                                          TemperatureUse use);

}  // namespace lampblack::app
