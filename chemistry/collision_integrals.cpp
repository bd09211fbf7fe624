#include "chemistry/collision_integrals.hpp"

#include <array>
#include <cmath>

namespace lampblack {

namespace {

double thesisFit(const std::array<double, 6>& a, double T, double delta) {
  const double nonpolar = a[0] * std::pow(T, -a[1]) + std::pow(T + a[2], -a[3]);
  const double polar = (std::exp(a[4] / T) - std::exp(-a[5] / T)) * delta * delta / (2.0 + 2.5 * delta);
  return nonpolar * (1.0 + polar);
}

double brokaw(double T, double delta) {
  return 0.19 * delta * delta / T;
}

}  // namespace

double collisionIntegral11(double T, double delta, CollisionIntegrals source) {
  if (source == CollisionIntegrals::ThesisFits)
    return thesisFit({1.0548, 0.15504, 0.55909, 2.1705, 0.093193, 1.5}, T, delta);
  return 1.06036 * std::pow(T, -0.15610) + 0.19300 * std::exp(-0.47635 * T) + 1.03587 * std::exp(-1.52996 * T) +
         1.76474 * std::exp(-3.89411 * T) + brokaw(T, delta);
}

double collisionIntegral22(double T, double delta, CollisionIntegrals source) {
  if (source == CollisionIntegrals::ThesisFits)
    return thesisFit({1.0413, 0.11930, 0.43628, 1.6041, 0.095661, 2.0}, T, delta);
  return 1.16145 * std::pow(T, -0.14874) + 0.52487 * std::exp(-0.77320 * T) + 2.16178 * std::exp(-2.43787 * T) -
         6.435e-4 * std::pow(T, 0.14874) * std::sin(18.0323 * std::pow(T, -0.76830) - 7.27371) + brokaw(T, delta);
}

}  // namespace lampblack
