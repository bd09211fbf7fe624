#include "core/shares.hpp"

#include <algorithm>

namespace lampblack {
namespace {

// MPI counts are ints: longer messages go in pieces of this size.
constexpr std::size_t piece = std::size_t{1} << 30;

}  // namespace

Shares::Shares(std::int64_t total, int ranks) {
  // Without total * rank, which may be more than there are integers.
  const std::int64_t each = total / ranks, more = total % ranks;
  for (std::int64_t r = 0; r <= ranks; ++r) start_.push_back(each * r + more * r / ranks);
}

Shares::Shares(MPI_Comm comm, std::int64_t first, std::int64_t total) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  start_.resize(static_cast<std::size_t>(ranks) + 1);
  MPI_Allgather(&first, 1, MPI_INT64_T, start_.data(), 1, MPI_INT64_T, comm);
  start_.back() = total;
  if (start_.front() != 0 || !std::ranges::is_sorted(start_))
    throw std::logic_error("Shares: the ranks' shares do not follow one another");
}

int Shares::rankOf(std::int64_t number) const {
  const auto next = std::upper_bound(start_.begin(), start_.end(), number);
  return static_cast<int>(next - start_.begin()) - 1;
}

void detail::exchangeBytes(MPI_Comm comm, const std::vector<std::pair<const char*, std::size_t>>& sent,
                           std::vector<std::size_t>& receivedBytes, const std::vector<char*>* into) {
  int ranks = 1, rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  const auto n = static_cast<std::size_t>(ranks);
  if (into == nullptr) {
    std::vector<std::int64_t> out(n), in(n);
    std::ranges::transform(sent, out.begin(), [](const auto& part) { return static_cast<std::int64_t>(part.second); });
    MPI_Alltoall(out.data(), 1, MPI_INT64_T, in.data(), 1, MPI_INT64_T, comm);
    receivedBytes.assign(in.begin(), in.end());
    return;
  }
  constexpr int tag = 12;
  std::vector<MPI_Request> requests;
  const auto inPieces = [&](std::size_t bytes, auto&& pass) {
    for (std::size_t done = 0; done < bytes; done += piece) {
      requests.emplace_back();
      pass(done, static_cast<int>(std::min(piece, bytes - done)));
    }
  };
  for (std::size_t r = 0; r < n; ++r) {
    if (static_cast<int>(r) == rank) continue;
    inPieces(receivedBytes[r], [&](std::size_t from, int count) {
      MPI_Irecv((*into)[r] + from, count, MPI_BYTE, static_cast<int>(r), tag, comm, &requests.back());
    });
  }
  for (std::size_t r = 0; r < n; ++r) {
    if (static_cast<int>(r) == rank) {
      if (sent[r].second > 0) std::memcpy((*into)[r], sent[r].first, sent[r].second);
      continue;
    }
    inPieces(sent[r].second, [&](std::size_t from, int count) {
      MPI_Isend(sent[r].first + from, count, MPI_BYTE, static_cast<int>(r), tag, comm, &requests.back());
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace lampblack
