// Stochastic populations along streamlines of a computed flow, spread over the ranks.
#pragma once

#include "app/problems/flow/closing_stage.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

class Trajectories final : public ClosingStage {
 public:
  // Of a case that asks for some; it has to live as long.
  explicit Trajectories(const FlowCase& flowCase) : case_(flowCase) {}

  [[nodiscard]] const char* name() const override { return "trajectories"; }
  // InputError for a start that is outside the mesh, or on an outlet, where the path would leave at once.
  void check(const FlowContext& context) const override;
  // Traces the deck's trajectories through the state's flow, marches a population along each (each on one rank, with
  // the longest first; its random numbers depend on the seed and its number alone) and writes them under /trajectories;
  // the gas tables that the deck asks for into the folder.
  void run(const FlowContext& context, const State& state, const GasProperties& properties, ResultsWriter& results,
           const RunFolder* folder) const override;

 private:
  const FlowCase& case_;
};

}  // namespace lampblack::app
