// Merges the nearest neighbours in volume of a flat array of weighted entries, many at once, in O(N log N): as if the
// two with the smallest difference were merged into their mean one after the other, of equal differences the pair whose
// lower particle has the smallest weight (Wang 2025, section 5.2.6).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/volume_order.hpp"

namespace lampblack::particles {

template <class Rates>
class NeighbourMerger {
 public:
  using Entry = typename Rates::Entry;

  // Until `count` are left, at least one; the entries are in order of volume, then weight, afterwards. meanOf(lower,
  // upper) has to lie between the two. Returns how many merged; changes nothing where none do.
  template <class MeanOf>
  std::size_t mergeDownTo(std::size_t count, std::vector<Entry>& entries, const Rates& rates, MeanOf&& meanOf);

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  // An entry in the chain of neighbours. A pair in the heap is out of date where one of the two has changed since.
  struct Link {
    double volume;
    std::uint32_t previous, next, version;
    bool isGone;
  };
  struct Pair {
    double difference, weight;
    std::uint32_t lower, upper, lowerVersion, upperVersion;
    bool operator<(const Pair& other) const {  // the heap has the largest on top
      if (difference != other.difference) return difference > other.difference;
      if (weight != other.weight) return weight > other.weight;
      return lower > other.lower;
    }
  };
  // Room that is kept.
  VolumeOrder<Rates> order_;
  std::vector<Link> links_;
  std::vector<Pair> heap_;
};

template <class Rates>
template <class MeanOf>
std::size_t NeighbourMerger<Rates>::mergeDownTo(std::size_t count, std::vector<Entry>& entries, const Rates& rates,
                                                MeanOf&& meanOf) {
  count = std::max<std::size_t>(count, 1);
  if (entries.size() <= count) return 0;
  order_.sort(entries, rates);
  const auto n = static_cast<std::uint32_t>(entries.size());
  links_.resize(n);
  for (std::uint32_t k = 0; k < n; ++k)
    links_[k] = {order_.volume(k), k == 0 ? none : k - 1, k + 1 == n ? none : k + 1, 0, false};
  const auto pairOf = [&](std::uint32_t lower, std::uint32_t upper) {
    const Link &a = links_[lower], &b = links_[upper];
    const double d = b.volume - a.volume;
    return Pair{rates.relativeDifference() ? d / a.volume : d,
                rates.weight(entries[lower]),
                lower,
                upper,
                a.version,
                b.version};
  };
  const auto consider = [&](std::uint32_t lower, std::uint32_t upper) {
    if (lower == none || upper == none) return;
    heap_.push_back(pairOf(lower, upper));
    std::push_heap(heap_.begin(), heap_.end());
  };
  heap_.clear();
  for (std::uint32_t k = 0; k + 1 < n; ++k) heap_.push_back(pairOf(k, k + 1));
  std::make_heap(heap_.begin(), heap_.end());
  std::size_t merged = 0;
  while (n - merged > count) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Pair pair = heap_.back();
    heap_.pop_back();
    Link &lower = links_[pair.lower], &upper = links_[pair.upper];
    if (lower.isGone || upper.isGone || lower.version != pair.lowerVersion || upper.version != pair.upperVersion)
      continue;
    // The mean lies between the two, and so in their place among the others.
    entries[pair.lower] = meanOf(entries[pair.lower], entries[pair.upper]);
    lower.volume = rates.volume(entries[pair.lower]);
    ++lower.version;
    upper.isGone = true;
    lower.next = upper.next;
    if (lower.next != none) links_[lower.next].previous = pair.lower;
    consider(lower.previous, pair.lower);
    consider(pair.lower, lower.next);
    ++merged;
  }
  std::size_t kept = 0;
  for (std::uint32_t k = 0; k < n; ++k)
    if (!links_[k].isGone) {
      if (kept != k) entries[kept] = entries[k];
      ++kept;
    }
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(kept), entries.end());
  return merged;
}

}  // namespace lampblack::particles
