#include "io/redistribution.hpp"

#include <stdexcept>

#include "core/rank_exchange.hpp"

namespace lampblack::io {

Redistribution::Redistribution(MPI_Comm comm, std::span<const std::int64_t> from, std::span<const std::int64_t> to,
                               std::int64_t total)
    : comm_(comm),
      arrivals_(static_cast<std::int64_t>(to.size())),
      leaving_(std::make_shared<BlockExchange>(comm, from, total)),
      arriving_(std::make_shared<BlockExchange>(comm, to, total)) {}

std::vector<double> Redistribution::operator()(const std::vector<double>& values, int width) const {
  return arriving_->fromBlock(leaving_->toBlock(values, width), width);
}

PackedRows Redistribution::operator()(const PackedRows& rows) const {
  if (!leaving_->coversOnce() || !arriving_->coversOnce())
    throw std::logic_error("Redistribution: rows of what several ranks have, or none");
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  std::vector<std::int64_t> goals;  // rank and place of each number
  for (std::int64_t place = 0; place < arrivals_; ++place) goals.insert(goals.end(), {rank, place});
  goals = leaving_->fromBlock(arriving_->toBlock(goals, 2), 2);
  std::vector<int> ranks;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < goals.size(); i += 2) {
    ranks.push_back(static_cast<int>(goals[i]));
    places.push_back(static_cast<std::size_t>(goals[i + 1]));
  }
  const RankExchange exchange(comm_, ranks);
  places = exchange.send(places, 1);
  return scattered(exchange.send(rows), places);
}

}  // namespace lampblack::io
