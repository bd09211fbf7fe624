// Rows of doubles of cells, each of any length, in the order of a file: one behind the other, by the global numbers of
// their cells. A block of cells may have most of the values. So what travels is not the rows of a block, but portions
// of all values, of which each rank holds a piece of the same size, whatever rows it cuts.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "io/block_exchange.hpp"

namespace lampblack::io {

class OrderedRows {
 public:
  // `lengths` of the rows of this rank's block of `cells`. Collective.
  OrderedRows(MPI_Comm comm, const BlockExchange& cells, std::span<const std::int64_t> lengths);

  // Of the rows of this rank's own cells, in the order in which `cells` got them.
  [[nodiscard]] const std::vector<std::int64_t>& lengths() const { return lengths_; }
  [[nodiscard]] std::int64_t total() const { return total_; }  // values of all rows

  [[nodiscard]] std::int64_t portions() const;  // the same on all ranks
  // This rank's piece of a portion: its first value among all and how many, 0 where it holds none.
  [[nodiscard]] std::int64_t first(std::int64_t portion) const;
  [[nodiscard]] std::int64_t count(std::int64_t portion) const;

  // The values of this rank's piece, of the ranks' own rows, which have their lengths. Collective.
  [[nodiscard]] std::vector<double> toPiece(std::int64_t portion, std::span<const std::vector<double>> rows) const;
  // The way back: fills what the portion has of this rank's own rows, which have their lengths. Collective.
  void fromPiece(std::int64_t portion, std::span<const double> piece, std::span<std::vector<double>> rows) const;

 private:
  // What one piece has of one row.
  struct Part {
    std::size_t row, from, count;  // of this rank's rows; values
    int rank;                      // that holds the piece
    std::size_t place;             // in it
  };
  [[nodiscard]] std::vector<Part> partsOf(std::int64_t portion) const;

  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  std::int64_t total_ = 0;
  std::vector<std::int64_t> lengths_, starts_;  // of this rank's own rows; where each begins among all values
  std::vector<std::size_t> order_;              // those that are not empty, by where they begin
};

}  // namespace lampblack::io
