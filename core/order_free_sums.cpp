#include "core/order_free_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace lampblack {

std::vector<double> orderFreeSums(MPI_Comm comm, std::size_t places, std::span<const PlacedValue> values) {
  std::vector<double> largest(places, 0.0), sums(places, 0.0);
  for (const PlacedValue& v : values) {
    if (!std::isfinite(v.value)) throw std::logic_error("a value to be summed is not finite");
    largest.at(v.place) = std::max(largest.at(v.place), std::abs(v.value));
  }
  auto count = static_cast<std::uint64_t>(values.size());
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_UINT64_T, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(places), MPI_DOUBLE, MPI_MAX, comm);
  const int bits = 62 - static_cast<int>(std::bit_width(count));  // of one value, so that all together fit
  std::vector<int> exponent(places, 0);                           // of the unit of a place
  for (std::size_t p = 0; p < places; ++p)
    if (largest[p] > 0.0) exponent[p] = std::ilogb(largest[p]) + 1 - bits;
  std::vector<std::int64_t> multiples(places, 0);
  for (const PlacedValue& v : values) multiples[v.place] += std::llrint(std::scalbn(v.value, -exponent[v.place]));
  MPI_Allreduce(MPI_IN_PLACE, multiples.data(), static_cast<int>(places), MPI_INT64_T, MPI_SUM, comm);
  for (std::size_t p = 0; p < places; ++p) sums[p] = std::scalbn(static_cast<double>(multiples[p]), exponent[p]);
  return sums;
}

}  // namespace lampblack
