// Stochastic soot ensembles along streamlines of a computed flow, spread over the ranks.
#pragma once

#include "app/flow/flow_case.hpp"
#include "core/rooms.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/transport_operator.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Collective. Traces the deck's trajectories through the state's flow, marches an ensemble along each (trajectory i on
// rank i mod ranks; its random numbers depend on the seed and i alone) and writes them under /trajectories.
void runTrajectories(const FlowContext& context, const FlowCase& flowCase, const State& state,
                     const GasProperties& properties, ResultsWriter& results);

}  // namespace lampblack::app
