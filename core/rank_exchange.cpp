#include "core/rank_exchange.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

namespace lampblack {

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

std::size_t portionsOf(MPI_Comm comm, std::size_t values) {
  auto portions = static_cast<std::int64_t>((values + valuesInPortion - 1) / valuesInPortion);
  MPI_Allreduce(MPI_IN_PLACE, &portions, 1, MPI_INT64_T, MPI_MAX, comm);
  return static_cast<std::size_t>(std::max<std::int64_t>(1, portions));
}

}  // namespace lampblack
