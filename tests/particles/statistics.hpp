// Statistics over repeats: a stochastic method is judged by the distance of its mean from the exact value in units of
// the standard error of that mean (z). Seeds are fixed, so that a test either always passes or always fails.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/every_module.hpp"

namespace lampblack::test {

inline constexpr double zLimit = 3.3;  // two-sided 99.9 %

struct Sample {
  double mean = 0, standardError = 0;
  [[nodiscard]] double z(double exact) const { return (mean - exact) / standardError; }
};

inline Sample summarise(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

}  // namespace lampblack::test
