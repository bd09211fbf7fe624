// Sums over a set of leaves that change one at a time, several sums at once: a binary tree whose inner nodes hold the
// sums of their two children. A change costs one addition for each level and sum; nothing is ever subtracted, so that
// the sums do not drift: they always equal those of a tree built afresh.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

class SumTree {
 public:
  static constexpr std::size_t lanes = 4, largestComponents = 12;
  // One vector register, which compilers do not find by themselves here.
  struct Lanes {
    using Register [[gnu::vector_size(lanes * sizeof(double))]] = double;
    Register x{};
  };

  // At most largestComponents.
  explicit SumTree(std::size_t components) : blocks_((components + lanes - 1) / lanes), nodes_(2 * blocks_) {}

  [[nodiscard]] std::size_t blocks() const { return blocks_; }  // of Lanes for each leaf
  [[nodiscard]] std::size_t leaves() const { return leaves_; }
  [[nodiscard]] std::size_t bytes() const { return nodes_.capacity() * sizeof(Lanes); }
  [[nodiscard]] double total(std::size_t component) const {
    return nodes_[blocks_ + component / lanes].x[component % lanes];
  }

  // Room for this many leaves, all zero.
  void reset(std::size_t leaves) {
    leaves_ = 1;
    while (leaves_ < leaves) leaves_ *= 2;
    nodes_.assign(2 * leaves_ * blocks_, Lanes{});
  }

  // Sets a leaf to factor * values[...], `blocks()` of them.
  [[gnu::always_inline]] void set(std::size_t leaf, double factor, const Lanes* values) {
    if (blocks_ == 1)
      setBlocks<1>(leaf, factor, values);
    else if (blocks_ == 2)
      setBlocks<2>(leaf, factor, values);
    else
      setBlocks<3>(leaf, factor, values);
  }

  // The leaf in which `x` falls, 0 <= x < total(component), the leaves being laid end to end; x becomes the distance
  // from the start of the leaf.
  [[nodiscard, gnu::always_inline]] std::size_t find(std::size_t component, double& x) const {
    const std::size_t stride = blocks_ * lanes;
    const double* values = reinterpret_cast<const double*>(nodes_.data()) + component;
    std::size_t node = 1;
    while (node < leaves_) {
      node *= 2;
      const double left = values[node * stride];
      const bool right = x >= left;
      x -= right ? left : 0.0;
      node += right;
    }
    return node - leaves_;
  }

 private:
  template <std::size_t Blocks>
  [[gnu::always_inline]] void setBlocks(std::size_t leaf, double factor, const Lanes* values) {
    Lanes sum[Blocks];
    std::size_t node = leaves_ + leaf;
    Lanes* nodes = nodes_.data();
    for (std::size_t b = 0; b < Blocks; ++b) {
      sum[b].x = factor * values[b].x;
      nodes[node * Blocks + b] = sum[b];
    }
    while (node > 1) {
      for (std::size_t b = 0; b < Blocks; ++b) sum[b].x += nodes[(node ^ 1) * Blocks + b].x;
      node /= 2;
      for (std::size_t b = 0; b < Blocks; ++b) nodes[node * Blocks + b] = sum[b];
    }
  }

  std::size_t blocks_, leaves_ = 1;
  std::vector<Lanes>
      nodes_;  // of leaves_ - 1 inner nodes from the second on, the first being the root, then the leaves
};

}  // namespace lampblack::particles
