// The temperatures that an input may ask of a mechanism.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct TemperatureRange {
  double low = 0, high = 0;  // K, both allowed

  [[nodiscard]] bool contains(double T) const { return T >= low && T <= high; }
  [[nodiscard]] TemperatureRange within(const TemperatureRange& other) const;
};

// From the lowest to the highest temperature that any species' polynomials know, extrapolated by at most 100 K down to
// 200 K and by at most 1000 K up to 6000 K. Species whose own data end earlier are extrapolated as far.
TemperatureRange temperatureRange(const Mechanism& mechanism);

}  // namespace lampblack::chemistry
