// The new amounts of what a flow carries in an iteration towards the steady state, where what acts on them in a cell
// knows of no other cell (Operator::carriedInCells): cell by cell in the order in which the gas passes them, then the
// other way, as reactors that are fed by their neighbours (nonlinear symmetric Gauss-Seidel: Ortega and Rheinboldt
// 1970). What is carried with the gas alone is found in one sweep, however many cells it passes; no amount is below
// zero. docs/theory/flow.md, "The steady state".
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/block_system.hpp"
#include "numerics/dense_blocks.hpp"

namespace lampblack::flow {

class CarriedSweeps {
 public:
  CarriedSweeps(const FlowContext& context, std::size_t fields);

  struct Problem {
    BlockSystem& transport;           // of changes, amounts per kg over the scales, inertia included; no sources
    std::span<const double> inertia;  // kg/s, owned cells
    std::span<const double> right;    // what is left of the state's equations, over the scales
    std::span<const double> scales;   // per kg
    std::span<const double> rates;    // what is made in the state, per m^3 and s
    const std::vector<std::unique_ptr<Operator::CarriedInCells>>& sources;
  };
  // Collective. The state's amounts become the new ones; its halo is not filled. In how many cells, of all ranks,
  // limits held an amount back in the last sweep.
  std::int64_t advance(State& state, const Problem& problem);

 private:
  void findOrder(const State& state);
  void prepare(const State& state, const Problem& problem);
  // Whether limits held an amount back in the cell's last step.
  bool solveCell(const State& state, const Problem& problem, int cell);
  // To rates_ and, where asked for, slopes_; per m^3 and s, at amounts over the scales.
  void findSources(const State& state, const Problem& problem, int cell, std::span<const double> x, bool slopes);
  // What is left of the cell's equations, each over how fast it is fed; their size, each over what there is.
  double findLeft(const State& state, const Problem& problem, int cell, std::span<const double> x);

  const FlowContext& context_;
  std::size_t n_;
  std::vector<int> order_;
  std::vector<double> x_;                  // amounts over the scales, fields a cell
  std::vector<double> leaves_, constant_;  // fields an owned cell: what takes them away; what feeds them, fixed
  std::vector<double> fed_, left_, trial_, change_, amounts_, rates_, slopes_, matrix_;
  std::vector<int> pivots_;
  numerics::DenseBlocks dense_;
  double moved_ = 0.0;  // sum of the cells' changes in a sweep
};

}  // namespace lampblack::flow
