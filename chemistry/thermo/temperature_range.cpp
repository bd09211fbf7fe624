#include "chemistry/thermo/temperature_range.hpp"

#include <algorithm>

namespace lampblack::chemistry {

TemperatureRange TemperatureRange::within(const TemperatureRange& other) const {
  return {std::max(low, other.low), std::min(high, other.high)};
}

TemperatureRange temperatureRange(const Mechanism& mechanism) {
  constexpr double usualLow = 200, usualHigh = 6000, furtherDown = 100, furtherUp = 1000;
  const auto& species = mechanism.allSpecies();
  const auto byLow = [](const Species& a, const Species& b) {
    return a.thermo.minTemperature < b.thermo.minTemperature;
  };
  const auto byHigh = [](const Species& a, const Species& b) {
    return a.thermo.maxTemperature < b.thermo.maxTemperature;
  };
  const double low = std::min_element(species.begin(), species.end(), byLow)->thermo.minTemperature;
  const double high = std::max_element(species.begin(), species.end(), byHigh)->thermo.maxTemperature;
  return {std::min(low, std::max(low - furtherDown, usualLow)), std::max(high, std::min(high + furtherUp, usualHigh))};
}

}  // namespace lampblack::chemistry
