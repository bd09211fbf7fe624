// A cell field in natural order on every rank, for tests that compare whole fields.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Collective. `values`: `components` a cell, owned cells first. Returns totalCells * components values in natural
// order, the same on every rank.
inline std::vector<double> gatherNatural(const Mesh& mesh, std::span<const double> values, int components) {
  const auto ranks = static_cast<std::size_t>(mesh.ranks);
  std::vector<int> cells(ranks);
  std::vector<int> start(ranks, 0);
  MPI_Allgather(&mesh.owned, 1, MPI_INT, cells.data(), 1, MPI_INT, mesh.comm);
  std::exclusive_scan(cells.begin(), cells.end(), start.begin(), 0);
  std::vector<std::int64_t> natural(static_cast<std::size_t>(mesh.totalCells));
  MPI_Allgatherv(mesh.naturalCell.data(), mesh.owned, MPI_INT64_T, natural.data(), cells.data(), start.data(),
                 MPI_INT64_T, mesh.comm);
  for (std::size_t r = 0; r < ranks; ++r) {
    cells[r] *= components;
    start[r] *= components;
  }
  std::vector<double> byRank(static_cast<std::size_t>(mesh.totalCells) * components);
  MPI_Allgatherv(values.data(), mesh.owned * components, MPI_DOUBLE, byRank.data(), cells.data(), start.data(),
                 MPI_DOUBLE, mesh.comm);
  std::vector<double> ordered(byRank.size());
  for (std::size_t i = 0; i < natural.size(); ++i)
    std::copy_n(&byRank[i * components], components, &ordered[static_cast<std::size_t>(natural[i]) * components]);
  return ordered;
}

}  // namespace lampblack::test
