// Up to 64 entries of a sorted store side by side, in order of volume, then weight, with what the store has to know of
// them: bounds of their rates, their total weight and their smallest difference of volume between neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "particles/population/monte_carlo/chunk_trees.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack {

// `bare`: the particle is nothing but its volume, and is not stored a second time.
template <class Particle, bool bare>
struct SortedChunk {
  static constexpr std::uint32_t capacity = 64, none = ~std::uint32_t{0};
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // volume[size] is the volume of the first entry of the next chunk; infinity where there is none.
  alignas(64) std::array<double, capacity + 8> volume;
  alignas(64) std::array<double, capacity> weight;
  std::vector<Particle> particles;  // unless bare
  std::uint32_t size = 0, previous = none, next = none;

  // What the sums know of this chunk: bounds from above that stay as they are while few entries come and go.
  std::uint32_t countBound = 0;
  double weightBound = 0, weightSum = 0;
  CollisionKernel::Terms terms;                   // bounds of those of its entries
  std::array<double, singleProcesses> singles{};  // likewise
  double lowest = 0, highest = 0;                 // volumes for which the bounds of terms and singles hold
  std::uint32_t changes = 0;                      // since these bounds were found from the entries

  // The smallest difference (thesis eqs. 5-11, 5-12) and the weight of the lower particle of that pair, which is at
  // `leastAt`; where stale, `least` is a bound from below.
  LeastOfChunks::Key least;
  std::uint32_t leastAt = 0;
  bool stale = false;
  double heaviest = 0;  // bound of the largest weight
  bool heaviestExact = false;
  bool used = false;

  SortedChunk() : volume{}, weight{} { volume[0] = infinity; }

  [[nodiscard]] bool below(std::uint32_t k, double v, double w) const {
    return volume[k] < v || (volume[k] == v && weight[k] < w);
  }
  // Number of entries below (v, w).
  [[nodiscard]] std::uint32_t position(double v, double w) const {
    std::uint64_t count = 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      count += static_cast<std::uint64_t>(volume[k] < v) |
               (static_cast<std::uint64_t>(volume[k] == v) & static_cast<std::uint64_t>(weight[k] < w));
    }
    return static_cast<std::uint32_t>(count);
  }
  [[nodiscard]] bool contains(double v, double w) const {  // surely: between its first and last entry
    return size > 0 && !below(size - 1, v, w) && (volume[0] < v || (volume[0] == v && weight[0] <= w));
  }

  void insertAt(std::uint32_t at, double v, double w) {
    std::memmove(&volume[at + 1], &volume[at], (size + 1 - at) * sizeof(double));
    std::memmove(&weight[at] + 1, &weight[at], (size - at) * sizeof(double));
    volume[at] = v;
    weight[at] = w;
    ++size;
    weightSum += w;
    ++changes;
  }
  void eraseAt(std::uint32_t at) {
    weightSum -= weight[at];
    std::memmove(&volume[at], &volume[at + 1], (size - at) * sizeof(double));
    std::memmove(&weight[at], &weight[at] + 1, (size - 1 - at) * sizeof(double));
    --size;
    ++changes;
    if constexpr (!bare) particles.erase(particles.begin() + at);
  }

  // The entry in which `x` falls, the weights being laid end to end; `size` where it lies beyond.
  [[nodiscard]] std::uint32_t atWeight(double x) const {
    std::uint32_t k = 0;
    for (; k + 8 <= size; k += 8) {
      const double* w = &weight[k];
      const double sum = ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]));
      if (x < sum) break;
      x -= sum;
    }
    for (; k < size; ++k) {
      if (x < weight[k]) return k;
      x -= weight[k];
    }
    return size;
  }
  [[nodiscard]] double sumOfWeights() const {
    std::array<double, 4> sum{};
    std::uint32_t k = 0;
    for (; k + 4 <= size; k += 4) {
      for (std::uint32_t lane = 0; lane < 4; ++lane) sum[lane] += weight[k + lane];
    }
    for (; k < size; ++k) sum[0] += weight[k];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
  }
  [[nodiscard]] double largestWeight() const {
    double largest = 0;
    for (std::uint32_t k = 0; k < size; ++k) largest = std::max(largest, weight[k]);
    return largest;
  }

  // Difference between entry k and the one after it.
  template <bool relative>
  [[nodiscard]] double difference(std::uint32_t k) const {
    const double d = volume[k + 1] - volume[k];
    return relative ? d / volume[k] : d;
  }
  // Entry k and the next one as a candidate for the smallest difference.
  template <bool relative>
  void consider(std::uint32_t k) {
    const LeastOfChunks::Key key{difference<relative>(k), weight[k]};
    if (!(key < least)) return;
    least = key;
    leastAt = k;
    stale = false;
  }
  // Doubles of zero or more are ordered like the integers with their bits, whose minimum takes vector instructions.
  template <bool relative>
  void findLeast() {
    std::array<std::int64_t, capacity> bits;
    std::int64_t smallest = std::bit_cast<std::int64_t>(infinity), lightest = smallest;
    for (std::uint32_t k = 0; k < size; ++k) bits[k] = std::bit_cast<std::int64_t>(difference<relative>(k));
    for (std::uint32_t k = 0; k < size; ++k) smallest = bits[k] < smallest ? bits[k] : smallest;
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::int64_t w = std::bit_cast<std::int64_t>(weight[k]);
      const std::int64_t candidate = bits[k] == smallest ? w : std::bit_cast<std::int64_t>(infinity);
      lightest = candidate < lightest ? candidate : lightest;
    }
    stale = false;
    least = {std::bit_cast<double>(smallest), std::bit_cast<double>(lightest)};
    for (leastAt = 0; leastAt < size; ++leastAt) {
      if (bits[leastAt] == smallest && weight[leastAt] == least.second) return;
    }
  }
  // After an entry came to `at`, or left from there; pairs of the entry are not considered yet.
  void leastMovedUp(std::uint32_t at) {
    if (leastAt >= at) ++leastAt;
  }
  void leastMovedDown(std::uint32_t at) {
    if (leastAt == at || leastAt + 1 == at)
      stale = true;
    else if (leastAt > at)
      --leastAt;
  }
};

}  // namespace lampblack
