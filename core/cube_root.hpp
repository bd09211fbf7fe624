// The cube root of volumes, which particles ask for at every event: faster than the C library's, to four units in the
// last place (tests/core/cube_root_test.cpp).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace lampblack {

inline double cubeRoot(double x) {
  const double size = std::abs(x);
  if (!(size > 1e-290 && size < 1e290)) return std::cbrt(x);  // zero, subnormal, infinite, not a number
  // A third of the exponent, by the bits: within 4 %.
  const std::uint64_t third = std::bit_cast<std::uint64_t>(size) / 3 + (std::uint64_t{715094163} << 32U);
  double root = std::bit_cast<double>(third);
  const double inverse = 1.0 / size;
  // root (1 + e)^(-1/3), e = root^3 / x - 1, as a series in e: first to 2e-6, then to round-off.
  double e = root * root * root * inverse - 1.0;
  root *= 1.0 + e * (-1.0 / 3.0 + e * (2.0 / 9.0 + e * (-14.0 / 81.0 + e * (35.0 / 243.0))));
  e = root * root * root * inverse - 1.0;
  root += root * e * (-1.0 / 3.0 + e * (2.0 / 9.0));
  return std::copysign(root, x);
}

}  // namespace lampblack
