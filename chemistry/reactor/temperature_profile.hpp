// A given temperature over time or place: straight lines between points, constant before the first and after the last.
#pragma once

#include <optional>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class TemperatureProfile {
 public:
  // Everywhere the same temperature, K.
  explicit TemperatureProfile(double temperature);
  // Points in rising order. InputError where there are none, they do not rise, the numbers of points and temperatures
  // differ, or a temperature is not in Thermo's range.
  TemperatureProfile(std::vector<double> points, std::vector<double> temperatures);

  double value(double x) const;  // K
  double slope(double x) const;  // K per unit of x; at a kink that of the line that begins there
  const std::vector<double>& points() const { return points_; }
  const std::vector<double>& temperatures() const { return temperatures_; }  // K
  // The first kink after x.
  std::optional<double> nextKink(double x) const;

 private:
  std::vector<double> points_, temperatures_;
};

}  // namespace lampblack::chemistry
