// The small particles of the hybrid method: how many there are of each size of 1 to `threshold` units. Every particle
// of a size is alike, so that the bounds by which one is drawn are exact; their sums are in a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/store.hpp"
#include "particles/population/monte_carlo/sum_tree.hpp"

namespace lampblack::particles {

template <EntryRates Rates>
class HybridNumbers {
 public:
  using Entry = typename Rates::Entry;
  // Bounds: of one (component 0), p_r, q_r and the single processes, as a ClassStore has them.
  using Bounds = std::vector<SumTree::Lanes>;

  template <class EntryOf>
  HybridNumbers(std::size_t threshold, std::size_t components, EntryOf&& entryOf) : sums_(components) {
    sums_.reset(threshold);
    numbers_.assign(threshold, 0);
    for (std::size_t size = 1; size <= threshold; ++size) entries_.push_back(entryOf(size));
    bounds_.assign(threshold, Bounds(sums_.blocks()));
  }
  // boundOf(entry, component); to be called before anything is added, and when the bounds have changed.
  template <class BoundOf>
  void setBounds(BoundOf&& boundOf, std::size_t components) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      for (std::size_t c = 0; c < components; ++c) {
        bounds_[k][c / SumTree::lanes].x[c % SumTree::lanes] = boundOf(entries_[k], c);
      }
      set(k + 1, numbers_[k]);
    }
  }

  [[nodiscard]] std::size_t threshold() const { return numbers_.size(); }
  [[nodiscard]] std::uint64_t all() const { return all_; }
  [[nodiscard]] std::uint64_t number(std::size_t size) const { return numbers_[size - 1]; }
  [[nodiscard]] const Entry& entry(std::size_t size) const { return entries_[size - 1]; }
  [[nodiscard]] double bound(std::size_t size, std::size_t component) const {
    return bounds_[size - 1][component / SumTree::lanes].x[component % SumTree::lanes];
  }
  [[nodiscard]] double total(std::size_t component) const { return sums_.total(component); }
  [[nodiscard]] std::size_t bytes() const {
    return sums_.bytes() +
           numbers_.capacity() * (sizeof(numbers_[0]) + sizeof(Entry) + sums_.blocks() * sizeof(SumTree::Lanes));
  }

  void add(std::size_t size) { set(size, numbers_[size - 1] + 1); }
  void remove(std::size_t size) { set(size, numbers_[size - 1] - 1); }
  void doubleAll() {
    for (std::size_t size = 1; size <= threshold(); ++size) set(size, 2 * numbers_[size - 1]);
  }

  // The size in which x in [0, total(component)) falls, x then being the distance from its start; zero where rounding
  // led to a size nobody has.
  [[nodiscard]] std::size_t find(std::size_t component, double& x) const {
    const std::size_t leaf = sums_.find(component, x);
    return leaf < numbers_.size() && numbers_[leaf] > 0 ? leaf + 1 : 0;
  }

 private:
  void set(std::size_t size, std::uint64_t number) {
    all_ += number - numbers_[size - 1];
    numbers_[size - 1] = number;
    sums_.set(size - 1, static_cast<double>(number), bounds_[size - 1].data());
  }

  SumTree sums_;
  std::uint64_t all_ = 0;
  std::vector<std::uint64_t> numbers_;
  std::vector<Entry> entries_;
  std::vector<Bounds> bounds_;
};

}  // namespace lampblack::particles
