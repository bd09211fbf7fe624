// What a flow run writes: the mesh and fields for pictures, the history, the trajectories.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/stepping/budget.hpp"
#include "io/history.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

MeshOutput meshOutput(const Mesh& mesh);

// All fields of an output, the gas's and then those of the operators: takes the values of the owned cells, `components`
// a cell. `wanted`: names of fields that count, null for all. `future`: Operator::FieldSink.
using FlowFieldSink = std::function<void(const Quantity& field, int components, std::span<const double> values)>;
void flowFields(const FlowContext& context, const FlowCase& flowCase, const State& state,
                const std::vector<Operator*>& operators, const std::set<std::string>* wanted, const FlowFieldSink& sink,
                bool future = false);

// Writes one step: the gas, then what the operators have.
void writeFields(ResultsWriter& results, const FlowContext& context, const FlowCase& flowCase, const State& state,
                 const std::vector<Operator*>& operators, std::int64_t step, double time);

// One row of the history.
struct HistoryRow {
  std::int64_t step = 0;
  double time = 0.0, dt = 0.0;
  std::int64_t retriedSteps = 0;
  StateExtremes extremes;
  std::vector<double> operators;  // the values of each, one behind the other
  std::vector<Budget::Line> budget;
  std::vector<double> steady;  // with time.steady only; the last columns
};
std::vector<Quantity> historyColumns(const Mesh& mesh, const std::vector<Operator*>& operators,
                                     const std::vector<Budget::Line>& budget);
std::vector<double> historyValues(const HistoryRow& row);

}  // namespace lampblack::app
