// The volume over a piston that a crank drives: Heywood (2018), Internal Combustion Engine Fundamentals, eq. 2.4
// to 2.6.
#pragma once

#include <cmath>
#include <numbers>

#include "core/modules.hpp"

namespace lampblack::chemistry {

struct SliderCrank {
  double bore = 0, stroke = 0, rod = 0;  // m; the rod is longer than half the stroke
  double compressionRatio = 0;           // largest over smallest volume

  [[nodiscard]] double pistonArea() const { return 0.25 * std::numbers::pi * bore * bore; }  // m^2
  [[nodiscard]] double displacement() const { return pistonArea() * stroke; }                // m^3
  [[nodiscard]] double clearance() const {
    return displacement() / (compressionRatio - 1);
  }  // m^3, the smallest volume

  // m^3 at an angle (rad) after top dead centre, and its change with the angle, m^3/rad.
  [[nodiscard]] double volume(double angle) const {
    const double R = 2 * rod / stroke, s = std::sin(angle);
    return clearance() + 0.5 * displacement() * (R + 1 - std::cos(angle) - std::sqrt(R * R - s * s));
  }
  [[nodiscard]] double slope(double angle) const {
    const double R = 2 * rod / stroke, s = std::sin(angle);
    return 0.5 * displacement() * s * (1 + std::cos(angle) / std::sqrt(R * R - s * s));
  }
};

}  // namespace lampblack::chemistry
