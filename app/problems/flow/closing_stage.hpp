// What a flow's run computes once, of the last state, after its last step.
#pragma once

#include <memory>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

class ClosingStage {
 public:
  virtual ~ClosingStage() = default;
  // For the times of the report.
  [[nodiscard]] virtual const char* name() const = 0;
  // Collective. Before the run: InputError at a key of the deck for what cannot be done on this mesh.
  virtual void check(const FlowContext& context) const = 0;
  // Collective. Writes into the results, and tables into the folder if there is one. Where it fails, by NumericsError,
  // the results stay as they are.
  virtual void run(const FlowContext& context, const State& state, const GasProperties& properties,
                   ResultsWriter& results, const RunFolder* folder) const = 0;
};

// What the case asks for, one after the other. The case has to live as long.
[[nodiscard]] std::vector<std::unique_ptr<ClosingStage>> closingStages(const FlowCase& flowCase);

}  // namespace lampblack::app
