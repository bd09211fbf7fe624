// Four whole numbers of 32 bits that are computed with at once, as Lanes of doubles are (lanes.hpp).
#pragma once

#include <cstdint>
#include <cstring>

#include "core/modules.hpp"

namespace lampblack::numerics {

// GCC and Clang: +, - and comparisons work by element, a scalar operand counts for all; what holds is -1, else 0.
using IndexLanes = std::int32_t __attribute__((vector_size(16)));

// From, and to, any place in memory.
inline IndexLanes loadIndices(const void* from) {
  IndexLanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void storeIndices(void* to, const IndexLanes& v) {
  std::memcpy(to, &v, sizeof v);
}

}  // namespace lampblack::numerics
