// Rows of doubles of any lengths, one behind the other: as they are kept and as they travel between ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lampblack {

struct PackedRows {
  std::vector<std::int64_t> lengths;
  std::vector<double> values;  // as many as all lengths together

  void clear();  // its room stays
  void add(std::span<const double> row);
};

// The same rows in another order: the row `order[i]` in place i.
PackedRows gathered(const PackedRows& rows, std::span<const std::size_t> order);
// The way back: row i in the place `places[i]`. Each place is taken once (std::logic_error).
PackedRows scattered(const PackedRows& rows, std::span<const std::size_t> places);

}  // namespace lampblack
