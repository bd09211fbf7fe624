// The convective time step of a state, and the time that the flow takes through the domain.
#pragma once

#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// Collective. The largest step (s) at which in no cell the volume that flows out exceeds `courant` of the cell's; with
// no flow at all, infinity.
double convectiveTimeStep(const Mesh& mesh, const State& state, double courant);

// Collective. What is in the domain over what comes in through its boundaries, s; infinity where nothing does.
double residenceTime(const Mesh& mesh, const State& state);

}  // namespace lampblack::flow
