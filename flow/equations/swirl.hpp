// Swirl: the velocity w about the axis of an axisymmetric flow, by the angular momentum r w of a mass of gas,
//   rho D(r w)/Dt = div(mu r^2 grad(w/r))
// (Batchelor 1967, appendix 2). Convection limited upwind of r w, viscosity implicit in the angular velocity w/r: a gas
// that turns as a solid body has none. What swirl does to the flow is its centrifugal acceleration w^2/r.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/discretisation/upwind.hpp"
#include "flow/equations/momentum_sweep.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class Swirl {
 public:
  // Collective. `pressureKnown`: what is known of the pressure at each boundary face.
  Swirl(const FlowContext& context, std::span<const BoundaryData> pressureKnown);

  // One sweep of a step: advances `state.swirl`, which is that of the last sweep or of the start. Collective; the halo
  // is filled. The centrifugal acceleration is that of the middle of the step afterwards, with one sweep of its end.
  void advance(State& state, const MomentumSweep& sweep);

  // Collective. N m, the moment about the axis on the gas of each owned cell in a state, which is the sweep's start and
  // mean. The centrifugal acceleration is that of the state afterwards.
  void rates(const State& state, const MomentumSweep& sweep, std::span<double> moment);

  // m/s2, outwards, in any cell; set by advance(), by rates() and by setCentrifugal(), to that of the mean of two
  // swirls.
  [[nodiscard]] double centrifugal(int cell) const { return centrifugal_[static_cast<std::size_t>(cell)]; }
  void setCentrifugal(const State& a, const State& b);

  // Adds what the centrifugal force needs of the pressure's slope in the cells whose slope is that on their other side,
  // so that a gas that turns as a solid body stays on its circles. `gradient`: Pa/m, two a cell.
  void completeOuterSlopes(std::span<const double> density, std::span<double> gradient) const;

 private:
  void assemble(const State& state, const MomentumSweep& sweep);
  void setBoundaries(const State& mean);
  void addInside(const MomentumSweep& sweep);
  void addBoundaries(const MomentumSweep& sweep);
  [[nodiscard]] bool isGiven(int face) const;

  const FlowContext& context_;
  Gradient gradient_;
  ImplicitDiffusion diffusion_;
  std::vector<BoundaryData> known_;  // of r w, a boundary face
  UpwindGeometry upwind_;
  std::vector<double> boundary_;                         // m2/s, r w at the boundary faces
  std::vector<double> angularMomentum_, slope_;          // m2/s, r w; m/s, its gradient, two a cell
  std::vector<double> diagonal_, conductance_, source_;  // of the angular velocities
  std::vector<double> turning_, excess_;                 // 1/s
  std::vector<double> centrifugal_;                      // m/s2, cells
  // Cells at the outer boundary where the pressure is not known, and the faces on their other side.
  struct Outermost {
    int cell, face;
  };
  std::vector<Outermost> outermost_;
};

}  // namespace lampblack::flow
