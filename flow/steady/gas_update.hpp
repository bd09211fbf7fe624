// The implicit change of all species and the temperature together in an iteration towards the steady state
// (docs/theory/flow.md, "The steady state"): in every cell a dense block of inertia, transport, reactions and models,
// between cells diffusion by its conductances and convection upwind of first order; what it changes is what is left of
// the equations as they are.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/block_system.hpp"

namespace lampblack::flow {

// NumericsError for a temperature (K) that no gas has data for.
void checkTemperature(double temperature);

class GasUpdate {
 public:
  GasUpdate(const FlowContext& context, const State& state, std::vector<Operator*> operators);  // collective

  struct Result {
    int iterations = 0;        // of the linear solver
    double largestRise = 0.0;  // K, of any cell before it was limited
    std::int64_t limited = 0;  // cells whose change was limited
  };
  // Collective. The residual is of the state; `inertia` (kg/s, owned cells): mass over the cell's pseudo-time. The
  // state has a new gas of the same pressure then, halo filled; what is carried keeps its amount per mass.
  // NumericsError where there is none.
  Result advance(State& state, const FlowResidual& residual, std::span<const double> inertia);

  // Of an owned cell, the share that the last advance() took of what the linear system gave.
  [[nodiscard]] std::span<const double> shares() const { return shares_; }

 private:
  void assemble(const State& state, const FlowResidual& residual, std::span<const double> inertia);
  void assembleBlock(const State& state, const FlowResidual& residual, int cell);
  // The share of the change that was taken.
  double take(State& state, int cell, double& largestRise);

  const FlowContext& context_;
  std::vector<Operator*> operators_;
  std::size_t n_;
  BlockSystem system_;
  std::vector<double> slopes_;
  std::vector<double> right_, change_, shares_;
  std::vector<double> made_, enthalpies_, capacities_;
};

}  // namespace lampblack::flow
