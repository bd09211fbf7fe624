// What every rank has, on every rank or on the first.
#pragma once

#include <mpi.h>

#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/ranks.hpp"
#include "core/shares.hpp"

namespace lampblack {

// Collective. The values of all ranks, one rank's behind the other's.
template <typename Value>
requires std::is_trivially_copyable_v<Value> std::vector<Value> gatheredFromAll(MPI_Comm comm,
                                                                                std::span<const Value> own) {
  std::vector<int> counts(static_cast<std::size_t>(ranksOf(comm))), starts(counts.size(), 0);
  const int bytes = static_cast<int>(own.size_bytes());
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<Value> all(static_cast<std::size_t>(starts.back() + counts.back()) / sizeof(Value));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  return all;
}

// Collective. The same on the first rank, nothing on the others; of any length.
template <typename Value>
Received<Value> gatheredOnFirst(MPI_Comm comm, std::vector<Value> own) {
  std::vector<std::vector<Value>> toRank(static_cast<std::size_t>(ranksOf(comm)));
  toRank[0] = std::move(own);
  return sendToRanks(comm, toRank);
}

}  // namespace lampblack
