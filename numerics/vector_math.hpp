// exp and log over flat arrays, written so that the compiler can vectorise the loops: no branches, no tables, no calls.
// Both are accurate to a few units in the last place (tests/numerics/vector_math_test.cpp).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::numerics::vectormath {

// exp(x) for |x| <= 708; outside, the exponent saturates at that bound (about 3e-308 and 3e+307). Reduction
// x = n ln2 + r with |r| <= ln2/2, then the Taylor polynomial of degree 13 of exp(r), truncated below 1e-17.
inline double expOne(double x) {
  x = x > 708.0 ? 708.0 : x;
  x = x < -708.0 ? -708.0 : x;
  constexpr double shifter = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer in the low bits
  const double shifted = x * 1.44269504088896338700 + shifter;
  const double n = shifted - shifter;
  const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  const auto bits = std::bit_cast<std::uint64_t>(shifted);
  const double scale = std::bit_cast<double>((bits + 1023U) << 52U);
  return p * scale;
}

// ln(x) for normal positive x. x = 2^e m with m in [sqrt(1/2), sqrt(2)); ln m = 2 artanh(f), f = (m-1)/(m+1), by its
// series to f^21 (|f| <= 0.172, truncated below 1e-18).
inline double logOne(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t rootHalf = 0x3fe6a09e667f3bcdU;
  const std::uint64_t offset = bits - rootHalf;
  const auto e = static_cast<std::int64_t>(offset) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(e) << 52U));
  const double f = (m - 1.0) / (m + 1.0);
  const double s = f * f;
  double p = 1.0 / 21.0;
  p = p * s + 1.0 / 19.0;
  p = p * s + 1.0 / 17.0;
  p = p * s + 1.0 / 15.0;
  p = p * s + 1.0 / 13.0;
  p = p * s + 1.0 / 11.0;
  p = p * s + 1.0 / 9.0;
  p = p * s + 1.0 / 7.0;
  p = p * s + 1.0 / 5.0;
  p = p * s + 1.0 / 3.0;
  const double n = static_cast<double>(e);
  return n * 6.93147180369123816490e-01 + (n * 1.90821492927058770002e-10 + (2.0 * f + 2.0 * f * s * p));
}

inline void exp(const double* x, double* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = expOne(x[i]);
}

inline void log(const double* x, double* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = logOne(x[i]);
}

}  // namespace lampblack::numerics::vectormath
