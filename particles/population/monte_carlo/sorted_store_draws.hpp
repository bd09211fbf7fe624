// SortedStore: how entries are drawn and taken out. Included by sorted_store.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"

namespace lampblack::particles {

template <SortedRates Rates>
inline typename SortedStore<Rates>::Slot SortedStore<Rates>::locate(double volume, double weight) const {
  if (rank_ > 0) {  // what coagulated mostly goes back to where it came from
    for (const Slot slot : {recent_[0], recent_[1], expected_[0], expected_[1], expected_[2]}) {
      if (chunks_[slot].contains(volume, weight)) return slot;
    }
  }
  return directory_.find(volume, weight);
}

template <SortedRates Rates>
inline void SortedStore<Rates>::fetch(std::size_t which, double volume, double weight) {
  expected_[which] = directory_.find(volume, weight);
  chunks_[expected_[which]].fetch();
}

template <SortedRates Rates>
inline typename SortedStore<Rates>::Partners SortedStore<Rates>::locate(const PairDraw& draw) const {
  // Which product of sums; what is left of the random number finds the partner drawn by weight.
  double x = draw.x * pairParts_[2 * rank_ - 1];
  std::size_t part = 0;
  while (part + 1 < 2 * rank_ && x >= pairParts_[part]) ++part;
  if (part > 0) x -= pairParts_[part - 1];
  const std::size_t r = part / 2;
  const bool q = part % 2 == 1;
  const std::size_t weighted = 4 * r + (q ? 3 : 2), counted = 4 * r + (q ? 0 : 1);
  const double countedTotal = sums_.total(counted);
  return {r, q, weighted, counted, {0, x / countedTotal}, {0, draw.y * countedTotal}};
}

template <SortedRates Rates>
inline typename SortedStore<Rates>::PairDraw SortedStore<Rates>::nextDraw(RandomStream& random) {
  if (!ahead_.drawn) {
    ahead_.drawn = true;
    ahead_.next = drawTwo(random);
    ahead_.afterNext = drawTwo(random);
    ahead_.partners = locate(ahead_.afterNext);
  }
  const PairDraw now = ahead_.next;
  Partners& partners = ahead_.partners;
  chunks_[sums_.findInGroup(partners.heavy.at, partners.weighted, partners.heavy.distance)].fetchWeights();
  chunks_[sums_.findInGroup(partners.other.at, partners.counted, partners.other.distance)].fetchHead();
  ahead_.next = ahead_.afterNext;
  ahead_.afterNext = drawTwo(random);
  partners = locate(ahead_.afterNext);
  partners.heavy.at = sums_.findGroup(partners.weighted, partners.heavy.distance);
  partners.other.at = sums_.findGroup(partners.counted, partners.other.distance);
  return now;
}

template <SortedRates Rates>
template <class Left>
bool SortedStore<Rates>::drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left) {
  if (size_ < 2 || !(pairRate_ > 0)) return false;
  const Partners partners = locate(nextDraw(random));
  const std::size_t r = partners.term;
  const bool q = partners.q;
  double x = partners.heavy.distance, y = partners.other.distance;
  const auto a = static_cast<Slot>(sums_.find(partners.weighted, x));
  const auto b = static_cast<Slot>(sums_.find(partners.counted, y));
  const Chunk &heavy = chunks_[a], &other = chunks_[b];
  const std::uint32_t i = heavy.atWeight(x / (q ? heavy.terms.q[r] : heavy.terms.p[r]));
  if (i >= heavy.size) return false;
  // The fraction that is left after the index decides about acceptance.
  const double index = y / (q ? other.terms.p[r] : other.terms.q[r]);
  if (!(index < other.size)) return false;
  const auto j = static_cast<std::uint32_t>(index);
  if (a == b && i == j) return false;
  double majorant = 0;
  for (std::size_t s = 0; s < rank_; ++s) {
    majorant += heavy.terms.p[s] * other.terms.q[s] + heavy.terms.q[s] * other.terms.p[s];
  }
  first = entryAt(heavy, i);
  second = entryAt(other, j);
  if (!rates_.accepts(first, second, majorant, index - j)) return false;
  recent_ = {a, b};
  const std::array<double, 2> weights = left(first, second);
  // Among entries of one volume in one chunk, what one of them does would move the other.
  const bool apart = a != b || rates_.volume(first) != rates_.volume(second);
  const bool firstStays = apart && weights[0] > 0 && lessen({a, i}, weights[0]);
  const bool secondStays = apart && weights[1] > 0 && lessen({b, j}, weights[1]);
  if (!firstStays && weights[0] > 0) fetch(0, rates_.volume(first), weights[0]);
  if (!secondStays && weights[1] > 0) fetch(1, rates_.volume(second), weights[1]);
  if (firstStays && secondStays) {
    touched(a);
    if (b != a) touched(b);
    return true;
  }
  // The later one first: the place of the other does not change.
  const bool firstIsLater = a == b && i > j;
  if (!firstStays && firstIsLater) erase({a, i});
  if (!secondStays) erase({b, j});
  if (!firstStays && !firstIsLater) erase({a, i});
  joinIfSparse(a);
  if (b != a && chunks_[b].used) joinIfSparse(b);
  const auto putBack = [this](Entry entry, double weight) {
    entry.weight = weight;
    insert(entry);
  };
  if (!firstStays && weights[0] > 0) putBack(first, weights[0]);
  if (!secondStays && weights[1] > 0) putBack(second, weights[1]);
  return true;
}

template <SortedRates Rates>
bool SortedStore<Rates>::drawSingle(SingleProcess process, RandomStream& random, Entry& entry) {
  const std::size_t quantity = singleQuantity_[static_cast<std::size_t>(process)];
  if (quantity == unused || !(sums_.total(quantity) > 0)) return false;
  double y = random.uniform() * sums_.total(quantity);
  const auto slot = static_cast<Slot>(sums_.find(quantity, y));
  const Chunk& chunk = chunks_[slot];
  const double bound = chunk.singles[static_cast<std::size_t>(process)];
  const double index = y / bound;
  if (!(index < chunk.size)) return false;
  const auto at = static_cast<std::uint32_t>(index);
  entry = entryAt(chunk, at);
  if (!(rates_.single(process, entry) > (index - at) * bound)) return false;
  (void)take({slot, at});
  return true;
}

template <SortedRates Rates>
typename Rates::Entry SortedStore<Rates>::takeUniform(RandomStream& random) {
  while (true) {
    const std::uint64_t k = random.below(chunks_.size() * Chunk::places);
    const auto slot = static_cast<Slot>(k / Chunk::places);
    const auto at = static_cast<std::uint32_t>(k % Chunk::places);
    if (at < chunks_[slot].size) return take({slot, at});
  }
}

template <SortedRates Rates>
template <class MeanOf>
bool SortedStore<Rates>::mergeNearest(MeanOf&& meanOf) {
  if (size_ < 2) return false;
  Slot slot = static_cast<Slot>(least_.slot());
  while (chunks_[slot].stale) {
    findLeast(chunks_[slot]);
    setLeast(slot);
    slot = static_cast<Slot>(least_.slot());
  }
  Chunk& chunk = chunks_[slot];
  const std::uint32_t k = chunk.leastAt;
  const Entry lower = entryAt(chunk, k);
  if (k + 1 == chunk.size) {
    const Slot next = chunk.next;
    const Entry mean = meanOf(lower, entryAt(chunks_[next], 0));
    erase({next, 0});
    erase({slot, k});
    joinIfSparse(slot);
    if (chunks_[next].used) joinIfSparse(next);
    insert(mean);
    return true;
  }
  const Entry mean = meanOf(lower, entryAt(chunk, k + 1));
  const double volume = rates_.volume(mean), weight = rates_.weight(mean);
  // Almost always the mean belongs further inside the same chunk, k or later. Differences only grow there, so that what
  // is known of the smallest one stays a bound.
  const std::uint32_t below = static_cast<std::uint32_t>(chunk.below(k, volume, weight)) +
                              static_cast<std::uint32_t>(chunk.below(k + 1, volume, weight));
  const std::uint32_t at = chunk.position(volume, weight) - below;
  if (at < k || at == 0 || at + 2 >= chunk.size || rates_.keepsHeaviest()) {
    fetch(0, volume, weight);
    eraseTwo({slot, k});
    joinIfSparse(slot);
    insert(mean);
    return true;
  }
  chunk.replaceTwo(k, at, volume, weight);
  if constexpr (!Rates::bare) {
    const auto first = chunk.particles.begin() + k;
    *first = mean.particle;
    chunk.particles.erase(first + 1);
    std::rotate(first, first + 1, chunk.particles.begin() + at + 1);
  }
  chunk.stale = true;
  --size_;
  if (raiseBounds(chunk, mean))
    publish(slot);
  else
    joinIfSparse(slot);
  return true;
}

template <SortedRates Rates>
typename Rates::Entry SortedStore<Rates>::takeNearest(const Entry& like) {
  const double volume = rates_.volume(like), weight = rates_.weight(like);
  const Slot slot = locate(volume, weight);
  const Chunk& chunk = chunks_[slot];
  const std::uint32_t at = chunk.position(volume, weight);
  Place lower{slot, at - 1}, upper{slot, at};
  if (at == 0) lower = {chunk.previous, chunk.previous == none ? 0 : chunks_[chunk.previous].size - 1};
  if (at == chunk.size) upper = {chunk.next, 0};
  if (lower.slot == none) return take(upper);
  if (upper.slot == none) return take(lower);
  const double below = volume - chunks_[lower.slot].volume(lower.at);
  const double above = chunks_[upper.slot].volume(upper.at) - volume;
  return take(below < above ? lower : upper);
}

template <SortedRates Rates>
typename Rates::Entry SortedStore<Rates>::takeHeaviest() {
  Slot slot = static_cast<Slot>(heaviest_.slot());
  while (!chunks_[slot].heaviestExact) {
    Chunk& chunk = chunks_[slot];
    chunk.heaviest = chunk.largestWeight();
    chunk.heaviestExact = true;
    setHeaviest(slot);
    slot = static_cast<Slot>(heaviest_.slot());
  }
  const Chunk& chunk = chunks_[slot];
  std::uint32_t at = 0;
  while (chunk.weight(at) != chunk.heaviest) ++at;
  return take({slot, at});
}

}  // namespace lampblack::particles
