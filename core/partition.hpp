// Splits a graph into parts of equal weight with METIS (Karypis and Kumar 1998); a graph of fewer than eight vertices a
// part is split in vertex order.
#pragma once

#include <cstdint>
#include <vector>

namespace lampblack {

// Part of each vertex of a graph in compressed rows (`start`, `neighbours`), vertices weighted by `weight` (empty:
// equal; otherwise zero or more, on any scale). Every part gets at least one vertex. Deterministic. InputError when
// there are fewer vertices than parts, NumericsError if METIS fails.
std::vector<int> partitionGraph(const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& neighbours,
                                const std::vector<double>& weight, int parts);

}  // namespace lampblack
