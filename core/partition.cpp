#include "core/partition.hpp"

#include <fmt/format.h>
#include <petscconf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/hilbert.hpp"
#include "core/partition_graph.hpp"
#include "core/ranks.hpp"

namespace lampblack {
namespace {

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
std::vector<std::uint64_t> cutCurve(MPI_Comm comm, const std::vector<std::uint64_t>& keys,
                                    const std::vector<double>& weight) {
  const int ranks = ranksOf(comm);
  struct Cell {
    std::uint64_t key;
    double before;  // weight of the cells up to it
  };
  std::vector<Cell> sorted;
  sorted.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) sorted.push_back({keys[i], weight[i]});
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

std::vector<int> piecesOf(MPI_Comm comm, const std::vector<std::uint64_t>& keys, const std::vector<double>& weight) {
  const std::vector<std::uint64_t> cuts = cutCurve(comm, keys, weight);
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

// Weights of the cells, their sum above zero.
std::vector<double> weightsOf(MPI_Comm comm, const CellSet& cells, std::span<const double> weight) {
  double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  if (!(sum > 0.0) || !std::isfinite(sum)) return std::vector<double>(cells.size(), 1.0);
  return {weight.begin(), weight.end()};
}

}  // namespace

bool isThere(Partitioner partitioner) {
#ifdef PETSC_HAVE_PTSCOTCH
  static_cast<void>(partitioner);
  return true;
#else
  return partitioner != Partitioner::PtScotch;
#endif
}

std::vector<int> ownersOf(MPI_Comm comm, const CellSet& cells, int dimension, const Partition& partition) {
  auto total = static_cast<std::int64_t>(cells.size());
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, comm);
  // Known to all, so raised on all together.
  collectively(comm, [&] {
    if (total < ranksOf(comm))
      throw InputError(
          fmt::format("the mesh has {} cells, fewer than the {} ranks it is to be spread over", total, ranksOf(comm)));
  });
  if (ranksOf(comm) == 1) return std::vector<int>(cells.size(), 0);
  std::vector<double> weight = weightsOf(comm, cells, partition.weight);
  if (partition.by != Partitioner::Curve) {
    const auto parts = partition.by == Partitioner::Metis ? metisParts : ptScotchParts;
    std::vector<int> owner = parts(comm, cells, weight);
    if (hasEveryRankCells(comm, owner)) return owner;
  }
  const std::vector<std::uint64_t> keys = keysOf(comm, cells, dimension);
  std::vector<int> owner = piecesOf(comm, keys, weight);
  if (hasEveryRankCells(comm, owner)) return owner;
  // One cell may outweigh all others: no rank goes without even so, by a weight that every cell has.
  double mean = std::accumulate(weight.begin(), weight.end(), 0.0);
  MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, comm);
  mean /= static_cast<double>(total);
  for (double& w : weight) w += mean;
  owner = piecesOf(comm, keys, weight);
  if (hasEveryRankCells(comm, owner)) return owner;
  return piecesOf(comm, keys, std::vector<double>(cells.size(), 1.0));
}

}  // namespace lampblack
