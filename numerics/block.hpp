// Eight doubles, one cache line, as a value: the unit of work of our linear algebra. The compiler maps it to the widest
// registers the processor has.
#pragma once

#include <cstddef>

#include "core/modules.hpp"

namespace lampblack::numerics {

constexpr std::size_t kBlockWidth = 8;

// NOLINTNEXTLINE(modernize-use-using): GCC applies these attributes to a typedef only
typedef double Block __attribute__((vector_size(kBlockWidth * sizeof(double)), may_alias));

// The block at p, which is aligned to a cache line.
inline Block& blockAt(double* p) {
  return *reinterpret_cast<Block*>(p);
}
inline const Block& blockAt(const double* p) {
  return *reinterpret_cast<const Block*>(p);
}

constexpr std::size_t wholeBlocks(std::size_t n) {
  return (n + kBlockWidth - 1) / kBlockWidth * kBlockWidth;
}

}  // namespace lampblack::numerics
