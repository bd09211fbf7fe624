// Powers of concentrations for reactions of any order, decimal or negative ones included.
//
// c^n, n = 1, 2, 3, 4: exactly, through zero. Other n > 1: zero for negative c. Other n < 1, except zero: below
// smallestConcentration the power is continued by the straight line through zero, c s^(n-1); so rates and their slopes
// stay finite, a consumed species stops its reaction whatever the order, and a slightly negative one drives it back.
#pragma once

#include <cmath>

#include "core/modules.hpp"

namespace lampblack::chemistry {

inline constexpr double smallestConcentration = 1e-10;  // mol/m3, s above; also the least sum that sets a pressure

inline double concentrationPower(double c, double n) {
  if (n == 1) return c;
  if (n == 2) return c * c;
  if (n == 3) return c * c * c;
  if (n == 4) return c * c * (c * c);
  if (n == 0) return 1;
  if (n < 1 && c < smallestConcentration) return c * std::pow(smallestConcentration, n - 1);
  return c > 0 ? std::pow(c, n) : 0.0;
}

// d c^n / dc
inline double concentrationPowerSlope(double c, double n) {
  if (n == 1) return 1;
  if (n == 2) return 2 * c;
  if (n == 3) return 3 * c * c;
  if (n == 4) return 4 * c * c * c;
  if (n == 0) return 0;
  if (n < 1 && c < smallestConcentration) return std::pow(smallestConcentration, n - 1);
  return c > 0 ? n * std::pow(c, n - 1) : 0.0;
}

}  // namespace lampblack::chemistry
