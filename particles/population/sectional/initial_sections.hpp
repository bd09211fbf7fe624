// The population at time zero in sections: of each interval between pivots exactly its number and its volume, divided
// between its two ends. What lies beyond the last pivot goes to the unknowns that count it.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "particles/population/sectional/section_grid.hpp"

namespace lampblack::particles {

// All unknowns of the grid's layout. Throws InputError where the population does not fit the grid: all of one volume
// outside of it, or more than options.overflow of the volume beyond its end.
[[nodiscard]] std::vector<double> initialSections(const SectionGrid& grid, const InitialPopulation& initial,
                                                  double overflow);

}  // namespace lampblack::particles
