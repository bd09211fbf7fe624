// The cube root of volumes, which particles ask for at every event: faster than the C library's, to four units in the
// last place (tests/core/cube_root_test.cpp).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace lampblack {

// Of 1e-290 to 1e290 only. Without a branch, for loops that are to be vectorised.
[[gnu::always_inline]] inline double normalCubeRoot(double size) {
  // A third of the exponent, by the upper bits (divided by a product, as vectors have no division): within 4 %.
  const std::uint64_t upper = ((std::bit_cast<std::uint64_t>(size) >> 32U) * 0xaaaaaaabU) >> 33U;
  double root = std::bit_cast<double>((upper + 715094163U) << 32U);
  const double inverse = 1.0 / size;
  // root (1 + e)^(-1/3), e = root^3 / x - 1, as a series in e: first to 2e-6, then to round-off.
  double e = root * root * root * inverse - 1.0;
  root *= 1.0 + e * (-1.0 / 3.0 + e * (2.0 / 9.0 + e * (-14.0 / 81.0 + e * (35.0 / 243.0))));
  e = root * root * root * inverse - 1.0;
  root += root * e * (-1.0 / 3.0 + e * (2.0 / 9.0));
  return root;
}

inline double cubeRoot(double x) {
  const double size = std::abs(x);
  if (!(size > 1e-290 && size < 1e290)) return std::cbrt(x);  // zero, subnormal, infinite, not a number
  return std::copysign(normalCubeRoot(size), x);
}

}  // namespace lampblack
