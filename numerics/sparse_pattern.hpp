// Where the entries of a square sparse matrix are: compressed columns. Entry e of column j, columnStart[j] <= e <
// columnStart[j+1], is in row row[e]; rows rise within a column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

struct SparsePattern {
  std::size_t size = 0;                   // rows and columns
  std::vector<std::int32_t> columnStart;  // size + 1 values
  std::vector<std::int32_t> row;

  std::size_t numEntries() const { return row.size(); }
};

}  // namespace lampblack::numerics
