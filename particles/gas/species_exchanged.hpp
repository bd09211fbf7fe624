// Which species of the gas a process of particles takes and which it gives back, by their places in the gas that the
// particles see.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

struct SpeciesExchanged {
  std::vector<std::size_t> takes, gives;
};

}  // namespace lampblack::particles
