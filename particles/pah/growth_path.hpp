// The gas along a path as molecules see it: a row of times over which all rates stay as they are, the same for each
// molecule. Intervals between samples of the gas are halved until no rate changes by more than a part of itself from
// one end to the other; rates are those of the middle. Rates so small that nothing comes of them on the whole path may
// change by more.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/pah/pah_rates.hpp"

namespace lampblack::particles {

struct GrowthInterval {
  double duration = 0;  // s
  PahRates rates{};
};

struct GrowthPath {
  std::vector<GrowthInterval> intervals;
  std::vector<std::size_t> records;  // how many of them there are before each point that is recorded
};

// `recorded`: points of the path, rising. `rateChange`: the largest part, above zero. The processes that are not in
// `active` have no rate. NumericsError as pahRates().
[[nodiscard]] GrowthPath growthPath(const ParticlePath& path, const std::vector<std::size_t>& recorded,
                                    const PahRateConstants& constants, const std::array<bool, pahProcessCount>& active,
                                    double rateChange);

}  // namespace lampblack::particles
