// Sums over all ranks that are the same to the last bit on any number of ranks, in whatever order the values come: each
// is rounded to a multiple of a small power of two, and multiples add up exactly.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lampblack {

struct PlacedValue {
  std::size_t place = 0;
  double value = 0.0;
};

// Collective. The sums of the values of each of the `places`, on all ranks. A value is rounded by at most 2^-62 of the
// largest of its place, times the number of all values. Values have to be finite (std::logic_error).
std::vector<double> orderFreeSums(MPI_Comm comm, std::size_t places, std::span<const PlacedValue> values);

}  // namespace lampblack
