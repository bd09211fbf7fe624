// Sizes of the particles of an Ensemble, as they are packed.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/stochastic/row_sizes.hpp"

namespace lampblack::test {

// dN/dlog10(d), 1/m3, by mobility diameter.
[[nodiscard]] inline std::vector<double> sizesOf(const particles::Ensemble& soot, const particles::SizeBins& bins) {
  std::vector<double> density(bins.count);
  particles::addSizes({particles::sootAggregate(soot.options()), {particles::packedHead, false}}, bins, soot.pack(),
                      density);
  return density;
}

}  // namespace lampblack::test
