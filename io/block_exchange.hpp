// Brings values from the ranks that own them into the order of a file: global numbers 0..total-1 are cut into one
// contiguous block a rank, and each value travels to the rank that holds its block. Who sends what to whom is found
// once; every exchange afterwards is a single MPI_Alltoallv.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/rooms.hpp"

namespace lampblack::io {

class BlockExchange {
 public:
  // `globalNumbers` of the values this rank gives, in the order it will give them. Collective.
  BlockExchange(MPI_Comm comm, std::span<const std::int64_t> globalNumbers, std::int64_t total);

  // Whether each number was given exactly once, or at least once, on all ranks together. The same on all ranks.
  [[nodiscard]] bool coversOnce() const { return once_; }
  [[nodiscard]] bool covers() const { return covered_; }

  // This rank's block of the file: its first number and how many.
  [[nodiscard]] std::int64_t first() const { return first_; }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t total() const { return total_; }

  // The values of this rank's block, `width` for each number. Where a number is given by several ranks, the highest
  // rank's value is kept. Collective.
  [[nodiscard]] std::vector<double> toBlock(std::span<const double> values, int width) const;
  [[nodiscard]] std::vector<std::int64_t> toBlock(std::span<const std::int64_t> values, int width) const;
  // The way back: what this rank's block holds goes to all that gave its numbers. Collective.
  [[nodiscard]] std::vector<double> fromBlock(std::span<const double> block, int width) const;

 private:
  template <typename T>
  std::vector<T> exchange(std::span<const T> values, int width, MPI_Datatype type) const;

  MPI_Comm comm_;
  std::int64_t total_;
  std::int64_t first_ = 0;
  std::int64_t count_ = 0;
  bool once_ = false;
  bool covered_ = false;
  std::vector<std::size_t> order_;       // my values sorted by the rank they go to
  std::vector<int> sendCounts_;          // values to each rank
  std::vector<int> receiveCounts_;       // values from each rank
  std::vector<std::int64_t> positions_;  // in my block, of the values received
};

}  // namespace lampblack::io
