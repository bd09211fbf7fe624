// Work in cells that may fail in some of them: all ranks then raise the error of the same cell, with its place.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

// NumericsError of the failing cell with the smallest natural number, on any number of ranks the same.
class FirstFailingCell {
 public:
  explicit FirstFailingCell(const Mesh& mesh) : mesh_(mesh) {}

  // Does work(c).
  template <typename Work>
  void in(int c, const Work& work) {
    try {
      work(c);
    } catch (const NumericsError& error) {
      if (mesh_.naturalCell[c] >= number_) return;
      number_ = mesh_.naturalCell[c];
      first_ = std::make_exception_ptr(NumericsError(
          fmt::format("in the cell at {}: {}", placeText(mesh_.centre[c], mesh_.dimension), error.what())));
    }
  }
  // Collective, one reduction.
  void raise() { raiseFirst(mesh_.comm, first_, number_); }

 private:
  const Mesh& mesh_;
  std::exception_ptr first_;
  std::int64_t number_ = std::numeric_limits<std::int64_t>::max();
};

// Collective. Does `work` in each owned cell, one after the other as `order` says which is the i-th.
template <typename Work, typename Order = std::identity>
void inEachCell(const Mesh& m, const Work& work, const Order& order = {}) {
  FirstFailingCell first(m);
  for (int i = 0; i < m.owned; ++i) first.in(order(i), work);
  first.raise();
}

// Collective. Does `work`, which takes a span of cells, in so many owned cells at once; where it fails, in each of them
// by itself.
template <typename Work>
void inGroupsOfCells(const Mesh& m, int together, const Work& work) {
  FirstFailingCell first(m);
  std::vector<int> group;
  for (int begin = 0; begin < m.owned; begin += together) {
    group.resize(static_cast<std::size_t>(std::min(together, m.owned - begin)));
    std::iota(group.begin(), group.end(), begin);
    try {
      work(std::span<const int>(group));
    } catch (const NumericsError&) {
      for (const int c : group) first.in(c, [&](int cell) { work(std::span<const int>(&cell, 1)); });
    }
  }
  first.raise();
}

}  // namespace lampblack::flow
