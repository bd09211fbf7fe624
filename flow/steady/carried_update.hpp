// The implicit change of what a flow carries in an iteration towards the steady state (docs/theory/flow.md, "The steady
// state"), behind the gas: in every cell a dense block of inertia, transport and the derivatives of its sources,
// between cells diffusion and convection upwind of first order, with what drifts by thermophoresis. No amount is below
// zero then.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"
#include "flow/steady/block_system.hpp"
#include "flow/steady/carried_sweeps.hpp"

namespace lampblack::flow {

class CarriedUpdate {
 public:
  // Collective. The state carries something.
  CarriedUpdate(const FlowContext& context, const State& state, const FlowResidual& residual,
                const std::vector<Operator*>& operators);

  // Whether cells are solved one behind the other (CarriedSweeps), and not all by one linear system.
  [[nodiscard]] bool isByCell() const { return isByCell_; }

  // Collective. The residual is of the state, what is carried at least; `inertia` (kg/s, owned cells): mass over the
  // cell's pseudo-time. The halo is filled then, and what the operators tell transport of their scalars is that of the
  // new state. In how many cells, of all ranks, limits held an amount back.
  std::int64_t advance(State& state, const FlowResidual& residual, std::span<const double> inertia);

  // The parts of advance() where all cells are one linear system. Collective: the system of a state,
  void prepare(const State& state, const FlowResidual& residual, std::span<const double> inertia);
  // and its solution for any right side (kg/s times an amount per kg, owned cells), down to `reduction` of it: what
  // amounts per kg change by, of all cells. The iterations.
  int solve(std::span<const double> right, std::span<double> change, double reduction);
  // And, not collective, an amount per kg after a change, no further than a step may go.
  [[nodiscard]] double limited(std::size_t scalar, double present, double change) const;
  // Whether that holds it back, by more than next to nothing.
  [[nodiscard]] bool isHeld(std::size_t scalar, double present, double change) const;
  [[nodiscard]] std::span<const double> scales() const { return scales_; }

 private:
  void findScales(const State& state);
  std::int64_t sweep(State& state, const FlowResidual& residual, std::span<const double> inertia);
  void assemble(const State& state, const FlowResidual& residual, std::span<const double> inertia);
  [[nodiscard]] double flowOf(const State& state, const FlowResidual& residual, int face, std::size_t scalar) const;
  void dropFastGrowth(const State& state);
  void takeShares(State& state, const FlowResidual& residual);
  void take(State& state, int cell) const;
  [[nodiscard]] std::int64_t heldCells() const;
  void findMoved();
  [[nodiscard]] double leftOf(const State& state, int cell, double share) const;

  const FlowContext& context_;
  std::vector<Operator*> operators_;
  std::size_t n_;
  bool isByCell_;
  BlockSystem system_;
  CarriedSweeps sweeps_;
  // Largest amount per kg of gas of each scalar, at least what counts as nothing: the unit of the linear system.
  // Sections that nothing has reached yet would else have to keep to traces.
  std::vector<double> scales_;
  std::vector<double> slopes_;  // Operator::Slopes::carried
  std::vector<double> right_, change_, conductance_, flux_;
  std::vector<double> flow_;   // Operator::addCarriedFlow
  std::vector<double> moved_;  // what that brings into the owned cells by the change, over the scales
  // Owned cells: amounts per kg and their rates (per m3 and s) that the change begins with; the share of it that is
  // taken.
  std::vector<double> start_, startRates_, shares_;
  State::Balance made_;  // by the operators, in the state that is tried
};

}  // namespace lampblack::flow
