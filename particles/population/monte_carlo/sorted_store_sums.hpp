// SortedStore: bounds of chunks and the sums over them. Included by sorted_store.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"

namespace lampblack::particles {

// The sums are renewed when a chunk has more entries or weight than its bounds, or far less.
template <SortedRates Rates>
inline void SortedStore<Rates>::touched(Slot slot) {
  const Chunk& chunk = chunks_[slot];
  const bool count = chunk.size > chunk.countBound || chunk.size + 2 * countSlack + 1 < chunk.countBound;
  const bool weight = rank_ > 0 && (chunk.weightSum > chunk.weightBound || chunk.weightSum < 0.8 * chunk.weightBound);
  if (count || weight) publish(slot);
}

// Raises the bounds by one entry's; whether they rose.
template <SortedRates Rates>
bool SortedStore<Rates>::raise(Chunk& chunk, const Entry& entry) const {
  bool rose = false;
  const auto raiseTo = [&](double& bound, double value) {
    if (value > bound) {
      bound = value;
      rose = true;
    }
  };
  if (rank_ > 0) {
    const CollisionKernel::Terms terms = rates_.terms(entry);
    for (std::size_t r = 0; r < rank_; ++r) {
      raiseTo(chunk.terms.p[r], terms.p[r]);
      raiseTo(chunk.terms.q[r], terms.q[r]);
    }
  }
  for (std::size_t process = 0; process < singleProcesses; ++process) {
    if (singleQuantity_[process] == unused) continue;
    raiseTo(chunk.singles[process], singleBound(rates_, static_cast<SingleProcess>(process), entry));
  }
  return rose;
}

template <SortedRates Rates>
bool SortedStore<Rates>::raiseBounds(Chunk& chunk, const Entry& entry) {
  if (rates_.monotone()) {
    const double volume = rates_.volume(entry);
    if (volume >= chunk.lowest && volume <= chunk.highest) return false;
    chunk.lowest = std::min(chunk.lowest, volume);
    chunk.highest = std::max(chunk.highest, volume);
  }
  return raise(chunk, entry);
}

template <SortedRates Rates>
void SortedStore<Rates>::findBounds(Chunk& chunk) {
  chunk.terms = {};
  chunk.singles = {};
  chunk.changes = 0;
  chunk.lowest = Chunk::infinity;
  chunk.highest = -Chunk::infinity;
  if (chunk.size == 0) return;
  if (rates_.monotone()) {
    chunk.lowest = chunk.volume(0);
    chunk.highest = chunk.volume(chunk.size - 1);
    (void)raise(chunk, entryAt(chunk, 0));
    if (chunk.highest > chunk.lowest) (void)raise(chunk, entryAt(chunk, chunk.size - 1));
    return;
  }
  for (std::uint32_t k = 0; k < chunk.size; ++k) (void)raise(chunk, entryAt(chunk, k));
}

template <SortedRates Rates>
void SortedStore<Rates>::publish(Slot slot) {
  Chunk& chunk = chunks_[slot];
  const bool ends = rates_.monotone() && chunk.size > 0 &&
                    (chunk.volume(0) > chunk.lowest || chunk.volume(chunk.size - 1) < chunk.highest);
  if (ends || (!rates_.monotone() && chunk.changes > chunk.size) || chunk.size == 0) findBounds(chunk);
  chunk.countBound = chunk.size == 0 ? 0 : std::min(chunk.size + countSlack, Chunk::capacity);
  chunk.weightSum = chunk.sumOfWeights();
  chunk.weightBound = chunk.weightSum * weightSlack;
  std::array<double, 4 * CollisionKernel::largestRank + singleProcesses> values;
  const double count = chunk.countBound;
  for (std::size_t r = 0; r < rank_; ++r) {
    values[4 * r] = count * chunk.terms.p[r];
    values[4 * r + 1] = count * chunk.terms.q[r];
    values[4 * r + 2] = chunk.weightBound * chunk.terms.p[r];
    values[4 * r + 3] = chunk.weightBound * chunk.terms.q[r];
  }
  for (std::size_t process = 0; process < singleProcesses; ++process) {
    if (singleQuantity_[process] != unused) values[singleQuantity_[process]] = count * chunk.singles[process];
  }
  sums_.set(slot, {values.data(), quantities_});
  refreshPairRate();
}

// A slot that no chunk uses counts nothing.
template <SortedRates Rates>
void SortedStore<Rates>::forget(Slot slot) {
  const std::array<double, 4 * CollisionKernel::largestRank + singleProcesses> zero{};
  sums_.set(slot, {zero.data(), quantities_});
  least_.set(slot, {});
  if (rates_.keepsHeaviest()) heaviest_.set(slot, {});
  refreshPairRate();
}

template <SortedRates Rates>
inline void SortedStore<Rates>::refreshPairRate() {
  double sum = 0;
  for (std::size_t r = 0; r < rank_; ++r) {
    sum += sums_.total(4 * r + 2) * sums_.total(4 * r + 1);
    pairParts_[2 * r] = sum;
    sum += sums_.total(4 * r) * sums_.total(4 * r + 3);
    pairParts_[2 * r + 1] = sum;
  }
  pairRate_ = sum * rates_.weightFactor();
}

}  // namespace lampblack::particles
