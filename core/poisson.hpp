// Poisson-distributed numbers.
#pragma once

#include <cmath>

#include "core/random.hpp"

namespace lampblack {

// With this mean, zero or above. Small means by multiplying uniform numbers; large ones by transformed rejection from a
// table mountain (Hormann 1993, algorithm PTRS), exact up to the rounding of the log-gamma function.
inline double poisson(RandomStream& random, double mean) {
  if (!(mean > 0)) return 0;
  if (mean < 10) {
    const double limit = std::exp(-mean);
    double product = random.uniform(), count = 0;
    while (product > limit) {
      product *= random.uniform();
      ++count;
    }
    return count;
  }
  const double root = std::sqrt(mean), b = 0.931 + 2.53 * root, a = -0.059 + 0.02483 * b;
  const double inverseAlpha = 1.1239 + 1.1328 / (b - 3.4), bound = 0.9277 - 3.6224 / (b - 2), logMean = std::log(mean);
  while (true) {
    const double u = random.uniform() - 0.5, v = random.uniform(), us = 0.5 - std::abs(u);
    const double k = std::floor((2 * a / us + b) * u + mean + 0.43);
    if (us >= 0.07 && v <= bound) return k;
    if (k < 0 || (us < 0.013 && v > us)) continue;
    if (std::log(v * inverseAlpha / (a / (us * us) + b)) <= k * logMean - mean - std::lgamma(k + 1)) return k;
  }
}

}  // namespace lampblack
