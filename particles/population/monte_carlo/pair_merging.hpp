// Keeps the number of numerical particles of the method that draws pairs: merges neighbours in size where there are too
// many, halves the heaviest where particles were lost.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/pair_population.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class PairMerging {
 public:
  // Merges disjoint pairs of neighbours in volume into their means, until `count` (at least one) are left: those first
  // that lose least of their own second moment of the logarithm of volume, r (1 - r) ln(v/v')^2 with r and 1 - r their
  // shares of their number. No pair that holds more than `most` (1/m3), unless there are too few others. Number and
  // every extensive quantity stay. Returns how many merged. O(N).
  std::size_t mergeDownTo(std::size_t count, double most, PairPopulation<Type>& population);
  // Where there are more than `capacity`: down to mergedTo of it, none above `gathered` times their mean. Returns how
  // many merged.
  std::size_t makeRoom(std::size_t capacity, PairPopulation<Type>& population);
  // Part of what there is room for that merging leaves: its cost is shared by as many particles as are new since.
  static constexpr double mergedTo = 0.9375;
  // Weight of a numerical particle over the mean, up to which particles are merged.
  static constexpr double gathered = 3;
  // Halves the heaviest until there are `count`. Returns how many were made.
  std::size_t halveUpTo(std::size_t count, PairPopulation<Type>& population);

 private:
  using Row = typename PairPopulation<Type>::Row;
  // Positive floats are in the order of their bits, which rise by 2^23 for a factor of two: nearly a logarithm.
  static std::uint32_t logarithm(const Row& row) { return std::bit_cast<std::uint32_t>(row.volume); }
  void sort(const PairPopulation<Type>& population);
  // The loss up to which `count` pairs lose least, and how many of that very loss are among them.
  struct Loss {
    std::uint32_t most;
    std::size_t equal;
  };
  [[nodiscard]] Loss lossOf(std::size_t count) const;
  void mergeOnce(std::size_t excess, double most, PairPopulation<Type>& population);

  // Room that is kept.
  std::vector<std::uint32_t> order_, other_;
  struct Pair {
    std::uint32_t loss;   // the bits of a float from zero on, which are in its order
    std::uint32_t lower;  // place in the order
  };
  std::vector<Pair> pairs_;
  std::vector<char> gone_;
};

// By the upper 24 bits of the logarithm (three parts in 1e5), eight at a time.
template <ParticleType Type>
void PairMerging<Type>::sort(const PairPopulation<Type>& population) {
  const std::size_t n = population.size();
  order_.resize(n);
  other_.resize(n);
  for (std::size_t k = 0; k < n; ++k) order_[k] = static_cast<std::uint32_t>(k);
  for (const unsigned shift : {8U, 16U, 24U}) {
    std::array<std::uint32_t, 257> first{};
    for (std::size_t k = 0; k < n; ++k) ++first[((logarithm(population.row(k)) >> shift) & 255U) + 1];
    for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
    for (const std::uint32_t k : order_) other_[first[(logarithm(population.row(k)) >> shift) & 255U]++] = k;
    order_.swap(other_);
  }
}

// Eight bits after the other from the highest on: in each the one up to which the count is reached.
template <ParticleType Type>
auto PairMerging<Type>::lossOf(std::size_t count) const -> Loss {
  std::uint32_t found = 0, known = 0;
  for (unsigned shift = 32; shift > 0;) {
    shift -= 8;
    std::array<std::uint32_t, 256> counts{};
    for (const Pair& pair : pairs_)
      counts[(pair.loss >> shift) & 255U] += static_cast<std::uint32_t>((pair.loss & known) == found);
    std::uint32_t digit = 0;
    while (digit < 255 && count > counts[digit]) count -= counts[digit++];
    found |= digit << shift;
    known |= 255U << shift;
  }
  return {found, count};
}

template <ParticleType Type>
void PairMerging<Type>::mergeOnce(std::size_t excess, double most, PairPopulation<Type>& population) {
  const std::size_t n = order_.size();
  pairs_.clear();
  while (pairs_.empty()) {
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const Row &a = population.row(order_[k]), &b = population.row(order_[k + 1]);
      const double weight = a.weight + b.weight;
      if (weight > most) continue;
      const double share = a.weight / weight;
      const auto ratio = static_cast<float>(logarithm(b) - logarithm(a));
      const float loss = static_cast<float>(share * (1 - share)) * ratio * ratio;
      pairs_.push_back({std::bit_cast<std::uint32_t>(loss), static_cast<std::uint32_t>(k)});
    }
    most *= 2;
  }
  const std::size_t wanted = std::min(excess, pairs_.size());
  auto [least, equal] = lossOf(wanted);
  gone_.assign(n, 0);
  std::size_t next = 0;
  const Type& type = population.type();
  for (const Pair& pair : pairs_) {
    if (pair.loss > least || (pair.loss == least && equal == 0)) continue;
    if (pair.loss == least) --equal;
    if (pair.lower < next) continue;
    next = pair.lower + 2;
    const std::uint32_t i = order_[pair.lower], j = order_[pair.lower + 1];
    const double wi = population.weight(i), wj = population.weight(j);
    if (population.volume(i) == population.volume(j) && !moreThanVolume<Type>())  // to the last bit
      population.setWeight(i, wi + wj);
    else
      population.set(i, type.mean(population.particle(i), wi, population.particle(j), wj), wi + wj);
    gone_[j] = 1;
  }
  // The order of those that are left, which is theirs still: a mean lies between the two.
  other_.assign(n, 0);
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < n; ++k) other_[k] = gone_[k] ? kept : kept++;
  std::size_t place = 0;
  for (const std::uint32_t k : order_)
    if (!gone_[k]) order_[place++] = other_[k];
  order_.resize(place);
  population.remove([this](std::size_t k) { return gone_[k] != 0; });
}

template <ParticleType Type>
std::size_t PairMerging<Type>::mergeDownTo(std::size_t count, double most, PairPopulation<Type>& population) {
  const std::size_t before = population.size();
  if (before <= count) return 0;
  sort(population);
  while (population.size() > count) {
    const std::size_t size = population.size();
    mergeOnce(size - count, most, population);
    if (2 * (size - population.size()) < size - count) most *= 2;
  }
  return before - population.size();
}

template <ParticleType Type>
std::size_t PairMerging<Type>::makeRoom(std::size_t capacity, PairPopulation<Type>& population) {
  if (population.size() <= capacity) return 0;
  const auto room = static_cast<double>(capacity);
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(mergedTo * room));
  return mergeDownTo(count, gathered * population.number() / room, population);
}

template <ParticleType Type>
std::size_t PairMerging<Type>::halveUpTo(std::size_t count, PairPopulation<Type>& population) {
  std::size_t made = 0;
  while (population.size() > 0 && population.size() < count) {
    const std::size_t size = population.size(), wanted = std::min(count - size, size);
    order_.resize(size);
    for (std::size_t k = 0; k < size; ++k) order_[k] = static_cast<std::uint32_t>(k);
    const auto heavier = [&](std::uint32_t x, std::uint32_t y) {
      return population.weight(x) > population.weight(y) || (population.weight(x) == population.weight(y) && x < y);
    };
    if (wanted < size)
      std::nth_element(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(wanted), order_.end(), heavier);
    for (std::size_t k = 0; k < wanted; ++k) {
      const double half = 0.5 * population.weight(order_[k]);
      const auto particle = population.particle(order_[k]);
      population.setWeight(order_[k], half);
      population.add(particle, half);
    }
    made += wanted;
  }
  return made;
}

}  // namespace lampblack::particles
