// Where least-squares polynomials of temperature are fitted, and their variable: T^(-1/3), scaled to [-1, 1] over the
// range of the transport properties.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "chemistry/transport/transport.hpp"
#include "core/constants.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

inline double fitVariable(double T) {
  static const double atColdest = std::cbrt(1.0 / Transport::minTemperature),
                      atHottest = std::cbrt(1.0 / Transport::maxTemperature);
  return (2.0 * std::cbrt(1.0 / T) - atColdest - atHottest) / (atColdest - atHottest);
}

// factor * s^0..s^(Terms-1) of the variable at T.
template <std::size_t Terms>
std::array<double, Terms> fitPowers(double T, double factor = 1.0) {
  const double s = fitVariable(T);
  std::array<double, Terms> powers;
  powers[0] = factor;
  for (std::size_t m = 1; m < Terms; ++m) powers[m] = powers[m - 1] * s;
  return powers;
}

// Chebyshev points of the variable, and there the temperatures.
struct FitPoints {
  static constexpr std::size_t count = 32;
  std::array<double, count> s, T;

  FitPoints() {
    const double atColdest = std::cbrt(1.0 / Transport::minTemperature);
    const double atHottest = std::cbrt(1.0 / Transport::maxTemperature);
    for (std::size_t i = 0; i < count; ++i) {
      s[i] = -std::cos((static_cast<double>(i) + 0.5) / count * constants::pi);
      T[i] = std::pow(0.5 * (atColdest + atHottest) + 0.5 * (atColdest - atHottest) * s[i], -3.0);
    }
  }
};

}  // namespace lampblack::chemistry
