// What BlockTridiagonal keeps: the two ends, and on the rank of the left end the row of the middle. Private.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "core/modules.hpp"
#include "numerics/block_sweep.hpp"
#include "numerics/block_tridiagonal.hpp"

namespace lampblack::numerics {

enum Side : std::size_t { left, right };

struct BlockTridiagonal::Data {
  MPI_Comm comm = MPI_COMM_NULL;
  int ranks = 1;
  std::size_t points = 0, n = 0, border = 0, middle = 0;
  NeighbourTerms terms;
  std::array<bool, 2> owns{};  // ends; who has the left one has the middle
  std::array<BlockSweep, 2> ends;
  // The row of the middle, and the border's corner.
  AlignedVector middleLower, middleDiagonal, middleUpper, middleColumns, middleRows, corner;
  // Factors of the last equations: the middle and the border, scaled by rows.
  AlignedVector core, coreScale;
  std::vector<int> corePivots;
  DenseBlocks dense;
  bool untouched = true, set = true, factorised = false;
  std::size_t singular = 0;
  int sign = 1;  // of the determinant

  Data(MPI_Comm c, int rank, int count, std::size_t N, std::size_t width, std::size_t borderWidth,
       NeighbourTerms ofNeighbours)
      : comm(c),
        ranks(count),
        points(N),
        n(width),
        border(borderWidth),
        middle((N - 1) / 2),
        terms(ofNeighbours),
        owns{rank == 0, count == 1 || rank == 1},
        ends{BlockSweep(owns[left] ? middle : 0, n, border, terms),
             BlockSweep(owns[right] ? N - 1 - middle : 0, n, border, terms)},
        corner(border * border) {
    if (!owns[left]) return;
    middleDiagonal.resize(n * n);
    for (auto* block : {&middleLower, &middleUpper}) block->resize(NeighbourBlock::size(n, terms));
    for (auto* block : {&middleColumns, &middleRows}) block->resize(n * border);
    core.resize((n + border) * (n + border));
    coreScale.resize(n + border);
    corePivots.resize(n + border);
  }

  // Owned rows.
  [[nodiscard]] std::size_t begin() const { return owns[left] ? 0 : owns[right] ? middle + 1 : points; }
  [[nodiscard]] std::size_t end() const { return owns[left] && !owns[right] ? middle + 1 : points; }
  // Who has the right end.
  [[nodiscard]] int rightRank() const { return ranks > 1 ? 1 : 0; }
  // From a point to the next, counting inwards from the right end or outwards from the left one.
  [[nodiscard]] std::ptrdiff_t step() const { return static_cast<std::ptrdiff_t>(n); }

  // Blocks of an owned row as the header of BlockTridiagonal describes them.
  NeighbourBlock lower(std::size_t row) {
    return block(row, ofMiddle(middleLower), row < middle ? &BlockSweep::outward : &BlockSweep::inward);
  }
  double* diagonal(std::size_t row) { return block(row, middleDiagonal.data(), &BlockSweep::diagonal); }
  NeighbourBlock upper(std::size_t row) {
    return block(row, ofMiddle(middleUpper), row < middle ? &BlockSweep::inward : &BlockSweep::outward);
  }
  double* columns(std::size_t row) { return block(row, middleColumns.data(), &BlockSweep::columns); }
  double* rows(std::size_t column) { return block(column, middleRows.data(), &BlockSweep::rows); }
  // A block beside the diagonal one of the middle.
  [[nodiscard]] NeighbourBlock ofMiddle(AlignedVector& values) { return {n, terms, values.data()}; }

  // The middle and the border once both ends are eliminated; false where they are singular together.
  [[nodiscard]] bool factoriseCore(const std::vector<double>& ofLeft, const std::vector<double>& fromRight);

 private:
  template <typename Block>
  Block block(std::size_t row, Block inMiddle, Block (BlockSweep::*ofEnd)(std::size_t)) {
    if (!set) throw std::logic_error("BlockTridiagonal: the blocks have become factors");
    if (row < begin() || row >= end()) throw std::logic_error("BlockTridiagonal: not a row of this rank");
    untouched = false;
    if (row == middle) return inMiddle;
    return row < middle ? (ends[left].*ofEnd)(row) : (ends[right].*ofEnd)(points - 1 - row);
  }
};

}  // namespace lampblack::numerics
