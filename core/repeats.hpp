// Independent repeats of a computation spread over ranks, repeat r to rank r modulo their number. What a repeat leaves
// is a row of numbers; rows come back in the order of the repeats, so that nothing made of them depends on the ranks.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack {

// Fills the row of a repeat. May not communicate.
using RunRepeat = std::function<void(std::uint64_t repeat, std::span<double> row)>;

// Collective. Runs the repeats from `first` to before `end`, each leaving `width` numbers. Returns the rows one after
// another on rank 0, nothing on the others. What fails on any rank is raised on all (collectively()).
[[nodiscard]] std::vector<double> gatherRepeats(MPI_Comm comm, std::uint64_t first, std::uint64_t end,
                                                std::size_t width, const RunRepeat& run);

// Collective. Gives the rows that rank 0 has gathered, so many numbers, to all ranks.
void shareRepeats(MPI_Comm comm, std::vector<double>& rows, std::size_t size);

// Collective. How many repeats of this width to gather at a time, so that their rows take no more than 128 MB: at
// least one for each rank, and as many for each.
[[nodiscard]] std::uint64_t repeatsAtATime(MPI_Comm comm, std::size_t width);

}  // namespace lampblack
