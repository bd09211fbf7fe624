#include "core/repeats.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr std::size_t mostGathered = std::size_t{1} << 24;  // numbers
constexpr std::size_t mostInMessage = std::size_t{1} << 28;
constexpr int repeatTag = 0;

struct RanksOf {
  explicit RanksOf(MPI_Comm comm) {
    MPI_Comm_rank(comm, &own);
    MPI_Comm_size(comm, &count);
  }
  [[nodiscard]] int of(std::uint64_t repeat) const {
    return static_cast<int>(repeat % static_cast<std::uint64_t>(count));
  }
  int own = 0, count = 1;
};

// In portions that MPI can count. `transfer(begin, count)` sends or receives.
template <class Transfer>
void inPortions(std::span<double> row, const Transfer& transfer) {
  for (std::size_t at = 0; at < row.size(); at += mostInMessage)
    transfer(row.data() + at, static_cast<int>(std::min(mostInMessage, row.size() - at)));
}

}  // namespace

std::vector<double> gatherRepeats(MPI_Comm comm, std::uint64_t first, std::uint64_t end, std::size_t width,
                                  const RunRepeat& run) {
  const RanksOf ranks(comm);
  std::vector<double> rows;
  collectively(comm, [&] {
    for (std::uint64_t repeat = first; repeat < end; ++repeat) {
      const bool isOwn = ranks.of(repeat) == ranks.own;
      if (isOwn || ranks.own == 0) rows.resize(rows.size() + width);
      if (isOwn) run(repeat, std::span(rows).last(width));
    }
  });
  // Every rank sends in the order in which the first receives.
  std::size_t place = 0;
  for (std::uint64_t repeat = first; repeat < end; ++repeat) {
    const int owner = ranks.of(repeat);
    if (ranks.own != 0 && owner != ranks.own) continue;
    const std::span<double> row = std::span(rows).subspan(place, width);
    place += width;
    if (owner == 0) continue;
    inPortions(row, [&](double* values, int count) {
      if (ranks.own == 0)
        MPI_Recv(values, count, MPI_DOUBLE, owner, repeatTag, comm, MPI_STATUS_IGNORE);
      else
        MPI_Send(values, count, MPI_DOUBLE, 0, repeatTag, comm);
    });
  }
  return ranks.own == 0 ? rows : std::vector<double>{};
}

void shareRepeats(MPI_Comm comm, std::vector<double>& rows, std::size_t size) {
  rows.resize(size);
  inPortions(rows, [&](double* values, int count) { MPI_Bcast(values, count, MPI_DOUBLE, 0, comm); });
}

std::uint64_t repeatsAtATime(MPI_Comm comm, std::size_t width) {
  const auto ranks = static_cast<std::uint64_t>(RanksOf(comm).count);
  return std::max<std::uint64_t>(mostGathered / std::max<std::size_t>(width, 1) / ranks, 1) * ranks;
}

}  // namespace lampblack
