// Block elimination of one end of a bordered block-tridiagonal matrix, row after row towards the middle. A private part
// of BlockTridiagonal: it knows no ranks, and the same code serves the left and the right end. Rows count from the end
// of the matrix inwards; row k is
//
//   outward(k) x(k-1) + diagonal(k) x(k) + inward(k) x(k+1) + columns(k) z = b(k),
//
// with the border's unknowns z, whose equations contain rows(k) x(k). After elimination x(k) = y(k) - X(k) x(k+1) -
// Y(k) z, where Y(k) has taken the place of columns(k), and the border's rows have no x(k) left. The diagonal block's
// inverse W(k) takes its place, and X(k) = W(k) inward(k) is kept of the last row alone: x(k) = W(k) (b(k) - inward(k)
// x(k+1)) - Y(k) z. Both come from the same W, so that what rounding did to W cancels in the rows beyond, as it does
// where X(k) is kept; with factors in place of W it would be magnified by the condition of the block (block elimination
// without pivoting between blocks: Demmel, Higham, Schreiber 1995, Numer. Linear Algebra Appl. 2, 173).
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "numerics/aligned_vector.hpp"
#include "numerics/dense_blocks.hpp"
#include "numerics/neighbour_block.hpp"

namespace lampblack::numerics {

class BlockSweep {
 public:
  BlockSweep(std::size_t rows, std::size_t width, std::size_t border, NeighbourTerms terms);

  [[nodiscard]] std::size_t size() const { return count_; }
  void clear();
  // width x width, width x border and border x width, column-major.
  [[nodiscard]] double* diagonal(std::size_t k) { return at(k); }
  [[nodiscard]] double* columns(std::size_t k) { return at(k) + stride_; }
  [[nodiscard]] double* rows(std::size_t k) { return at(k) + stride_ + thinStride_; }
  [[nodiscard]] NeighbourBlock outward(std::size_t k) { return {n_, terms_, at(k) + stride_ + 2 * thinStride_}; }
  [[nodiscard]] NeighbourBlock inward(std::size_t k) {
    return {n_, terms_, at(k) + stride_ + 2 * thinStride_ + neighbourStride_};
  }

  // Eliminates all rows. Returns the first row whose block is singular or not finite, size() where there is none.
  // `corner` (border x border) becomes the sum of rows(k) Y(k): what elimination takes from the border's own block.
  [[nodiscard]] std::size_t factorise(double* corner);
  // X of the last row (width x width), after factorise.
  [[nodiscard]] const double* innermost() const { return X_.data(); }
  // Of the determinant of the product of the eliminated diagonal blocks, after factorise; 1 where there are no rows.
  [[nodiscard]] int determinantSign() const { return sign_; }
  // From right-hand sides b(k) at b + k * step takes outward(k) y(k-1); rowSum (border values) becomes the sum of
  // rows(k) y(k), `last` (width values) y of the last row, unless there is none.
  void forward(double* b, std::ptrdiff_t step, double* rowSum, double* last);
  // What `forward` left becomes x(k), given x of the row after the last and the border's z.
  void backward(double* b, std::ptrdiff_t step, const double* next, const double* z);

 private:
  [[nodiscard]] double* at(std::size_t k) { return storage_.data() + k * rowStride_; }
  [[nodiscard]] bool eliminate(std::size_t k, double* corner);
  // The diagonal block becomes its inverse; X_ is its scratch. Its rows are first multiplied by powers of two that
  // bring their sums to about one: pivots are then compared alike whatever the units of the equations, and nothing is
  // rounded.
  [[nodiscard]] bool invert(std::size_t k);

  std::size_t count_, n_, border_;
  NeighbourTerms terms_;
  // Of a diagonal block, a border block, a block beside the diagonal, a row: whole cache lines.
  std::size_t stride_, thinStride_, neighbourStride_, rowStride_;
  AlignedVector storage_;
  AlignedVector X_;      // of the row that was eliminated last
  AlignedVector scale_;  // of the row at hand, as its pivots
  std::vector<int> pivots_;
  int sign_ = 1;
  DenseBlocks dense_;
};

// Powers of two by which to multiply the rows of the m x n matrix A; false where a row is zero or not finite.
[[nodiscard]] bool rowScales(std::size_t m, std::size_t n, const double* A, double* scale);
void multiplyRows(std::size_t m, std::size_t n, const double* scale, double* A);

}  // namespace lampblack::numerics
