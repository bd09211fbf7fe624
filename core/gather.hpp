// What every rank has, on every rank.
#pragma once

#include <mpi.h>

#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

namespace lampblack {

// Collective. The values of all ranks, one rank's behind the other's.
template <typename Value>
requires std::is_trivially_copyable_v<Value> std::vector<Value> gatheredFromAll(MPI_Comm comm,
                                                                                std::span<const Value> own) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> counts(static_cast<std::size_t>(ranks)), starts(counts.size(), 0);
  const int bytes = static_cast<int>(own.size_bytes());
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<Value> all(static_cast<std::size_t>(starts.back() + counts.back()) / sizeof(Value));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  return all;
}

}  // namespace lampblack
