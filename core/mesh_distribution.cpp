#include "core/mesh_distribution.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/rank_exchange.hpp"
#include "core/ranks.hpp"
#include "core/shares.hpp"

namespace lampblack {
namespace {

struct ArrivedCells {
  CellSet cells;  // by the rank that sent them, and in its order
  std::vector<std::int64_t> ofRank;
};

// Sends each cell to the ranks that `eachRankOf(cell, sendTo)` names, always the same, in portions.
template <typename EachRank>
ArrivedCells sendCells(MPI_Comm comm, const CellSet& from, EachRank&& eachRankOf) {
  const auto ranks = static_cast<std::size_t>(ranksOf(comm));
  std::vector<CellSet::Amount> sent(ranks), next(ranks);
  for (std::size_t c = 0; c < from.size(); ++c)
    eachRankOf(c, [&](int to) { sent[static_cast<std::size_t>(to)].add(from.shapes[c]); });
  static_assert(sizeof(CellSet::Amount) == 3 * sizeof(std::int64_t));
  MPI_Alltoall(sent.data(), 3, MPI_INT64_T, next.data(), 3, MPI_INT64_T, comm);
  ArrivedCells arrived;
  CellSet::Amount all;
  for (CellSet::Amount& amount : next) {
    arrived.ofRank.push_back(amount.cells);
    const CellSet::Amount begin = all;
    all = {all.cells + amount.cells, all.corners + amount.corners, all.sides + amount.sides};
    amount = begin;
  }
  arrived.cells.resize(all);
  constexpr std::size_t valuesOfCell = 32;
  std::size_t c = 0;
  for (std::size_t portion = 0, portions = portionsOf(comm, from.size() * valuesOfCell); portion < portions;
       ++portion) {
    std::vector<std::vector<std::int64_t>> messages(ranks);
    for (const std::size_t end = std::min(c + valuesInPortion / valuesOfCell, from.size()); c < end; ++c)
      eachRankOf(c, [&](int to) { from.pack(c, messages[static_cast<std::size_t>(to)]); });
    const Received<std::int64_t> received = sendToRanks(comm, messages);
    for (std::size_t r = 0; r < ranks; ++r)
      arrived.cells.unpack({received.values.data() + received.start[r], received.start[r + 1] - received.start[r]},
                           next[r]);
  }
  return arrived;
}

}  // namespace

DistributedCells distribute(MPI_Comm comm, CellSet cells, std::int64_t totalCells, const std::vector<int>& owner) {
  const int rank = rankIn(comm);
  const auto ranks = static_cast<std::size_t>(ranksOf(comm));
  std::int64_t first = 0;
  const auto own = static_cast<std::int64_t>(cells.size());
  MPI_Exscan(&own, &first, 1, MPI_INT64_T, MPI_SUM, comm);
  const Shares shares(comm, first, totalCells);

  // Whose the neighbours are.
  const auto isHere = [&](std::int64_t number) { return number >= first && number < first + own; };
  std::vector<std::int64_t> elsewhere;
  for (const CellSet::Side& side : cells.sides)
    if (side.neighbour >= 0 && !isHere(side.neighbour)) elsewhere.push_back(side.neighbour);
  const auto answers = ask<std::int32_t>(comm, shares, elsewhere, [&](std::int64_t number) {
    return static_cast<std::int32_t>(owner[static_cast<std::size_t>(number - first)]);
  });
  std::size_t next = 0;
  for (CellSet::Side& side : cells.sides)
    if (side.neighbour >= 0)
      side.owner = isHere(side.neighbour) ? owner[static_cast<std::size_t>(side.neighbour - first)] : answers[next++];

  DistributedCells result;
  if (ranks == 1) {
    result.owned = std::move(cells);
    return result;
  }
  // The shares of the ranks follow one another, so that cells by rank and number are cells by number.
  result.owned = sendCells(comm, cells, [&](std::size_t c, auto&& sendTo) { sendTo(owner[c]); }).cells;
  cells = {};
  ArrivedCells seen = sendCells(comm, result.owned, [&](std::size_t c, auto&& sendTo) {
    const auto sides = result.owned.sidesOf(c);
    for (std::size_t s = 0; s < sides.size(); ++s) {
      if (sides[s].neighbour < 0 || sides[s].owner == rank) continue;
      const auto isSame = [&](const CellSet::Side& side) { return side.owner == sides[s].owner; };
      if (std::none_of(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(s), isSame)) sendTo(sides[s].owner);
    }
  });
  result.halo = std::move(seen.cells);
  for (std::size_t r = 0; r < ranks; ++r)
    result.haloOwner.resize(result.haloOwner.size() + static_cast<std::size_t>(seen.ofRank[r]), static_cast<int>(r));
  return result;
}

}  // namespace lampblack
