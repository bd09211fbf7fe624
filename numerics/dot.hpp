// Sum of products, with running sums side by side that the compiler can keep in one vector register.
#pragma once

#include <cstddef>

#include "core/modules.hpp"

namespace lampblack::numerics {

inline double dot(const double* __restrict a, const double* __restrict b, std::size_t n) {
  constexpr std::size_t width = 8;
  double sums[width] = {};
  std::size_t k = 0;
  for (; k + width <= n; k += width)
    for (std::size_t l = 0; l < width; ++l) sums[l] += a[k + l] * b[k + l];
  for (std::size_t l = 0; k < n; ++k, ++l) sums[l] += a[k] * b[k];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace lampblack::numerics
