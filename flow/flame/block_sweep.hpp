// Block elimination of one end of a bordered block-tridiagonal matrix, row after row towards the middle. A private part
// of BlockTridiagonal: it knows no ranks, and the same code serves the left and the right end. Rows count from the end
// of the matrix inwards; row k is
//
//   outward(k) x(k-1) + diagonal(k) x(k) + inward(k) x(k+1) + columns(k) z = b(k),
//
// with the border's unknowns z, whose equations contain rows(k) x(k). After elimination x(k) = y(k) - X(k) x(k+1) -
// Y(k) z where X(k) and Y(k) have taken the place of inward(k) and columns(k), and the border's rows have no x(k) left.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/numerics/aligned_vector.hpp"
#include "chemistry/numerics/dense_blocks.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

class BlockSweep {
 public:
  BlockSweep(std::size_t rows, std::size_t width, std::size_t border);

  [[nodiscard]] std::size_t size() const { return count_; }
  void clear();
  // width x width, width x width, width x width, width x border and border x width; column-major.
  [[nodiscard]] double* outward(std::size_t k) { return at(k); }
  [[nodiscard]] double* diagonal(std::size_t k) { return at(k) + stride_; }
  [[nodiscard]] double* inward(std::size_t k) { return at(k) + 2 * stride_; }
  [[nodiscard]] double* columns(std::size_t k) { return at(k) + 3 * stride_; }
  [[nodiscard]] double* rows(std::size_t k) { return at(k) + 3 * stride_ + thinStride_; }

  // Eliminates all rows. Returns the first row whose block is singular or not finite, size() where there is none.
  // `corner` (border x border) becomes the sum of rows(k) Y(k): what elimination takes from the border's own block.
  [[nodiscard]] std::size_t factorise(double* corner);
  // Of the determinant of the product of the eliminated diagonal blocks, after factorise; 1 where there are no rows.
  [[nodiscard]] int determinantSign() const;
  // Right-hand sides b(k) at b + k * step become y(k); rowSum(border values) becomes the sum of rows(k) y(k).
  void forward(double* b, std::ptrdiff_t step, double* rowSum);
  // y(k) become x(k), given x of the row after the last and the border's z.
  void backward(double* y, std::ptrdiff_t step, const double* next, const double* z);

 private:
  [[nodiscard]] double* at(std::size_t k) { return storage_.data() + k * rowStride_; }
  [[nodiscard]] bool eliminate(std::size_t k, double* corner);
  // Multiplies the rows of a block by powers of two that bring their sums to about one: pivots are then compared alike
  // whatever the units of the equations, and nothing is rounded.
  [[nodiscard]] bool scaleRows(std::size_t k);

  std::size_t count_, n_, border_;
  std::size_t stride_, thinStride_, rowStride_;  // of a block, a border block, a row: whole cache lines
  AlignedVector storage_;
  AlignedVector scale_;
  std::vector<int> pivots_;
  DenseBlocks dense_;
};

// Powers of two by which to multiply the rows of the m x n matrix A; false where a row is zero or not finite.
[[nodiscard]] bool rowScales(std::size_t m, std::size_t n, const double* A, double* scale);
void multiplyRows(std::size_t m, std::size_t n, const double* scale, double* A);

}  // namespace lampblack::flow
