// Momentum of the low-Mach equations (Wang 2025, eqs. 6-2 and 6-5): upwind convection, limited where the flow is not
// smooth, by the face mass flux, implicit viscosity, and the pressure gradient of the last step; the projection finds
// by how much the pressure changes (incremental projection, van Kan 1986). A steady flow has no change left to find,
// and knows no time step.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/equations/face_velocity.hpp"
#include "flow/equations/momentum_forces.hpp"
#include "flow/equations/momentum_sweep.hpp"
#include "flow/equations/projection.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// 1/rho at each face, of the densities of the cells.
[[nodiscard]] std::vector<double> inverseFaceDensity(const Mesh& mesh, std::span<const double> density);

class Momentum {
 public:
  Momentum(const FlowContext& context, bool swirls, VelocityScheme scheme = VelocityScheme::Limited);

  // Collective. Advances `state`, which has velocity, swirl and pressure of the last sweep or of the start; halos are
  // filled.
  // `faceVelocity` (m/s, every face) receives the projected normal velocities.
  Projection::Result advance(State& state, const MomentumSweep& sweep, std::span<double> faceVelocity);

  // Collective. Gives a gas at rest the pressure that carries its weight, and that keeps it on its circles.
  void balanceForces(State& state);

  // What acts on the gas, beside the step.
  [[nodiscard]] MomentumForces& forces() { return forces_; }

  // The step's last sweep is done.
  void endStep() { faceVelocity_.endStep(); }

  void saveOrLoad(StateArchive& archive) {
    projection_.saveOrLoad(archive);
    faceVelocity_.saveOrLoad(archive);
  }

 private:
  void predict(const State& state, const MomentumSweep& sweep);

  const FlowContext& context_;
  int dimension_;
  MomentumForces forces_;
  ImplicitDiffusion diffusion_;
  Projection projection_;
  FaceVelocity faceVelocity_;
  std::vector<double> acceleration_;  // m/s2, MomentumForces::acceleration()
  std::vector<double> predicted_, inverseDensity_, pressureChange_;
};

}  // namespace lampblack::flow
