#include "core/mesh_distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/errors.hpp"
#include "core/hilbert.hpp"
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
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::array<double, 3> place = middleOf(cells.placesOf(c));
    for (std::size_t i = 0; i < 3; ++i) place[i] = (place[i] - ends[i]) / size;
    keys.push_back(hilbertIndex(place, dimension));
  }
  return keys;
}

// Where the curve is cut: cells from the key of cut r on belong to rank r + 1 or later.
std::vector<std::uint64_t> cutCurve(MPI_Comm comm, const std::vector<std::uint64_t>& keys,
                                    const std::vector<double>& weight) {
  const int ranks = ranksOf(comm);
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<std::uint64_t> sorted;
  std::vector<double> before{0.0};  // weight of the cells up to each
  for (const std::size_t i : order) {
    sorted.push_back(keys[i]);
    before.push_back(before.back() + weight[i]);
  }
  double total = before.back();
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, comm);
  // The smallest key below which there is at least the wanted weight, for all cuts at once, by halving.
  std::vector<std::uint64_t> low(static_cast<std::size_t>(ranks - 1), 0), high(low.size(), std::uint64_t{1} << 63);
  std::vector<double> below(low.size());
  for (int round = 0; round < 64; ++round) {
    for (std::size_t r = 0; r < low.size(); ++r) {
      const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
      const auto end = std::ranges::lower_bound(sorted, middle) - sorted.begin();
      below[r] = before[static_cast<std::size_t>(end)];
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
  const std::vector<double> equal(cells.size(), 1.0);
  double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  if (sum > 0.0 && std::isfinite(sum)) {
    // One cell may outweigh all others: no rank goes without even so, by a weight that every cell has.
    const double mean = sum / static_cast<double>(total);
    for (const double share : {0.0, 1.0}) {
      std::vector<double> own(weight.begin(), weight.end());
      for (double& w : own) w += share * mean;
      const std::vector<int> owner = ownersBy(keys, cutCurve(comm, keys, own));
      if (hasEveryRankCells(comm, owner)) return owner;
    }
  }
  return ownersBy(keys, cutCurve(comm, keys, equal));
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

  const auto move = [&](const CellSet& from, auto&& eachRankOf) {
    std::vector<std::vector<std::int64_t>> messages(ranks);
    for (std::size_t c = 0; c < from.size(); ++c)
      eachRankOf(c, [&](int to) { from.pack(c, messages[static_cast<std::size_t>(to)]); });
    return sendToRanks(comm, messages);
  };
  DistributedCells result;
  {
    const auto arrived = move(cells, [&](std::size_t c, auto&& sendTo) { sendTo(owner[c]); });
    cells = {};
    CellSet unordered;
    unordered.unpack(arrived.values);
    std::vector<std::size_t> order(unordered.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto byNumber = [&](std::size_t a, std::size_t b) { return unordered.numbers[a] < unordered.numbers[b]; };
    if (!std::ranges::is_sorted(order, byNumber)) std::ranges::sort(order, byNumber);
    result.owned = reordered(unordered, order);
  }
  const auto seen = move(result.owned, [&](std::size_t c, auto&& sendTo) {
    std::vector<int> to;
    for (const CellSet::Side& side : result.owned.sidesOf(c))
      if (side.neighbour >= 0 && side.owner != rank && std::ranges::find(to, side.owner) == to.end())
        to.push_back(side.owner);
    for (const int r : to) sendTo(r);
  });
  for (std::size_t r = 0; r < ranks; ++r) {
    const std::size_t before = result.halo.size();
    result.halo.unpack({seen.values.data() + seen.start[r], seen.start[r + 1] - seen.start[r]});
    result.haloOwner.resize(result.haloOwner.size() + result.halo.size() - before, static_cast<int>(r));
  }
  return result;
}

}  // namespace lampblack
