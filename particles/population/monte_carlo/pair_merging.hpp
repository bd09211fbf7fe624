// Keeps the number of numerical particles of the method that draws pairs: merges neighbours in size where there are too
// many, halves the heaviest where particles were lost.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
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
  struct Keyed {
    std::uint32_t key, place;
  };
  std::vector<Keyed> keyed_, otherKeyed_;
  std::vector<double> weights_;            // in the order
  std::vector<std::uint32_t> logarithms_;  // likewise
  // Of each with the next one: the bits of a float from zero on, which are in its order.
  static constexpr std::uint32_t tooHeavy = ~0U;
  std::vector<std::uint32_t> losses_;
  std::vector<char> gone_;
};

// By the upper 24 bits of the logarithm (three parts in 1e5), seven of its distance from the least at a time.
template <ParticleType Type>
void PairMerging<Type>::sort(const PairPopulation<Type>& population) {
  constexpr unsigned digit = 7;
  constexpr std::uint32_t digits = 1U << digit;
  const std::size_t n = population.size();
  keyed_.resize(n);
  otherKeyed_.resize(n);
  std::uint32_t least = ~0U, most = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t key = logarithm(population.row(k)) >> 8U;
    keyed_[k] = {key, static_cast<std::uint32_t>(k)};
    least = std::min(least, key);
    most = std::max(most, key);
  }
  for (unsigned shift = 0; (most - least) >> shift > 0; shift += digit) {
    std::array<std::uint32_t, digits> first{};
    for (const Keyed& one : keyed_) ++first[((one.key - least) >> shift) % digits];
    std::uint32_t begin = 0;
    for (std::uint32_t& count : first) begin += std::exchange(count, begin);
    for (const Keyed& one : keyed_) otherKeyed_[first[((one.key - least) >> shift) % digits]++] = one;
    keyed_.swap(otherKeyed_);
  }
  order_.resize(n);
  for (std::size_t k = 0; k < n; ++k) order_[k] = keyed_[k].place;
}

// Bit after bit from the highest on: the largest below which there are fewer than `count`. Each look at all of them is
// compiled to vector instructions.
template <ParticleType Type>
auto PairMerging<Type>::lossOf(std::size_t count) const -> Loss {
  const auto below = [this](std::uint32_t loss) {
    std::uint32_t sum = 0;
    for (const std::uint32_t one : losses_) sum += one < loss ? 1U : 0U;
    return static_cast<std::size_t>(sum);
  };
  std::uint32_t found = 0;
  std::size_t less = 0;
  for (std::uint32_t bit = 1U << 31U; bit > 0; bit >>= 1U) {
    const std::size_t there = below(found | bit);
    if (there >= count) continue;
    found |= bit;
    less = there;
  }
  return {found, count - less};
}

template <ParticleType Type>
void PairMerging<Type>::mergeOnce(std::size_t excess, double most, PairPopulation<Type>& population) {
  const std::size_t n = order_.size();
  weights_.resize(n);
  logarithms_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    weights_[k] = population.row(order_[k]).weight;
    logarithms_[k] = logarithm(population.row(order_[k]));
  }
  losses_.resize(n - 1);
  std::size_t allowed = 0;
  for (; allowed == 0; most *= 2)
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double weight = weights_[k] + weights_[k + 1], share = weights_[k] / weight;
      // Of those that are nearly alike either may come first.
      const auto ratio = static_cast<float>(static_cast<std::int32_t>(logarithms_[k + 1] - logarithms_[k]));
      const float loss = static_cast<float>(share * (1 - share)) * ratio * ratio;
      losses_[k] = weight > most ? tooHeavy : std::bit_cast<std::uint32_t>(loss);
      allowed += weight > most ? 0U : 1U;
    }
  auto [least, equal] = lossOf(std::min(excess, allowed));
  gone_.assign(n, 0);
  std::size_t next = 0;
  const Type& type = population.type();
  for (std::size_t lower = 0; lower + 1 < n; ++lower) {
    const std::uint32_t loss = losses_[lower];
    if (loss > least || (loss == least && equal == 0)) continue;
    if (loss == least) --equal;
    if (lower < next) continue;
    next = lower + 2;
    const std::uint32_t i = order_[lower], j = order_[lower + 1];
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
