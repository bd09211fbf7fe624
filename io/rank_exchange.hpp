// Values that travel to other ranks, and answers that travel back. Who sends how much to whom is found once; every
// exchange afterwards is a single MPI_Alltoallv.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/rooms.hpp"

namespace lampblack::io {

class RankExchange {
 public:
  // Collective. The rank that each of this rank's items goes to.
  RankExchange(MPI_Comm comm, std::span<const int> destinations);

  [[nodiscard]] std::size_t items() const { return order_.size(); }  // of this rank
  [[nodiscard]] std::size_t received() const { return received_; }   // items that came from all ranks

  // Collective. `values`: `width` for each of this rank's items. Returns those that came here, by the rank they came
  // from, and in its order.
  [[nodiscard]] std::vector<double> there(std::span<const double> values, int width) const;
  [[nodiscard]] std::vector<std::int64_t> there(std::span<const std::int64_t> values, int width) const;
  // Collective. `values`: `width` for each item that came here. Returns those for this rank's items.
  [[nodiscard]] std::vector<double> back(std::span<const double> values, int width) const;
  [[nodiscard]] std::vector<std::int64_t> back(std::span<const std::int64_t> values, int width) const;

 private:
  template <typename T>
  std::vector<T> send(std::span<const T> values, int width, MPI_Datatype type) const;
  template <typename T>
  std::vector<T> answer(std::span<const T> values, int width, MPI_Datatype type) const;

  MPI_Comm comm_;
  std::size_t received_ = 0;
  std::vector<std::size_t> order_;  // this rank's items sorted by the rank they go to
  std::vector<int> sendCounts_;     // items to each rank
  std::vector<int> receiveCounts_;  // items from each rank
};

}  // namespace lampblack::io
