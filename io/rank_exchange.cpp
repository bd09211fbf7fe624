#include "io/rank_exchange.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace lampblack::io {
namespace {

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

RankExchange::RankExchange(MPI_Comm comm, std::span<const int> destinations) : comm_(comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  sendCounts_.assign(static_cast<std::size_t>(ranks), 0);
  receiveCounts_.assign(static_cast<std::size_t>(ranks), 0);
  for (const int rank : destinations) ++sendCounts_.at(static_cast<std::size_t>(rank));
  std::vector<int> next = displacements(sendCounts_);
  order_.resize(destinations.size());
  for (std::size_t i = 0; i < destinations.size(); ++i)
    order_[static_cast<std::size_t>(next[static_cast<std::size_t>(destinations[i])]++)] = i;
  MPI_Alltoall(sendCounts_.data(), 1, MPI_INT, receiveCounts_.data(), 1, MPI_INT, comm);
  received_ = static_cast<std::size_t>(std::accumulate(receiveCounts_.begin(), receiveCounts_.end(), 0));
}

template <typename T>
std::vector<T> RankExchange::send(std::span<const T> values, int width, MPI_Datatype type) const {
  const auto w = static_cast<std::size_t>(width);
  if (values.size() != order_.size() * w)
    throw std::logic_error("the number of values given is not the number of items times the components");
  std::vector<T> sent(values.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    for (std::size_t c = 0; c < w; ++c) sent[i * w + c] = values[order_[i] * w + c];
  const std::vector<int> sendCounts = scaled(sendCounts_, width);
  const std::vector<int> receiveCounts = scaled(receiveCounts_, width);
  std::vector<T> result(received_ * w);
  MPI_Alltoallv(sent.data(), sendCounts.data(), displacements(sendCounts).data(), type, result.data(),
                receiveCounts.data(), displacements(receiveCounts).data(), type, comm_);
  return result;
}

template <typename T>
std::vector<T> RankExchange::answer(std::span<const T> values, int width, MPI_Datatype type) const {
  const auto w = static_cast<std::size_t>(width);
  if (values.size() != received_ * w)
    throw std::logic_error("the number of answers is not the number of items that came times the components");
  const std::vector<int> sendCounts = scaled(receiveCounts_, width);
  const std::vector<int> receiveCounts = scaled(sendCounts_, width);
  std::vector<T> answers(order_.size() * w);
  MPI_Alltoallv(values.data(), sendCounts.data(), displacements(sendCounts).data(), type, answers.data(),
                receiveCounts.data(), displacements(receiveCounts).data(), type, comm_);
  std::vector<T> result(answers.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    for (std::size_t c = 0; c < w; ++c) result[order_[i] * w + c] = answers[i * w + c];
  return result;
}

std::vector<double> RankExchange::there(std::span<const double> values, int width) const {
  return send(values, width, MPI_DOUBLE);
}
std::vector<std::int64_t> RankExchange::there(std::span<const std::int64_t> values, int width) const {
  return send(values, width, MPI_INT64_T);
}
std::vector<double> RankExchange::back(std::span<const double> values, int width) const {
  return answer(values, width, MPI_DOUBLE);
}
std::vector<std::int64_t> RankExchange::back(std::span<const std::int64_t> values, int width) const {
  return answer(values, width, MPI_INT64_T);
}

}  // namespace lampblack::io
