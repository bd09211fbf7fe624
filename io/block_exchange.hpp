// Brings values from the ranks that own them into the order of a file: global numbers 0..total-1 are cut into one
// contiguous block a rank, or a block for each of some ranks, and each value travels to the rank that holds its block.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/rank_exchange.hpp"

namespace lampblack::io {

// Where the block of each rank begins, and whose block a number is in.
std::int64_t blockStart(std::int64_t total, int ranks, int rank);
int blockOf(std::int64_t number, std::int64_t total, int ranks);

class BlockExchange {
 public:
  // `globalNumbers` of the values this rank gives, in the order it will give them. `holders`: how many ranks hold
  // blocks, spread evenly over all; 0: each. Collective.
  BlockExchange(MPI_Comm comm, std::span<const std::int64_t> globalNumbers, std::int64_t total, int holders = 0);

  // Whether each number was given exactly once, or at least once, on all ranks together. The same on all ranks.
  [[nodiscard]] bool coversOnce() const { return once_; }
  [[nodiscard]] bool covers() const { return covered_; }

  // This rank's block of the file: its first number and how many, 0 where it holds none.
  [[nodiscard]] std::int64_t first() const { return first_; }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t total() const { return total_; }

  // The values of this rank's block, `width` for each number, 0 where none is given. Where a number is given by several
  // ranks, the highest rank's value is kept. Collective.
  [[nodiscard]] std::vector<double> toBlock(std::span<const double> values, int width) const;
  [[nodiscard]] std::vector<std::int64_t> toBlock(std::span<const std::int64_t> values, int width) const;
  // The way back: what this rank's block holds goes to all that gave its numbers. Collective.
  [[nodiscard]] std::vector<double> fromBlock(std::span<const double> block, int width) const;
  [[nodiscard]] std::vector<std::int64_t> fromBlock(std::span<const std::int64_t> block, int width) const;

 private:
  template <typename T>
  std::vector<T> place(const std::vector<T>& received, int width) const;
  template <typename T>
  std::vector<T> pick(std::span<const T> block, int width) const;

  std::int64_t total_;
  std::int64_t first_ = 0;
  std::int64_t count_ = 0;
  bool once_ = false;
  bool covered_ = false;
  RankExchange ranks_;
  std::vector<std::int64_t> positions_;  // in my block, of the values received
};

}  // namespace lampblack::io
