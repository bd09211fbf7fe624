// Sums and extremes over the chunks of a sorted store, as trees with eight children a node: one cache line each, few
// levels. Nodes are always computed afresh from their children, so that nothing drifts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

namespace chunk_tree {
inline constexpr std::size_t fan = 8;

// Number of groups of eight in each level for this many slots, from the slots up to a level of one group.
inline std::vector<std::size_t> groups(std::size_t slots) {
  std::vector<std::size_t> result;
  do {
    slots = (slots + fan - 1) / fan;
    result.push_back(std::max<std::size_t>(slots, 1));
  } while (slots > 1);
  return result;
}
}  // namespace chunk_tree

// Sums of several quantities, all at least zero.
class SumsOfChunks {
 public:
  explicit SumsOfChunks(std::size_t quantities) : quantities_(quantities), totals_(quantities) { reset(1); }

  void reset(std::size_t slots) {
    levels_.clear();
    for (const std::size_t count : chunk_tree::groups(slots)) {
      levels_.emplace_back(count * quantities_ * fan, 0.0);
    }
    std::fill(totals_.begin(), totals_.end(), 0.0);
  }
  // At least this many slots; what is there stays.
  void reserve(std::size_t slots) {
    if (quantities_ == 0 || slots * quantities_ <= levels_[0].size()) return;
    const std::vector<double> before = levels_[0];
    reset(std::max(slots, 2 * before.size() / quantities_));
    std::copy(before.begin(), before.end(), levels_[0].begin());
    for (std::size_t group = 0; group * quantities_ * fan < before.size(); ++group) raise(group);
  }

  void set(std::size_t slot, std::span<const double> values) {
    if (quantities_ == 0) return;
    double* leaf = &levels_[0][slot / fan * quantities_ * fan + slot % fan];
    for (std::size_t q = 0; q < quantities_; ++q) leaf[q * fan] = values[q];
    raise(slot / fan);
  }
  [[nodiscard]] double total(std::size_t quantity) const { return totals_[quantity]; }

  // The slot in which `x` falls, 0 <= x < total, all slots being laid end to end; x becomes the distance from its
  // start. Rounding may leave x at or slightly above the slot's value.
  [[nodiscard]] std::size_t find(std::size_t quantity, double& x) const {
    return childOf(0, groupOf(quantity, x), quantity, x);
  }
  // The same in two steps that may lie far apart: the group of slots, fetched into the cache, and the slot in it.
  [[nodiscard]] std::size_t findGroup(std::size_t quantity, double& x) const {
    const std::size_t group = groupOf(quantity, x);
    __builtin_prefetch(&levels_[0][(group * quantities_ + quantity) * fan]);
    return group;
  }
  [[nodiscard]] std::size_t findInGroup(std::size_t group, std::size_t quantity, double& x) const {
    return childOf(0, group, quantity, x);
  }

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& level : levels_) sum += level.capacity() * sizeof(double);
    return sum;
  }

 private:
  static constexpr std::size_t fan = chunk_tree::fan;

  [[nodiscard]] std::size_t groupOf(std::size_t quantity, double& x) const {
    std::size_t group = 0;
    for (std::size_t level = levels_.size(); level-- > 1;) group = childOf(level, group, quantity, x);
    return group;
  }
  // In which child of a group x falls; x becomes the distance from its start.
  [[nodiscard]] std::size_t childOf(std::size_t level, std::size_t group, std::size_t quantity, double& x) const {
    const double* sum = &levels_[level][(group * quantities_ + quantity) * fan];
    // All running sums, instead of steps of which nobody knows how many there will be.
    std::size_t child = 0;
    double running = 0, start = 0;
    for (std::size_t c = 0; c + 1 < fan; ++c) {
      running += sum[c];
      const bool beyond = x >= running;
      child += beyond;
      start = beyond ? running : start;
    }
    x -= start;
    if (!(sum[child] > 0)) [[unlikely]] {
      while (child > 0 && !(sum[child] > 0)) --child;
      x = sum[child];
    }
    return group * fan + child;
  }

  void raise(std::size_t group) {
    for (std::size_t level = 0;; ++level) {
      const double* children = &levels_[level][group * quantities_ * fan];
      const bool top = level + 1 == levels_.size();
      double* parent = top ? totals_.data() : &levels_[level + 1][group / fan * quantities_ * fan + group % fan];
      const std::size_t stride = top ? 1 : fan;
      for (std::size_t q = 0; q < quantities_; ++q) {
        const double* c = children + q * fan;
        parent[q * stride] = ((c[0] + c[4]) + (c[2] + c[6])) + ((c[1] + c[5]) + (c[3] + c[7]));
      }
      if (top) return;
      group /= fan;
    }
  }

  std::size_t quantities_;
  std::vector<std::vector<double>> levels_;  // [level][(group * quantities + quantity) * 8 + child]
  std::vector<double> totals_;
};

// The slot with the smallest key, compared by its first, then its second number. Slots that were never set have
// infinite keys.
class LeastOfChunks {
 public:
  struct Key {
    double first = std::numeric_limits<double>::infinity(), second = std::numeric_limits<double>::infinity();
    bool operator<(const Key& other) const {
      return first < other.first || (first == other.first && second < other.second);
    }
    bool operator==(const Key&) const = default;
  };

  LeastOfChunks() { reset(1); }

  void reset(std::size_t slots) {
    levels_.clear();
    levels_.emplace_back(std::max<std::size_t>((slots + fan - 1) / fan * fan, fan));
    for (const std::size_t count : chunk_tree::groups(slots)) {
      levels_.emplace_back(count == 1 ? 1 : (count + fan - 1) / fan * fan);
    }
  }
  void reserve(std::size_t slots) {
    if (slots <= levels_[0].size()) return;
    const std::vector<Node> before = levels_[0];
    reset(std::max(slots, 2 * before.size()));
    for (std::size_t slot = 0; slot < before.size(); ++slot) set(slot, before[slot].key);
  }

  void set(std::size_t slot, const Key& key) {
    levels_[0][slot] = {key, static_cast<std::uint32_t>(slot)};
    std::size_t node = slot;
    for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
      node /= fan;
      Node& parent = levels_[level + 1][node];
      const Node* children = &levels_[level][node * fan];
      if (parent.slot != slot) {
        if (!(key < parent.key)) return;
        parent = {key, static_cast<std::uint32_t>(slot)};
        continue;
      }
      Node best = children[0];
      for (std::size_t c = 1; c < fan; ++c) best = children[c].key < best.key ? children[c] : best;
      parent = best;
    }
  }
  [[nodiscard]] std::size_t slot() const { return levels_.back()[0].slot; }
  [[nodiscard]] const Key& key() const { return levels_.back()[0].key; }
  [[nodiscard]] const Key& key(std::size_t slot) const { return levels_[0][slot].key; }

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& level : levels_) sum += level.capacity() * sizeof(Node);
    return sum;
  }

 private:
  static constexpr std::size_t fan = chunk_tree::fan;
  struct Node {
    Key key;
    std::uint32_t slot = 0;
  };
  std::vector<std::vector<Node>> levels_;
};

}  // namespace lampblack::particles
