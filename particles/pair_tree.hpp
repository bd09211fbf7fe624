// Sums of the terms of PairKernel over an ensemble in a binary tree: changing a particle and drawing one in proportion
// to a term cost O(log capacity). Every inner node is recomputed from its two children, so that the sums depend on the
// leaves alone, not on their history: there is no drift, and a restored ensemble has the very same sums.
#pragma once

#include <cstddef>
#include <vector>

#include "particles/kernels.hpp"

namespace lampblack {

class PairTree {
 public:
  using Terms = PairKernel::Terms;

  explicit PairTree(std::size_t capacity) {
    while (leaves_ < capacity) leaves_ *= 2;
    nodes_.assign(2 * leaves_, Terms{0, 0, 0, 0});
  }

  [[nodiscard]] const Terms& leaf(std::size_t i) const { return nodes_[leaves_ + i]; }
  [[nodiscard]] const Terms& total() const { return nodes_[1]; }

  void set(std::size_t i, const Terms& terms) {
    std::size_t node = leaves_ + i;
    nodes_[node] = terms;
    for (node /= 2; node >= 1; node /= 2) join(node);
  }

  // Sets the first `count` leaves to `termsOf(i)`, the others to zero.
  template <class TermsOf>
  void assign(std::size_t count, TermsOf termsOf) {
    for (std::size_t i = 0; i < count; ++i) nodes_[leaves_ + i] = termsOf(i);
    for (std::size_t i = count; i < leaves_; ++i) nodes_[leaves_ + i] = Terms{0, 0, 0, 0};
    for (std::size_t node = leaves_ - 1; node >= 1; --node) join(node);
  }

  // The leaf at which the running sum of a term passes `fraction` (in (0, 1)) of its total.
  template <double Terms::*term>
  [[nodiscard]] std::size_t draw(double fraction) const {
    double rest = fraction * (nodes_[1].*term);
    std::size_t node = 1;
    while (node < leaves_) {
      node *= 2;
      const double left = nodes_[node].*term;
      // Round-off may leave `rest` at the end of the sum: never step into an empty branch.
      const bool right = rest >= left && nodes_[node + 1].*term > 0;
      rest -= right ? left : 0;
      node += right ? 1 : 0;
    }
    return node - leaves_;
  }

 private:
  void join(std::size_t node) {
    const Terms &x = nodes_[2 * node], &y = nodes_[2 * node + 1];
    nodes_[node] = {x.a + y.a, x.b + y.b, x.ab + y.ab, x.other + y.other};
  }

  std::size_t leaves_ = 1;
  std::vector<Terms> nodes_;
};

}  // namespace lampblack
