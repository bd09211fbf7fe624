#include "chemistry/collision_integrals.hpp"

#include <array>
#include <cmath>

namespace lampblack {

namespace {

double fit(const std::array<double, 6>& a, double T, double delta) {
  const double nonpolar = a[0] * std::pow(T, -a[1]) + std::pow(T + a[2], -a[3]);
  const double polar = (std::exp(a[4] / T) - std::exp(-a[5] / T)) * delta * delta / (2.0 + 2.5 * delta);
  return nonpolar * (1.0 + polar);
}

}  // namespace

double collisionIntegral11(double reducedTemperature, double reducedDipole) {
  return fit({1.0548, 0.15504, 0.55909, 2.1705, 0.093193, 1.5}, reducedTemperature, reducedDipole);
}

double collisionIntegral22(double reducedTemperature, double reducedDipole) {
  return fit({1.0413, 0.11930, 0.43628, 1.6041, 0.095661, 2.0}, reducedTemperature, reducedDipole);
}

}  // namespace lampblack
