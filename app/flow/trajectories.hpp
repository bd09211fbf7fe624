// Stochastic soot ensembles along streamlines of a computed flow, spread over the ranks.
#pragma once

#include "app/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// Collective. InputError at its key of the deck for a start that is outside the mesh, or on an outlet, where the path
// would leave at once.
void requireStartsInside(const FlowContext& context, const TrajectoryRequest& request);

// Collective. Traces the deck's trajectories through the state's flow, marches an ensemble along each (each on one
// rank, with the longest first; its random numbers depend on the seed and its number alone) and writes them under
// /trajectories; the gas tables that the deck asks for into the folder, if there is one.
void runTrajectories(const FlowContext& context, const FlowCase& flowCase, const State& state,
                     const GasProperties& properties, ResultsWriter& results, const RunFolder* folder = nullptr);

}  // namespace lampblack::app
