// Heat that gas and particles of a flow lose by optically thin radiation (ThinRadiation): a part of State::balance,
// which transport takes as a source. Over a step it is the mean of the losses at its start and at what the last sweep
// has found as its end.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/radiation.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

class RadiationOperator : public Operator {
 public:
  // Absorption coefficient (1/m) at a temperature of what a block of the state carries in a cell.
  using Absorption = std::function<double(double temperature, std::span<const double> carried)>;
  // `particles`: of the block `of`; empty where nothing of what is carried radiates.
  RadiationOperator(const FlowContext& context, double surroundings, Absorption particles, ScalarRange of = {});

  [[nodiscard]] const char* name() const override { return "radiation"; }
  void advance(State& state, double time, double dt) override;
  void addRates(const State& state, State::Balance& rates) override;
  void addSlopes(const State& state, const Slopes& slopes) override;
  void endSweep(State& state) override;
  void endStep(State& state) override;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void fields(const State& state, const FieldSink& sink) const override;

 private:
  void evaluate(const State& state, std::span<double> loss);

  const FlowContext& context_;
  ThinRadiation radiation_;
  Absorption particles_;
  ScalarRange block_;
  std::vector<double> start_, loss_;  // W/m3 of owned cells: at the step's start, of the latest state
  std::vector<double> X_;
};

}  // namespace lampblack::flow
