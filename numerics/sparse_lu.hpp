// LU factors of a sparse matrix of fixed pattern, for the Newton steps of a stiff integrator, where the same pattern is
// factorised millions of times. Order, fill and all indices are found once; the numerical work then runs over blocks of
// eight rows of dense columns, without searching, gathering or pivoting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "numerics/aligned_vector.hpp"
#include "numerics/elimination.hpp"

namespace lampblack::numerics {

class SparseLu {
 public:
  using Entry = MatrixEntry;

  explicit SparseLu(const Elimination& elimination);
  SparseLu(std::size_t n, std::span<const Entry> entries, std::size_t border = 0)
      : SparseLu(Elimination(n, entries, border)) {}

  std::size_t size() const { return n_; }
  // The values of a matrix are kept in a vector of this length, in an order of our own, zero where there is no entry.
  std::size_t storageSize() const { return n_ * ld_; }
  // Where in it an entry lies. std::logic_error if the pattern has no such entry.
  std::size_t position(std::size_t row, std::size_t column) const;

  // Factorises diag(diagonal) - factor * values. False if a pivot is zero or not finite, or a multiplier outside the
  // rows of the border exceeds largestMultiplier: that matrix wants pivoting, which is not done here.
  bool factorise(const AlignedVector& values, double factor, std::span<const double> diagonal);
  // Overwrites b (size() values) with the solution.
  void solve(double* b);

  static constexpr double largestMultiplier = 1e3;

  // Entries of L and U, and the updates of eight values in one factorisation, which its cost goes with.
  std::size_t numEntries() const { return numEntries_; }
  std::size_t blockUpdates() const;

 private:
  void setLists(const Elimination::Pattern& pattern);
  void load(const AlignedVector& values, double factor, std::span<const double> diagonal);
  void finishColumn(std::size_t k);
  void updateColumns(std::size_t k);
  bool accept() const;
  void solveLower(double* x) const;
  void solveUpper(double* x) const;

  // Column k of the factors: its blocks in use, those of U in earlier rows, of L in later rows, and the later columns
  // that L is subtracted from. Blocks are named by their first row; the block of the diagonal is always of L, as the
  // first, and never of `upper`: its part of U is in diagonalUpper_.
  struct Column {
    std::uint32_t used = 0, usedEnd = 0;
    std::uint32_t upper = 0, upperEnd = 0;
    std::uint32_t lower = 0, lowerEnd = 0;
    std::uint32_t changed = 0, changedEnd = 0;
    bool lowerInDiagonalBlock = false;
  };

  std::size_t n_ = 0, ld_ = 0;
  std::size_t inner_ = 0;  // unknowns outside the border
  std::size_t numEntries_ = 0;
  std::vector<std::size_t> unknown_, place_;  // by order of elimination, and the reverse
  std::vector<char> inPattern_;               // by position
  std::vector<Column> columns_;
  std::vector<std::uint32_t> used_, upper_, lower_;
  std::vector<std::uint32_t> changed_;  // columns, as offsets into matrix_

  AlignedVector matrix_;           // columns ld_ apart; after the factorisation U in the blocks of upper_
  AlignedVector l_;                // blocks in the order of lower_, zero in rows up to the diagonal
  AlignedVector diagonalUpper_;    // a block a column: U before the diagonal in its block, over the pivot
  AlignedVector inverseDiagonal_;  // one over the pivots
  AlignedVector innerRows_;        // 1 for rows outside the border
  AlignedVector growth_;           // one block: the largest multipliers; one: zero if all are finite
  AlignedVector x_;                // right-hand side in the order of elimination
};

}  // namespace lampblack::numerics
