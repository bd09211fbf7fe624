// The species of a mechanism that ensembles see and exchange.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::coupling {

// Of sootSpecies(), in its order. InputError where the mechanism lacks one.
[[nodiscard]] std::vector<std::size_t> indicesOfSootSpecies(const Mechanism& mechanism,
                                                            const SootModelOptions& options);

}  // namespace lampblack::coupling
