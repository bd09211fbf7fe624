// Systematic sampling: whole numbers of copies whose means are given. One random number serves all: element k gets as
// many copies as there are points of a comb with teeth at one another's distance of one in its part of the sum. So the
// number of all copies is within one of its mean, and so is that of any run of neighbours: sorted by size, all sizes
// are met.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::particles {

// expected(k) >= 0 is the mean number of copies of element k.
template <class Expected>
[[nodiscard]] std::vector<std::size_t> systematicCopies(std::size_t count, const Expected& expected,
                                                        RandomStream& random) {
  std::vector<std::size_t> copies(count);
  double sum = random.uniform(), teeth = 0;
  for (std::size_t k = 0; k < count; ++k) {
    sum += expected(k);
    const double passed = std::floor(sum);
    copies[k] = static_cast<std::size_t>(passed - teeth);
    teeth = passed;
  }
  return copies;
}

// The next of a row of points in [0, 1) that fill it evenly wherever the row is cut (the golden ratio's multiples;
// Kronecker's sequence). From a random beginning each point alone is uniform. Who draws with them from a sorted
// population by probabilities of several outcomes gets of any run of neighbours nearly the mean of each.
inline void nextEvenPoint(double& point) {
  constexpr double goldenPart = 0.61803398874989484820;
  point += goldenPart;
  if (point >= 1) point -= 1;
}

}  // namespace lampblack::particles
