#include "core/partition_graph.hpp"

#include <fmt/format.h>
#include <metis.h>
#include <petscmat.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/gather.hpp"
#include "core/petsc.hpp"
#include "core/ranks.hpp"
#include "core/shares.hpp"

namespace lampblack {
namespace {

using PetscPartitioning = PetscOwner<MatPartitioning, MatPartitioningDestroy>;
using PetscIndices = PetscOwner<IS, ISDestroy>;

// The number of other cells that each cell meets, and theirs, cell after cell.
struct Rows {
  std::vector<std::int32_t> length;
  std::vector<std::int64_t> neighbour;
};

Rows rowsOf(const CellSet& cells) {
  Rows rows;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::size_t before = rows.neighbour.size();
    for (const CellSet::Side& side : cells.sidesOf(c))
      if (side.neighbour >= 0) rows.neighbour.push_back(side.neighbour);
    rows.length.push_back(static_cast<std::int32_t>(rows.neighbour.size() - before));
  }
  return rows;
}

// Partitioners count in whole numbers: of mean 1000 where their sum stays within 2^30.
template <typename Integer>
std::vector<Integer> wholeWeights(MPI_Comm comm, const std::vector<double>& weight) {
  std::array<double, 2> sums{std::accumulate(weight.begin(), weight.end(), 0.0), static_cast<double>(weight.size())};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
  const double scale = std::min(1000.0 * sums[1], 0x1p30) / sums[0];
  std::vector<Integer> whole;
  for (const double w : weight) whole.push_back(std::max<Integer>(1, static_cast<Integer>(std::lround(w * scale))));
  return whole;
}

// The parts of all cells.
std::vector<int> metisOnOneRank(int parts, const std::vector<std::int32_t>& length,
                                const std::vector<std::int64_t>& neighbour, std::vector<idx_t> weight) {
  if (neighbour.size() > static_cast<std::size_t>(IDX_MAX))
    throw NumericsError(
        fmt::format("METIS counts to {} here, the cells of the mesh have {} neighbours in all; choose "
                    "another partitioner, curve or ptscotch",
                    IDX_MAX, neighbour.size()));
  std::vector<idx_t> start{0}, adjacency(neighbour.begin(), neighbour.end()), part(length.size(), 0);
  for (const std::int32_t n : length) start.push_back(start.back() + static_cast<idx_t>(n));
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  idx_t vertices = static_cast<idx_t>(length.size()), constraints = 1, wanted = parts, cut = 0;
  const int outcome =
      METIS_PartGraphRecursive(&vertices, &constraints, start.data(), adjacency.data(), weight.data(), nullptr, nullptr,
                               &wanted, nullptr, nullptr, options.data(), &cut, part.data());
  if (outcome != METIS_OK)
    throw NumericsError(
        fmt::format("METIS failed with code {}; choose another partitioner, curve or ptscotch", outcome));
  return {part.begin(), part.end()};
}

}  // namespace

std::vector<int> metisParts(MPI_Comm comm, const CellSet& cells, const std::vector<double>& weight) {
  Rows own = rowsOf(cells);
  const Received<std::int32_t> length = gatheredOnFirst(comm, std::move(own.length));
  const Received<std::int64_t> neighbour = gatheredOnFirst(comm, std::move(own.neighbour));
  const Received<idx_t> whole = gatheredOnFirst(comm, wholeWeights<idx_t>(comm, weight));
  std::vector<std::vector<int>> toRank(static_cast<std::size_t>(ranksOf(comm)));
  collectively(comm, [&] {
    if (length.values.empty()) return;
    const std::vector<int> part = metisOnOneRank(ranksOf(comm), length.values, neighbour.values, whole.values);
    for (std::size_t r = 0; r < toRank.size(); ++r)
      toRank[r].assign(part.begin() + static_cast<std::ptrdiff_t>(length.start[r]),
                       part.begin() + static_cast<std::ptrdiff_t>(length.start[r + 1]));
  });
  return sendToRanks(comm, toRank).values;
}

std::vector<int> ptScotchParts(MPI_Comm comm, const CellSet& cells, const std::vector<double>& weight) {
  const Rows own = rowsOf(cells);
  const std::vector<PetscInt> whole = wholeWeights<PetscInt>(comm, weight);
  auto total = static_cast<std::int64_t>(cells.size());
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, comm);
  // These arrays pass to PETSc.
  PetscInt *start = nullptr, *neighbours = nullptr, *weights = nullptr;
  checkPetsc(PetscMalloc1(own.length.size() + 1, &start));
  checkPetsc(PetscMalloc1(own.neighbour.size() + 1, &neighbours));
  checkPetsc(PetscMalloc1(whole.size() + 1, &weights));
  start[0] = 0;
  std::partial_sum(own.length.begin(), own.length.end(), start + 1);
  std::ranges::copy(own.neighbour, neighbours);
  std::ranges::copy(whole, weights);
  PetscMatrix graph;
  checkPetsc(MatCreateMPIAdj(comm, static_cast<PetscInt>(cells.size()), static_cast<PetscInt>(total), start, neighbours,
                             nullptr, graph.put()));
  PetscPartitioning partitioning;
  checkPetsc(MatPartitioningCreate(comm, partitioning.put()));
  checkPetsc(MatPartitioningSetAdjacency(partitioning.get(), graph.get()));
  checkPetsc(MatPartitioningSetType(partitioning.get(), MATPARTITIONINGPTSCOTCH));
  checkPetsc(MatPartitioningSetVertexWeights(partitioning.get(), weights));
  PetscIndices parts;
  checkPetsc(MatPartitioningApply(partitioning.get(), parts.put()));
  const PetscInt* part = nullptr;
  checkPetsc(ISGetIndices(parts.get(), &part));
  std::vector<int> owner(part, part + cells.size());
  checkPetsc(ISRestoreIndices(parts.get(), &part));
  return owner;
}

}  // namespace lampblack
