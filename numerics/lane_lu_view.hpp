// What the LU kernel of matrices in lanes loops over (lane_lu.hpp): plain arrays, as kernels are compiled with
// instruction sets of their own. Rows and columns are in the order of elimination; a value of all lanes is named by its
// offset in doubles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::numerics {

// Row i: the entries of the matrix, of L left of the diagonal and of U right of it are at [Begin of row i, Begin of row
// i + 1) of lists of columns, and of values in the same order. Columns are offsets (place times lanes).
struct LaneLuView {
  std::size_t size;
  std::size_t inner;  // rows outside the border
  const std::uint32_t *matrixBegin, *lowerBegin, *upperBegin;
  const std::uint32_t *matrix, *lower, *upper;
  const std::uint32_t* unknown;  // offset of the unknown of each row in a right-hand side
};

struct LaneLuWork {
  double* matrix;  // values, from whoever has the matrix
  double *lower, *upper, *inversePivot;
  double *row, *x;  // `size` values each
};

}  // namespace lampblack::numerics
