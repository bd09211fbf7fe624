// Swirl: the velocity w about the axis of an axisymmetric flow, by the angular momentum r w of a mass of gas,
//   rho D(r w)/Dt = div(mu r^2 grad(w/r))
// (Batchelor 1967, appendix 2). Convection limited upwind of r w, viscosity implicit in the angular velocity w/r: a gas
// that turns as a solid body has none. What swirl does to the flow is its centrifugal acceleration w^2/r.
#pragma once

#include <vector>

#include "core/rooms.hpp"
#include "flow/flow_context.hpp"
#include "flow/gradient.hpp"
#include "flow/implicit_diffusion.hpp"
#include "flow/momentum_sweep.hpp"
#include "flow/upwind.hpp"

namespace lampblack::flow {

class Swirl {
 public:
  // Collective.
  explicit Swirl(const FlowContext& context);

  // One sweep of a step: advances `state.swirl`, which is that of the last sweep or of the start. Collective; the halo
  // is filled.
  void advance(State& state, const MomentumSweep& sweep);

  // m/s2, outwards, of gas with that velocity in a cell.
  [[nodiscard]] double centrifugal(int cell, double velocity) const {
    return velocity * velocity / context_.mesh.centre[static_cast<std::size_t>(cell)][0];
  }

 private:
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
};

}  // namespace lampblack::flow
