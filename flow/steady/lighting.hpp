// Lights what is mixed and cold: what a spark everywhere would make of a flow whose flame was not lit, or has been
// blown out.
#pragma once

#include <cstdint>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// K, by how much burning has to heat the mixture of a cell: less burns in no flame.
constexpr double leastRiseOfLighting = 500.0;

// Burns the mixture of each cell (BurntMixture, to 2200 K at most) that this heats by leastRiseOfLighting or more;
// velocities stay, and carried scalars per kg. The halo is updated. Returned is the number of cells that were lit, of
// all ranks. Collective.
std::int64_t lightMixture(const FlowContext& context, State& state);

// Whether a mixture of any two of the gases that inlets and outlets are given, and of the mean gas of the domain,
// burns to one that is hotter by leastRiseOfLighting or more. Collective.
bool couldBurn(const FlowContext& context, const State& state);

}  // namespace lampblack::flow
