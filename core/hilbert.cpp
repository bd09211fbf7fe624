#include "core/hilbert.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lampblack {

std::uint64_t hilbertIndex(const std::array<double, 3>& place, int dimension) {
  const auto n = static_cast<std::size_t>(dimension);
  const int bits = dimension == 2 ? 31 : 21;
  std::array<std::uint32_t, 3> x{};
  for (std::size_t i = 0; i < n; ++i) {
    const double scaled = std::floor(std::ldexp(std::clamp(place[i], 0.0, 1.0), bits));
    x[i] = static_cast<std::uint32_t>(std::min(scaled, std::ldexp(1.0, bits) - 1.0));
  }
  // From the coarsest bit on: each half turns or reflects the finer ones.
  for (std::uint32_t half = std::uint32_t{1} << (bits - 1); half > 1; half >>= 1) {
    const std::uint32_t finer = half - 1;
    for (std::size_t i = 0; i < n; ++i) {
      if ((x[i] & half) != 0) {
        x[0] ^= finer;
      } else {
        const std::uint32_t swapped = (x[0] ^ x[i]) & finer;
        x[0] ^= swapped;
        x[i] ^= swapped;
      }
    }
  }
  // Gray code.
  for (std::size_t i = 1; i < n; ++i) x[i] ^= x[i - 1];
  std::uint32_t flip = 0;
  for (std::uint32_t half = std::uint32_t{1} << (bits - 1); half > 1; half >>= 1)
    if ((x[n - 1] & half) != 0) flip ^= half - 1;
  for (std::size_t i = 0; i < n; ++i) x[i] ^= flip;
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (std::size_t i = 0; i < n; ++i) index = index << 1 | ((x[i] >> bit) & 1U);
  return index;
}

}  // namespace lampblack
