#include "io/block_exchange.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace lampblack::io {
namespace {

std::int64_t blockStart(std::int64_t total, int ranks, int rank) {
  return total * rank / ranks;
}

int blockOf(std::int64_t number, std::int64_t total, int ranks) {
  auto rank = static_cast<int>(number * ranks / std::max<std::int64_t>(total, 1));
  while (rank + 1 < ranks && blockStart(total, ranks, rank + 1) <= number) ++rank;
  while (rank > 0 && blockStart(total, ranks, rank) > number) --rank;
  return rank;
}

std::vector<int> scaled(const std::vector<int>& counts, int width) {
  std::vector<int> result(counts);
  for (int& count : result) count *= width;
  return result;
}

std::vector<int> displacements(const std::vector<int>& counts) {
  std::vector<int> starts(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  return starts;
}

}  // namespace

BlockExchange::BlockExchange(MPI_Comm comm, std::span<const std::int64_t> globalNumbers, std::int64_t total)
    : comm_(comm), total_(total) {
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  first_ = blockStart(total, ranks, rank);
  count_ = blockStart(total, ranks, rank + 1) - first_;

  int outside = 0;
  for (const std::int64_t number : globalNumbers) outside |= number < 0 || number >= total ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &outside, 1, MPI_INT, MPI_MAX, comm);
  if (outside != 0) throw std::logic_error("a global cell or vertex number is out of range");

  const auto n = static_cast<std::size_t>(ranks);
  sendCounts_.assign(n, 0);
  receiveCounts_.assign(n, 0);
  order_.resize(globalNumbers.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return globalNumbers[a] < globalNumbers[b]; });
  for (const std::int64_t number : globalNumbers) {
    ++sendCounts_[static_cast<std::size_t>(blockOf(number, total, ranks))];
  }
  MPI_Alltoall(sendCounts_.data(), 1, MPI_INT, receiveCounts_.data(), 1, MPI_INT, comm);

  std::vector<std::int64_t> sent(order_.size());
  std::transform(order_.begin(), order_.end(), sent.begin(), [&](std::size_t i) { return globalNumbers[i]; });
  positions_.resize(static_cast<std::size_t>(std::accumulate(receiveCounts_.begin(), receiveCounts_.end(), 0)));
  const std::vector<int> sendStarts = displacements(sendCounts_);
  const std::vector<int> receiveStarts = displacements(receiveCounts_);
  MPI_Alltoallv(sent.data(), sendCounts_.data(), sendStarts.data(), MPI_INT64_T, positions_.data(),
                receiveCounts_.data(), receiveStarts.data(), MPI_INT64_T, comm);

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
std::vector<T> BlockExchange::exchange(std::span<const T> values, int width, MPI_Datatype type) const {
  const auto w = static_cast<std::size_t>(width);
  if (values.size() != order_.size() * w) {
    throw std::logic_error("the number of values given is not the number of owned cells times the components");
  }
  std::vector<T> sent(values.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (std::size_t c = 0; c < w; ++c) sent[i * w + c] = values[order_[i] * w + c];
  }
  const std::vector<int> sendCounts = scaled(sendCounts_, width);
  const std::vector<int> receiveCounts = scaled(receiveCounts_, width);
  std::vector<T> received(positions_.size() * w);
  MPI_Alltoallv(sent.data(), sendCounts.data(), displacements(sendCounts).data(), type, received.data(),
                receiveCounts.data(), displacements(receiveCounts).data(), type, comm_);
  std::vector<T> block(static_cast<std::size_t>(count_) * w);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto position = static_cast<std::size_t>(positions_[i]);
    for (std::size_t c = 0; c < w; ++c) block[position * w + c] = received[i * w + c];
  }
  return block;
}

std::vector<double> BlockExchange::toBlock(std::span<const double> values, int width) const {
  return exchange(values, width, MPI_DOUBLE);
}

std::vector<std::int64_t> BlockExchange::toBlock(std::span<const std::int64_t> values, int width) const {
  return exchange(values, width, MPI_INT64_T);
}

std::vector<double> BlockExchange::fromBlock(std::span<const double> block, int width) const {
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> sent(positions_.size() * w);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto position = static_cast<std::size_t>(positions_[i]);
    for (std::size_t c = 0; c < w; ++c) sent[i * w + c] = block[position * w + c];
  }
  const std::vector<int> sendCounts = scaled(receiveCounts_, width);
  const std::vector<int> receiveCounts = scaled(sendCounts_, width);
  std::vector<double> received(order_.size() * w);
  MPI_Alltoallv(sent.data(), sendCounts.data(), displacements(sendCounts).data(), MPI_DOUBLE, received.data(),
                receiveCounts.data(), displacements(receiveCounts).data(), MPI_DOUBLE, comm_);
  std::vector<double> values(received.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    for (std::size_t c = 0; c < w; ++c) values[order_[i] * w + c] = received[i * w + c];
  return values;
}

}  // namespace lampblack::io
