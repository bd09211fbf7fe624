// What a flow deck asks of the machine, estimated before anything is made: memory of the mesh and of the trajectories,
// the size of what is written.
#pragma once

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

// InputError where no mesh of so many cells fits.
void requireCells(const Deck& deck, double cells, std::size_t species);

// InputError where the outputs, the history or the trajectories of a case that was read are too many.
void refuseExcess(const Deck& deck, const FlowCase& flowCase, double cells);

}  // namespace lampblack::app
