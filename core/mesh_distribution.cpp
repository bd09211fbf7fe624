#include "core/mesh_distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/hilbert.hpp"
#include "core/rank_exchange.hpp"
#include "core/shares.hpp"

namespace lampblack {
namespace {

int rankIn(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int ranksOf(MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  return ranks;
}

std::array<double, 3> middleOf(std::span<const std::array<double, 3>> corners) {
  std::array<double, 3> sum{};
  for (const auto& corner : corners)
    for (std::size_t i = 0; i < 3; ++i) sum[i] += corner[i];
  for (double& x : sum) x /= static_cast<double>(corners.size());
  return sum;
}

// Place of each cell along the curve through the mesh's bounding box.
std::vector<std::uint64_t> keysOf(MPI_Comm comm, const CellSet& cells, int dimension) {
  constexpr double most = std::numeric_limits<double>::max();
  std::array<double, 6> ends{most, most, most, most, most, most};  // lowest, and highest with the other sign
  for (const auto& place : cells.places)
    for (std::size_t i = 0; i < 3; ++i) {
      ends[i] = std::min(ends[i], place[i]);
      ends[3 + i] = std::min(ends[3 + i], -place[i]);
    }
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 6, MPI_DOUBLE, MPI_MIN, comm);
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) size = std::max(size, -ends[3 + i] - ends[i]);
  std::vector<std::uint64_t> keys;
  keys.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::array<double, 3> place = middleOf(cells.placesOf(c));
    for (std::size_t i = 0; i < 3; ++i) place[i] = (place[i] - ends[i]) / size;
    keys.push_back(hilbertIndex(place, dimension));
  }
  return keys;
}

// Where the curve is cut: cells from the key of cut r on belong to rank r + 1 or later.
template <typename Weight>
std::vector<std::uint64_t> cutCurve(MPI_Comm comm, const std::vector<std::uint64_t>& keys, const Weight& weightOf) {
  const int ranks = ranksOf(comm);
  struct Cell {
    std::uint64_t key;
    double before;  // weight of the cells up to it
  };
  std::vector<Cell> sorted;
  sorted.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) sorted.push_back({keys[i], weightOf(i)});
  std::ranges::sort(sorted, {}, &Cell::key);
  double total = 0.0;
  for (Cell& cell : sorted) cell.before = std::exchange(total, total + cell.before);
  const double all = total;
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, comm);
  // The smallest key below which there is at least the wanted weight, for all cuts at once, by halving.
  std::vector<std::uint64_t> low(static_cast<std::size_t>(ranks - 1), 0), high(low.size(), std::uint64_t{1} << 63);
  std::vector<double> below(low.size());
  for (int round = 0; round < 64; ++round) {
    for (std::size_t r = 0; r < low.size(); ++r) {
      const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
      const auto end = std::ranges::lower_bound(sorted, middle, {}, &Cell::key);
      below[r] = end == sorted.end() ? all : end->before;
    }
    MPI_Allreduce(MPI_IN_PLACE, below.data(), ranks - 1, MPI_DOUBLE, MPI_SUM, comm);
    for (std::size_t r = 0; r < low.size(); ++r) {
      const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
      // Rounded to the nearest cell: half of one may be missing.
      (below[r] >= total * static_cast<double>(r + 1) / ranks ? high[r] : low[r]) = middle;
    }
  }
  return high;
}

std::vector<int> ownersBy(const std::vector<std::uint64_t>& keys, const std::vector<std::uint64_t>& cuts) {
  std::vector<int> owner;
  owner.reserve(keys.size());
  for (const std::uint64_t key : keys)
    owner.push_back(static_cast<int>(std::ranges::upper_bound(cuts, key) - cuts.begin()));
  return owner;
}

bool hasEveryRankCells(MPI_Comm comm, const std::vector<int>& owner) {
  std::vector<std::int64_t> count(static_cast<std::size_t>(ranksOf(comm)), 0);
  for (const int rank : owner) ++count[static_cast<std::size_t>(rank)];
  MPI_Allreduce(MPI_IN_PLACE, count.data(), static_cast<int>(count.size()), MPI_INT64_T, MPI_SUM, comm);
  return std::ranges::all_of(count, [](std::int64_t n) { return n > 0; });
}

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

std::vector<int> partitionAlongCurve(MPI_Comm comm, const CellSet& cells, int dimension,
                                     std::span<const double> weight) {
  const int ranks = ranksOf(comm);
  auto total = static_cast<std::int64_t>(cells.size());
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, comm);
  if (total < ranks) {
    // Known to all, so raised on all together.
    collectively(comm, [&] {
      throw InputError(
          fmt::format("the mesh has {} cells, fewer than the {} ranks it is to be spread over", total, ranks));
    });
  }
  if (ranks == 1) return std::vector<int>(cells.size(), 0);
  const std::vector<std::uint64_t> keys = keysOf(comm, cells, dimension);
  double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  if (sum > 0.0 && std::isfinite(sum)) {
    // One cell may outweigh all others: no rank goes without even so, by a weight that every cell has.
    const double mean = sum / static_cast<double>(total);
    for (const double share : {0.0, 1.0}) {
      const auto more = [&](std::size_t cell) { return weight[cell] + share * mean; };
      std::vector<int> owner = ownersBy(keys, cutCurve(comm, keys, more));
      if (hasEveryRankCells(comm, owner)) return owner;
    }
  }
  return ownersBy(keys, cutCurve(comm, keys, [](std::size_t) { return 1.0; }));
}

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
