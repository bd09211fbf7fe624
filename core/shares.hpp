// Numbers 0..total-1 cut into consecutive shares, one a rank, and messages between any ranks, for the set-up of what is
// spread over ranks. Memory here goes with a rank's own share and with the number of ranks, never with the total.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace lampblack {

class Shares {
 public:
  // Equal ones, as far as that goes.
  Shares(std::int64_t total, int ranks);
  // Collective. This rank's share begins at `first`; the ranks' follow one another, up to `total`.
  Shares(MPI_Comm comm, std::int64_t first, std::int64_t total);

  [[nodiscard]] std::int64_t total() const { return start_.back(); }
  [[nodiscard]] std::int64_t first(int rank) const { return start_[static_cast<std::size_t>(rank)]; }
  [[nodiscard]] std::int64_t count(int rank) const { return first(rank + 1) - first(rank); }
  // Rank whose share has the number, which lies in 0..total-1.
  [[nodiscard]] int rankOf(std::int64_t number) const;

 private:
  std::vector<std::int64_t> start_;
};

// What came from other ranks, one rank after the other.
template <typename T>
struct Received {
  std::vector<T> values;
  std::vector<std::size_t> start;  // of each rank's in `values`, and the end
};

namespace detail {
void exchangeBytes(MPI_Comm comm, const std::vector<std::pair<const char*, std::size_t>>& sent,
                   std::vector<std::size_t>& receivedBytes, const std::vector<char*>* into);
}

// Collective. Sends the values of `toRank` to each rank. As many messages as there are ranks to speak to.
template <typename T>
Received<T> sendToRanks(MPI_Comm comm, const std::vector<std::vector<T>>& toRank) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::pair<const char*, std::size_t>> sent;
  for (const auto& values : toRank)
    sent.emplace_back(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  std::vector<std::size_t> bytes;
  detail::exchangeBytes(comm, sent, bytes, nullptr);
  Received<T> received;
  received.start.push_back(0);
  for (const std::size_t count : bytes) received.start.push_back(received.start.back() + count / sizeof(T));
  received.values.resize(received.start.back());
  std::vector<char*> into;
  for (std::size_t r = 0; r < bytes.size(); ++r)
    into.push_back(reinterpret_cast<char*>(received.values.data() + received.start[r]));
  detail::exchangeBytes(comm, sent, bytes, &into);
  return received;
}

}  // namespace lampblack
