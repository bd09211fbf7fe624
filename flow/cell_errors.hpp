// Work in cells that may fail in some of them: all ranks then raise the error of the same cell, with its place.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <limits>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

// Collective, one reduction. Does `work` in each owned cell, one after the other as `order` says which is the i-th.
// NumericsError of the failing cell with the smallest natural number, on any number of ranks the same.
template <typename Work, typename Order = std::identity>
void inEachCell(const Mesh& m, const Work& work, const Order& order = {}) {
  std::exception_ptr first;
  auto number = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < m.owned; ++i) {
    const int c = order(i);
    try {
      work(c);
    } catch (const NumericsError& error) {
      if (m.naturalCell[c] >= number) continue;
      number = m.naturalCell[c];
      first = std::make_exception_ptr(
          NumericsError(fmt::format("in the cell at {}: {}", placeText(m.centre[c], m.dimension), error.what())));
    }
  }
  raiseFirst(m.comm, first, number);
}

}  // namespace lampblack::flow
