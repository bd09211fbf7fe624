// Puts weighted entries of a flat array in order of volume, then weight, by keys that are small beside the entries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

template <class Rates>
class VolumeOrder {
 public:
  using Entry = typename Rates::Entry;

  // Entries with the same volume and weight stay as they are to each other.
  void sort(std::vector<Entry>& entries, const Rates& rates) {
    keys_.clear();
    for (const Entry& entry : entries)
      keys_.push_back({rates.volume(entry), rates.weight(entry), static_cast<std::uint32_t>(keys_.size())});
    if (std::is_sorted(keys_.begin(), keys_.end())) return;
    std::sort(keys_.begin(), keys_.end());
    sorted_.clear();
    for (const Key& key : keys_) sorted_.push_back(entries[key.at]);
    entries.swap(sorted_);
  }
  // Of the k-th entry after sort().
  [[nodiscard]] double volume(std::size_t k) const { return keys_[k].volume; }

 private:
  struct Key {
    double volume, weight;
    std::uint32_t at;
    bool operator<(const Key& other) const {
      if (volume != other.volume) return volume < other.volume;
      if (weight != other.weight) return weight < other.weight;
      return at < other.at;
    }
  };
  // Room that is kept.
  std::vector<Key> keys_;
  std::vector<Entry> sorted_;
};

}  // namespace lampblack::particles
