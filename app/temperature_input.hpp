// A temperature given by points in a deck, `temperature_profile`: its keys, and reading them. The same words for
// reactors and flames.
#pragma once

#include <string>

#include "chemistry/reactor/temperature_profile.hpp"
#include "io/deck.hpp"

namespace lampblack {

// A temperature in Thermo's range.
DeckKey temperatureKey(std::string path, std::string doc);

// Adds `temperature` and `file` to the section `temperature_profile`; the file's first column is what `fileDoc` says.
// The section itself and its points, `time` or `position`, are the caller's.
void addTemperatureProfileKeys(DeckSchema& schema, const std::string& fileDoc);

// The section, whose points stand in the key `points` ("time" or "position") or in a file. InputError.
TemperatureProfile readTemperatureProfile(const Deck& deck, const std::string& points);

}  // namespace lampblack
