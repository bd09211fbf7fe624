#include "core/rank_exchange.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

namespace lampblack {
namespace {

// Of rows by rank, `rows` of each: how many values each rank's have together.
std::vector<std::size_t> valuesOfRanks(const std::vector<std::size_t>& rows, const std::vector<std::int64_t>& lengths) {
  std::vector<std::size_t> values;
  auto next = lengths.begin();
  for (const std::size_t count : rows) {
    const auto end = next + static_cast<std::ptrdiff_t>(count);
    values.push_back(static_cast<std::size_t>(std::accumulate(next, end, std::int64_t{0})));
    next = end;
  }
  return values;
}

}  // namespace

RankExchange::RankExchange(MPI_Comm comm, std::span<const int> destinations) : comm_(comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<std::int64_t> to(static_cast<std::size_t>(ranks), 0), from(to.size(), 0);
  for (const int rank : destinations) ++to.at(static_cast<std::size_t>(rank));
  std::vector<std::size_t> next(to.size(), 0);
  std::exclusive_scan(to.begin(), to.end(), next.begin(), std::size_t{0});
  order_.resize(destinations.size());
  for (std::size_t i = 0; i < destinations.size(); ++i) order_[next[static_cast<std::size_t>(destinations[i])]++] = i;
  MPI_Alltoall(to.data(), 1, MPI_INT64_T, from.data(), 1, MPI_INT64_T, comm);
  sendCounts_.assign(to.begin(), to.end());
  receiveCounts_.assign(from.begin(), from.end());
  received_ = std::accumulate(receiveCounts_.begin(), receiveCounts_.end(), std::size_t{0});
}

void RankExchange::checkSize(std::size_t given, std::size_t expected) {
  if (given != expected)
    throw std::logic_error("the number of values given is not the number of items times the components");
}

void RankExchange::pass(const void* sent, const std::vector<std::size_t>& from, void* received,
                        const std::vector<std::size_t>& to, std::size_t bytes) const {
  std::vector<std::pair<const char*, std::size_t>> parts;
  std::vector<std::size_t> coming;
  std::vector<char*> into;
  const char* read = static_cast<const char*>(sent);
  char* write = static_cast<char*>(received);
  for (std::size_t r = 0; r < from.size(); ++r) {
    parts.emplace_back(read, from[r] * bytes);
    coming.push_back(to[r] * bytes);
    into.push_back(write);
    read += parts.back().second;
    write += coming.back();
  }
  detail::exchangeBytes(comm_, parts, coming, &into);
}

void RankExchange::passRows(const PackedRows& sent, const std::vector<std::size_t>& from, PackedRows& received,
                            const std::vector<std::size_t>& to) const {
  const std::vector<std::size_t> coming = valuesOfRanks(to, received.lengths);
  received.values.resize(std::accumulate(coming.begin(), coming.end(), std::size_t{0}));
  pass(sent.values.data(), valuesOfRanks(from, sent.lengths), received.values.data(), coming, sizeof(double));
}

PackedRows RankExchange::send(const PackedRows& rows) const {
  PackedRows result;
  result.lengths = send(rows.lengths, 1);
  passRows(gathered(rows, order_), sendCounts_, result, receiveCounts_);
  return result;
}

PackedRows RankExchange::reply(const PackedRows& rows) const {
  const std::vector<std::int64_t> lengths = reply(rows.lengths, 1);
  PackedRows answers;
  for (const std::size_t item : order_) answers.lengths.push_back(lengths[item]);
  passRows(rows, receiveCounts_, answers, sendCounts_);
  return scattered(answers, order_);
}

std::size_t portionsOf(MPI_Comm comm, std::size_t values) {
  auto portions = static_cast<std::int64_t>((values + valuesInPortion - 1) / valuesInPortion);
  MPI_Allreduce(MPI_IN_PLACE, &portions, 1, MPI_INT64_T, MPI_MAX, comm);
  return static_cast<std::size_t>(std::max<std::int64_t>(1, portions));
}

}  // namespace lampblack
