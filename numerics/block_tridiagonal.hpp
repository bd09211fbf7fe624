// LU factors of a bordered block-tridiagonal matrix, such as the Newton matrix of a one-dimensional flame:
//
//   | D0 U0          b0 |     blocks of `width` unknowns a point,
//   | L1 D1 U1       b1 |     a border of a few unknowns of the whole flame
//   |    L2 D2 ...   .. |     (mass flux, pressure gradient, load).
//   | c0 c1 ...      e  |
//
// Elimination goes from both ends to a block in the middle, with pivoting inside blocks (rows scaled), so that
// two ranks share the work without more of it; the result has the same bits on any number of ranks. The border is
// eliminated along with the ends and then pivoted together with the middle block: a matrix that is singular without its
// border, as at the turning point of a family of flames, is no difficulty. (Twisted factors: Golub and Van Loan
// 2013, section 4.5; bordering: Govaerts 2000.)
#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <span>

#include "core/modules.hpp"
#include "numerics/neighbour_block.hpp"

namespace lampblack::numerics {

class BlockTridiagonal {
 public:
  // Blocks beside the diagonal ones are dense, or thin with that many terms: a row then takes little more than a third
  // of the memory, and elimination half the time.
  BlockTridiagonal(MPI_Comm comm, std::size_t points, std::size_t width, std::size_t border, NeighbourTerms terms = {});
  ~BlockTridiagonal();
  BlockTridiagonal(BlockTridiagonal&&) noexcept;
  BlockTridiagonal& operator=(BlockTridiagonal&&) noexcept;

  [[nodiscard]] std::size_t points() const;
  [[nodiscard]] std::size_t width() const;
  [[nodiscard]] std::size_t border() const;
  [[nodiscard]] std::size_t size() const { return points() * width() + border(); }

  // Block rows whose blocks this rank has to set: [begin, end), perhaps none; together the ranks own each row once.
  [[nodiscard]] std::size_t ownedBegin() const;
  [[nodiscard]] std::size_t ownedEnd() const;

  // Sets all entries to zero, and forgets the factors: needed before blocks are set once more.
  void clear();
  // Blocks of an owned row, dense ones column-major with leading dimension `width`. `lower` of row 0 and `upper` of the
  // last row do not exist: std::logic_error, as when factors have taken the place of the blocks.
  [[nodiscard]] NeighbourBlock lower(std::size_t row);
  [[nodiscard]] double* diagonal(std::size_t row);
  [[nodiscard]] NeighbourBlock upper(std::size_t row);
  // Border: columns beside an owned row (width x border, column-major), rows below a column of blocks (border x width,
  // column-major; set by the owner of the block row of that number), and the corner (border x border, column-major,
  // the same on all ranks).
  [[nodiscard]] double* borderColumns(std::size_t row);
  [[nodiscard]] double* borderRows(std::size_t column);
  [[nodiscard]] double* corner();

  // y = A x of the matrix as set, for tests: all of y on every rank. Collective; not after factorise.
  void multiply(std::span<const double> x, std::span<double> y) const;

  // Collective. Overwrites the blocks by factors. False where a block is singular or not finite; `singularPoint` then
  // tells which one (the middle stands for the border, too).
  [[nodiscard]] bool factorise();
  [[nodiscard]] std::size_t singularPoint() const;
  // Of the matrix that was factorised, 1 or -1; the same on all ranks. std::logic_error without factors.
  [[nodiscard]] int determinantSign() const;
  // Collective. b (size() values, alike on all ranks) becomes the solution, alike on all ranks.
  void solve(std::span<double> b);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace lampblack::numerics
