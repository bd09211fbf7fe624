// Time steps by their error. The last sweep of deferred correction corrects what the sweep before has found; by how
// much is the error of the sweep before, in time, and the next step is that for which it is what the deck allows. The
// state that goes on is the corrected one, whose error is smaller. Needs two sweeps.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

class StepControl : public Operator {
 public:
  // `tolerance`: of the temperature, relative, and of mass fractions, the largest in any cell. Stands behind all other
  // operators of a step of `sweeps` sweeps. std::logic_error for less than two of them.
  StepControl(const FlowContext& context, double tolerance, int sweeps);

  [[nodiscard]] const char* name() const override { return "step control"; }
  void advance(State& state, double time, double dt) override;
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] double largestStep(const State& state) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;

 private:
  const FlowContext& context_;
  double tolerance_;
  int sweeps_, sweep_ = 0;
  std::vector<double> temperature_, Y_;  // of the owned cells, after the sweep before the last
  double error_ = 0.0, step_ = 0.0;      // of the last step; zero before the first
};

}  // namespace lampblack::flow
