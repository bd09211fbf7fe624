// What a flow run writes: the mesh and fields for pictures, the history, the trajectories.
#pragma once

#include "app/flow_case.hpp"
#include "app/soot_operator.hpp"
#include "flow/budget.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/transport_operator.hpp"
#include "io/history.hpp"
#include "io/results_writer.hpp"

namespace lampblack {

MeshOutput meshOutput(const Mesh& mesh);

// Writes one step. `soot` may be null.
void writeFields(ResultsWriter& results, const FlowContext& context, const FlowCase& flowCase, const State& state,
                 const GasProperties& properties, const SootOperator* soot, std::int64_t step, double time);

// One row of the history.
struct HistoryRow {
  std::int64_t step = 0;
  double time = 0.0, dt = 0.0;
  StateExtremes extremes;
  TransportOperator::Diagnostics transport;
  ReactionOperator::Diagnostics chemistry;
  double peakVolumeFraction = 0.0, limitedOxidations = 0.0;
  std::vector<Budget::Line> budget;
};
std::vector<TableColumn> historyColumns(const std::vector<Budget::Line>& budget);
std::vector<double> historyValues(const HistoryRow& row);

}  // namespace lampblack
