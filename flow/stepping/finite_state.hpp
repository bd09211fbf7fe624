// Whether a state has become something else than numbers, and where; and where time stands still.
#pragma once

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// Whether all values of this rank's own cells, and of its faces, are finite.
bool isFinite(const Mesh& mesh, const State& state);

// Collective. NumericsError on all ranks, where any has a value that is not finite: field and place of the cell with
// the smallest natural number. Reads everything again: for a state that isFinite() has found fault with.
void raiseNotFinite(const FlowContext& context, const State& state);

// Collective. NumericsError on all ranks, for a step of `dt` (s) that is too short to get anywhere: with the cell where
// the gas is fastest against its cell's size, which is what steps become short by.
[[noreturn]] void raiseStandstill(const Mesh& mesh, const State& state, double dt);

}  // namespace lampblack::flow
