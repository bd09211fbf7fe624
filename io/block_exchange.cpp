#include "io/block_exchange.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack::io {
namespace {

// The rank of each number. Collective: all ranks throw where any number is out of range.
std::vector<int> ranksOfBlocks(MPI_Comm comm, std::span<const std::int64_t> numbers, std::int64_t total, int holders) {
  int outside = 0;
  for (const std::int64_t number : numbers) outside |= number < 0 || number >= total ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &outside, 1, MPI_INT, MPI_MAX, comm);
  if (outside != 0) throw std::logic_error("a global cell or vertex number is out of range");
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> result;
  result.reserve(numbers.size());
  if (holders == 0) holders = ranks;
  for (const std::int64_t number : numbers)
    result.push_back(static_cast<int>(blockStart(ranks, holders, blockOf(number, total, holders))));
  return result;
}

}  // namespace

std::int64_t blockStart(std::int64_t total, int ranks, int rank) {
  return total * rank / ranks;
}

int blockOf(std::int64_t number, std::int64_t total, int ranks) {
  auto rank = static_cast<int>(number * ranks / std::max<std::int64_t>(total, 1));
  while (rank + 1 < ranks && blockStart(total, ranks, rank + 1) <= number) ++rank;
  while (rank > 0 && blockStart(total, ranks, rank) > number) --rank;
  return rank;
}

BlockExchange::BlockExchange(MPI_Comm comm, std::span<const std::int64_t> globalNumbers, std::int64_t total,
                             int holders)
    : total_(total), ranks_(comm, ranksOfBlocks(comm, globalNumbers, total, holders)) {
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  if (holders == 0) holders = ranks;
  const int block = blockOf(rank, ranks, holders);
  first_ = blockStart(total, holders, block);
  if (blockStart(ranks, holders, block) == rank) count_ = blockStart(total, holders, block + 1) - first_;

  positions_ = ranks_.send(globalNumbers, 1);
  std::vector<int> given(static_cast<std::size_t>(count_), 0);
  for (std::int64_t& position : positions_) {
    position -= first_;
    ++given[static_cast<std::size_t>(position)];
  }
  int flags[2] = {std::all_of(given.begin(), given.end(), [](int g) { return g == 1; }) ? 1 : 0,
                  std::all_of(given.begin(), given.end(), [](int g) { return g >= 1; }) ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, flags, 2, MPI_INT, MPI_MIN, comm);
  once_ = flags[0] != 0;
  covered_ = flags[1] != 0;
}

template <typename T>
std::vector<T> BlockExchange::place(const std::vector<T>& received, int width) const {
  const auto w = static_cast<std::size_t>(width);
  std::vector<T> block(static_cast<std::size_t>(count_) * w);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto position = static_cast<std::size_t>(positions_[i]);
    for (std::size_t c = 0; c < w; ++c) block[position * w + c] = received[i * w + c];
  }
  return block;
}

template <typename T>
std::vector<T> BlockExchange::pick(std::span<const T> block, int width) const {
  const auto w = static_cast<std::size_t>(width);
  std::vector<T> picked(positions_.size() * w);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto position = static_cast<std::size_t>(positions_[i]);
    for (std::size_t c = 0; c < w; ++c) picked[i * w + c] = block[position * w + c];
  }
  return picked;
}

std::vector<double> BlockExchange::toBlock(std::span<const double> values, int width) const {
  return place(ranks_.send(values, width), width);
}
std::vector<std::int64_t> BlockExchange::toBlock(std::span<const std::int64_t> values, int width) const {
  return place(ranks_.send(values, width), width);
}
std::vector<double> BlockExchange::fromBlock(std::span<const double> block, int width) const {
  return ranks_.reply(pick(block, width), width);
}
std::vector<std::int64_t> BlockExchange::fromBlock(std::span<const std::int64_t> block, int width) const {
  return ranks_.reply(pick(block, width), width);
}

}  // namespace lampblack::io
