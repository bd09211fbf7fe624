// Heat that gas and particles of a flow lose by optically thin radiation (ThinRadiation): a part of State::balance,
// which transport takes as a source. Over a step it is the mean of the losses at its start and at what the last sweep
// has found as its end.
#pragma once

#include <vector>

#include "core/rooms.hpp"
#include "flow/carried_model.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/radiation.hpp"

namespace lampblack::flow {

class RadiationOperator : public Operator {
 public:
  // `carried`: what the state carries, from its first scalar on; null for nothing that radiates.
  RadiationOperator(const FlowContext& context, double surroundings, CarriedModel* carried);

  [[nodiscard]] const char* name() const override { return "radiation"; }
  void advance(State& state, double time, double dt) override;
  void endSweep(State& state) override;
  void endStep(State& state) override;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void fields(const State& state, const FieldSink& sink) const override;

 private:
  void evaluate(const State& state);

  const FlowContext& context_;
  ThinRadiation radiation_;
  CarriedModel* carried_;
  std::vector<double> start_, loss_;  // W/m3 of owned cells: at the step's start, of the latest state
  std::vector<double> X_;
};

}  // namespace lampblack::flow
