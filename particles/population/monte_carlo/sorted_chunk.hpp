// Up to 64 entries of a sorted store side by side, in order of volume, then weight, with what the store has to know of
// them: bounds of their rates, their total weight and their smallest difference of volume between neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/chunk_trees.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack::particles {

// `bare`: the particle is nothing but its volume, and is not stored a second time.
//
// Loops run over all 64 places in vectors, whatever is in use: how often they run is then known to the compiler and to
// the branch predictor, which costs less than stopping early.
template <class Particle, bool bare>
struct SortedChunk {
  static constexpr std::uint32_t places = 64, capacity = places - 1, none = ~std::uint32_t{0};
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // Entries from `size` on have infinite volume and no weight, but for volume(size), which is the volume of the first
  // entry of the next chunk.
  std::vector<Particle> particles;  // unless bare
  std::uint32_t size = 0, previous = none, next = none;

  // What the sums know of this chunk: bounds from above that stay as they are while few entries come and go.
  std::uint32_t countBound = 0;
  double weightBound = 0, weightSum = 0;
  CollisionKernel::Terms terms;                   // bounds of those of its entries
  std::array<double, singleProcesses> singles{};  // likewise
  double lowest = 0, highest = 0;                 // volumes for which the bounds of terms and singles hold
  std::uint32_t changes = 0;                      // since these bounds were found from the entries

  // The smallest difference (Wang 2025, eqs. 5-11, 5-12) and the weight of the lower particle of that pair, which is at
  // `leastAt`; where stale, `least` is a bound from below.
  LeastOfChunks::Key least;
  std::uint32_t leastAt = 0;
  bool stale = false;
  double heaviest = 0;  // bound of the largest weight
  bool heaviestExact = false;
  bool used = false;

  SortedChunk() {
    volumes_.fill(infinity);
    weights_.fill(0);
  }

  // Into the cache, for what comes soon: all of it; what is known of it; that and the weights.
  void fetch() const { fetchLines(this, sizeof(SortedChunk)); }
  void fetchHead() const { fetchLines(this, sizeof(SortedChunk) - 2 * sizeof(Column)); }
  void fetchWeights() const {
    fetchHead();
    fetchLines(weights(), places * sizeof(double));
  }

  [[nodiscard]] double volume(std::uint32_t k) const { return volumes_[margin + k]; }
  [[nodiscard]] double weight(std::uint32_t k) const { return weights_[margin + k]; }
  [[nodiscard]] const double* weights() const { return &weights_[margin]; }
  void setNextVolume(double v) { volumes_[margin + size] = v; }

  [[nodiscard]] bool below(std::uint32_t k, double v, double w) const {
    return volume(k) < v || (volume(k) == v && weight(k) < w);
  }
  // Number of entries below (v, w).
  [[nodiscard]] std::uint32_t position(double v, double w) const {
    Bits count{};
    for (std::uint32_t k = 0; k < places; k += lanes) {
      const Lanes x = load(&volumes_[margin + k]), y = load(&weights_[margin + k]);
      count -= (x < v) | ((x == v) & (y < w));
    }
    std::int64_t sum = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) sum += count[lane];
    // The next chunk's first entry may have been counted.
    return static_cast<std::uint32_t>(sum) - static_cast<std::uint32_t>(below(size, v, w));
  }
  [[nodiscard]] bool contains(double v, double w) const {  // surely: between its first and last entry
    return size > 0 && !below(size - 1, v, w) && (volume(0) < v || (volume(0) == v && weight(0) <= w));
  }

  // At most mostCopies side by side.
  static constexpr std::uint32_t mostCopies = 8;
  void insertAt(std::uint32_t at, double v, double w, std::uint32_t copies = 1) {
    shiftUp(volumes_, at, v, copies);
    shiftUp(weights_, at, w, copies);
    size += copies;
    weightSum += copies * w;
    ++changes;
  }
  // Entry `at` gets the weight w and comes to be at `to`, those of the same volume from there on moving up.
  void lessenWeight(std::uint32_t at, std::uint32_t to, double w) {
    weightSum += w - weight(at);
    for (; at > to; --at) weights_[margin + at] = weights_[margin + at - 1];
    weights_[margin + to] = w;
  }
  // Takes out entries k and k + 1.
  void eraseTwo(std::uint32_t k) {
    weightSum -= weight(k) + weight(k + 1);
    shiftDown(volumes_, k, 2);
    shiftDown(weights_, k, 2);
    size -= 2;
    ++changes;
    if constexpr (!bare) particles.erase(particles.begin() + k, particles.begin() + k + 2);
  }
  // Takes out entries k and k + 1 and puts in one at `at`, k or more, of what remains.
  void replaceTwo(std::uint32_t k, std::uint32_t at, double v, double w) {
    weightSum += w - (weight(k) + weight(k + 1));
    replaceTwo(volumes_, k, at, v);
    replaceTwo(weights_, k, at, w);
    --size;
    ++changes;
  }
  void eraseAt(std::uint32_t at) {
    weightSum -= weight(at);
    shiftDown(volumes_, at);
    shiftDown(weights_, at);
    --size;
    ++changes;
    if constexpr (!bare) particles.erase(particles.begin() + at);
  }
  // The entries of `other` from `from` on are moved to the end of this one, with what `other` knows of the next chunk.
  void moveFrom(SortedChunk& other, std::uint32_t from) {
    const std::uint32_t count = other.size - from;
    std::copy_n(&other.volumes_[margin + from], count + 1, &volumes_[margin + size]);
    std::copy_n(&other.weights_[margin + from], count, &weights_[margin + size]);
    std::fill_n(&other.volumes_[margin + from], count + 1, infinity);
    std::fill_n(&other.weights_[margin + from], count, 0.0);
    if constexpr (!bare) {
      particles.insert(particles.end(), std::make_move_iterator(other.particles.begin() + from),
                       std::make_move_iterator(other.particles.end()));
      other.particles.erase(other.particles.begin() + from, other.particles.end());
    }
    size += count;
    other.size = from;
  }

  // The entry in which `x` falls, the weights being laid end to end; `size` where it lies beyond.
  [[nodiscard]] std::uint32_t atWeight(double x) const {
    std::uint32_t k = 0;
    for (; k < places; k += 8) {
      const double* w = weights() + k;
      const double sum = ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]));
      if (x < sum) break;
      x -= sum;
    }
    for (; k < size; ++k) {
      if (x < weight(k)) return k;
      x -= weight(k);
    }
    return size;
  }
  [[nodiscard]] double sumOfWeights() const {
    Lanes sums{};
    for (std::uint32_t k = 0; k < places; k += lanes) sums += load(&weights_[margin + k]);
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  }
  [[nodiscard]] double largestWeight() const {
    double largest = 0;
    for (std::uint32_t k = 0; k < size; ++k) largest = std::max(largest, weight(k));
    return largest;
  }

  // Difference between entry k and the one after it.
  template <bool relative>
  [[nodiscard]] double difference(std::uint32_t k) const {
    const double d = volume(k + 1) - volume(k);
    return relative ? d / volume(k) : d;
  }
  // Entry k and the next one as a candidate for the smallest difference.
  template <bool relative>
  void consider(std::uint32_t k) {
    const LeastOfChunks::Key key{difference<relative>(k), weight(k)};
    if (!(key < least)) return;
    least = key;
    leastAt = k;
    stale = false;
  }
  template <bool relative>
  void findLeast() {
    // Doubles of zero or more are ordered like the integers with their bits.
    constexpr std::int64_t none64 = std::numeric_limits<std::int64_t>::max();
    Bits differences[places / lanes];
    Bits smallest = Bits{} + none64;
    const auto end = static_cast<std::int64_t>(size);
    for (std::uint32_t k = 0; k < places; k += lanes) {
      const Lanes d = load(&volumes_[margin + k + 1]) - load(&volumes_[margin + k]);
      const Bits index = iota + static_cast<std::int64_t>(k);
      const Bits bits = index < end ? (Bits)d : Bits{} + none64;
      differences[k / lanes] = bits;
      smallest = bits < smallest ? bits : smallest;
    }
    std::int64_t least64 = leastOf(smallest);
    if (relative && least64 > 0) {  // no two volumes are equal
      smallest = Bits{} + none64;
      for (std::uint32_t k = 0; k < places; k += lanes) {
        const Lanes d = (Lanes)differences[k / lanes] / load(&volumes_[margin + k]);
        const Bits index = iota + static_cast<std::int64_t>(k);
        const Bits bits = index < end ? (Bits)d : Bits{} + none64;
        differences[k / lanes] = bits;
        smallest = bits < smallest ? bits : smallest;
      }
      least64 = leastOf(smallest);
    }
    Bits lightest = Bits{} + none64;
    for (std::uint32_t k = 0; k < places; k += lanes) {
      const Bits w = (Bits)load(&weights_[margin + k]);
      const Bits candidate = differences[k / lanes] == least64 ? w : Bits{} + none64;
      lightest = candidate < lightest ? candidate : lightest;
    }
    const std::int64_t lightest64 = leastOf(lightest);
    Bits first = Bits{} + static_cast<std::int64_t>(size);
    for (std::uint32_t k = 0; k < places; k += lanes) {
      const Bits w = (Bits)load(&weights_[margin + k]);
      const Bits index = iota + static_cast<std::int64_t>(k);
      const Bits candidate = (differences[k / lanes] == least64) & (w == lightest64) ? index : Bits{} + none64;
      first = candidate < first ? candidate : first;
    }
    stale = false;
    leastAt = static_cast<std::uint32_t>(leastOf(first));
    least = {};
    if (size > 0) least = {std::bit_cast<double>(least64), std::bit_cast<double>(lightest64)};
  }
  // After an entry came to `at`, or left from there; pairs of the entry are not considered yet.
  void leastMovedUp(std::uint32_t at, std::uint32_t by) {
    if (leastAt >= at) leastAt += by;
  }
  void leastMovedDown(std::uint32_t at) {
    if (leastAt == at || leastAt + 1 == at)
      stale = true;
    else if (leastAt > at)
      --leastAt;
  }

 private:
  static constexpr std::uint32_t lanes = 8, margin = lanes;  // the margins are read, not used
  typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));
  typedef double Unaligned __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));
  typedef std::int64_t Bits __attribute__((vector_size(lanes * sizeof(double))));
  using Column = std::array<double, places + 2 * margin>;

  static void fetchLines(const void* from, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; k += 64) __builtin_prefetch(static_cast<const char*>(from) + k, 1);
  }
  // By reference: vectors are not returned by value, whose registers not every processor has.
  static const Unaligned& load(const double* from) { return *reinterpret_cast<const Unaligned*>(from); }
  static void store(double* to, const Lanes& x) { *reinterpret_cast<Unaligned*>(to) = x; }
  static constexpr Bits iota{0, 1, 2, 3, 4, 5, 6, 7};
  static std::int64_t leastOf(const Bits& x) {
    std::int64_t least64 = x[0];
    for (std::uint32_t lane = 1; lane < lanes; ++lane) least64 = std::min<std::int64_t>(least64, x[lane]);
    return least64;
  }
  static void shiftUp(Column& column, std::uint32_t at, double value, std::uint32_t copies) {
    const auto end = static_cast<std::int64_t>(at + copies);
    for (std::uint32_t k = places; k > 0;) {
      k -= lanes;
      double* x = &column[margin + k];
      const Bits index = iota + static_cast<std::int64_t>(k);
      const Lanes moved = index >= end ? load(x - copies) : load(x);
      store(x, moved);
    }
    for (std::uint32_t k = 0; k < copies; ++k) column[margin + at + k] = value;
  }
  static void replaceTwo(Column& column, std::uint32_t k, std::uint32_t at, double value) {
    const auto first = static_cast<std::int64_t>(k), last = static_cast<std::int64_t>(at);
    for (std::uint32_t b = 0; b < places; b += lanes) {
      double* x = &column[margin + b];
      const Bits index = iota + static_cast<std::int64_t>(b);
      const Lanes same = load(x), one = load(x + 1), two = load(x + 2);
      Lanes moved = index < last ? two : one;
      moved = index < first ? same : moved;
      store(x, moved);
    }
    column[margin + at] = value;
  }
  static void shiftDown(Column& column, std::uint32_t at, std::uint32_t by = 1) {
    const auto here = static_cast<std::int64_t>(at);
    for (std::uint32_t k = 0; k < places; k += lanes) {
      double* x = &column[margin + k];
      const Bits index = iota + static_cast<std::int64_t>(k);
      const Lanes moved = index >= here ? load(x + by) : load(x);
      store(x, moved);
    }
  }

  alignas(64) Column volumes_;
  alignas(64) Column weights_;
};

}  // namespace lampblack::particles
