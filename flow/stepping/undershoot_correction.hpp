// Mass fractions below zero: a cell that has given away more of a species than it had gets it back from the cells
// around, as fluxes through the faces between them.
//
// Transport holds what the reactions do, and reactions what transport does, as it was (State::balance): a species that
// reacts away faster, or forms more slowly, than it did has then left its cell in fluxes that were too large. They are
// corrected afterwards, as in flux-corrected transport (Boris and Book 1973; Zalesak 1979): what a cell lacks comes
// from its neighbours in proportion to what they have of it, no more than half of that, and as much of the cell's
// mixture goes the other way. Mass, elements and enthalpy close to round-off. Fractions of -1e-5 and more stay as they
// are, so that a flow without lower ones, a steady flame, is not touched.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/peak.hpp"

namespace lampblack::flow {

class UndershootCorrection : public Operator {
 public:
  // Stands behind all operators that change the gas. `sweeps`: of a step; only the last one's result is corrected.
  UndershootCorrection(const FlowContext& context, int sweeps) : context_(context), sweeps_(sweeps) {}

  [[nodiscard]] const char* name() const override { return "undershoots"; }
  void advance(State& state, double time, double dt) override;
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;

 private:
  void findLacking(const State& state);
  void findShares(const State& state);
  [[nodiscard]] bool addExchange(const State& state, int to, int from, double sign, std::span<double> row);
  void correct(State& state);

  const FlowContext& context_;
  int sweeps_, sweep_ = 0;
  std::vector<std::size_t> lacking_;  // species that some cell has too little of
  // Of these, for each local cell: the part of what the neighbours can give that it asks for; what a cell gives of
  // that.
  std::vector<double> asked_, given_;
  std::vector<double> enthalpies_;  // scratch
  double lowest_ = 0.0;             // mass fraction, the most negative that was found in the last search
  double lowestSinceRow_ = 0.0;     // the same before corrections, since the last row of the history
  double lowestOfRun_ = 0.0;        // and of all steps that were corrected
  double corrected_ = 0.0;          // how many these were
};

}  // namespace lampblack::flow
