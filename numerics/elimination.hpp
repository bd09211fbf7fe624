// The order in which the unknowns of a sparse matrix are eliminated, and where its factors differ from zero: found once
// for a pattern that is then factorised millions of times.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

struct MatrixEntry {
  std::size_t row = 0, column = 0;
};

struct Elimination {
  // Of a matrix of n unknowns whose entries may differ from zero at `entries` (in any order, repeated or not) and on
  // the diagonal. The order keeps the fill low (Markowitz 1957, pivots on the diagonal); the last `border` unknowns,
  // which may have full rows and columns, come at the end and in their own order.
  Elimination(std::size_t n, std::span<const MatrixEntry> entries, std::size_t border);

  using Pattern = std::vector<std::vector<char>>;  // [row][column] of unknowns

  std::size_t inner;                        // unknowns outside the border
  std::vector<std::size_t> unknown, place;  // by order of elimination, and the reverse
  Pattern matrix, factors;                  // factors: with the fill
};

}  // namespace lampblack::numerics
