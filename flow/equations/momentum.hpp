// Momentum of the low-Mach equations (Wang 2025, eqs. 6-2 and 6-5): upwind convection, limited where the flow is not
// smooth, by the face mass flux, implicit viscosity, and the pressure gradient of the last step; the projection finds
// by how much the pressure changes (incremental projection, van Kan 1986). A steady flow has no change left to find,
// and knows no time step.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/discretisation/upwind.hpp"
#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/equations/face_velocity.hpp"
#include "flow/equations/momentum_sweep.hpp"
#include "flow/equations/pressure_force.hpp"
#include "flow/equations/projection.hpp"
#include "flow/equations/swirl.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// How velocities are interpolated to faces where they are carried.
enum class VelocityScheme {
  Limited,  // upwind of second order, of first where the flow is not smooth: for steady flames
  Central,  // of fourth order with little damping: for flows that have to keep their vortices
};

class Momentum {
 public:
  Momentum(const FlowContext& context, bool swirls, VelocityScheme scheme = VelocityScheme::Limited);

  // Collective. Advances `state`, which has velocity, swirl and pressure of the last sweep or of the start; halos are
  // filled.
  // `faceVelocity` (m/s, every face) receives the projected normal velocities.
  Projection::Result advance(State& state, const MomentumSweep& sweep, std::span<double> faceVelocity);

  // Collective. Gives a gas at rest the pressure that carries its weight, and that keeps it on its circles.
  void balanceForces(State& state);

  // The gradient of the state's velocity (halo filled), until the next step. Collective.
  const VelocityGradient& velocityGradient(const State& state);
  // N (per metre of depth or radian), friction of the gas on a boundary face: of the state whose gradient was last
  // asked for; Pa s.
  [[nodiscard]] Vector3 boundaryTraction(int face, const State& state, double viscosity) const;
  // Pa, hydrodynamic pressure at each boundary face.
  [[nodiscard]] std::vector<double> boundaryPressures(const State& state);

  // The step's last sweep is done.
  void endStep() { faceVelocity_.endStep(); }

  void saveOrLoad(StateArchive& archive) {
    projection_.saveOrLoad(archive);
    faceVelocity_.saveOrLoad(archive);
  }

 private:
  void setInverseDensity(std::span<const double> density);
  static std::vector<BoundaryData> pressureData(const FlowContext& context);
  void outletPressures(const State& state);
  void predict(const State& state, const MomentumSweep& sweep);
  void addInside(int face, const MomentumSweep& sweep);
  void addBoundary(int face, const MomentumSweep& sweep);
  void addLastSweepsViscosity(const State& state, const MomentumSweep& sweep);
  void explicitStress(const MomentumSweep& sweep);
  void outletStress(const MomentumSweep& sweep);

  [[nodiscard]] double carriedVelocity(int face, double flux, int component, std::span<const double> velocity) const;

  const FlowContext& context_;
  int dimension_;
  VelocityScheme scheme_;
  VelocityGradient gradient_;
  ImplicitDiffusion diffusion_;
  std::vector<BoundaryData> pressureKnown_;  // one a boundary face
  PressureForce force_;
  Projection projection_;
  FaceVelocity faceVelocity_;
  std::optional<Swirl> swirl_;
  std::vector<UpwindGeometry> upwind_;  // of each component
  std::vector<double> boundaryPressure_;
  std::vector<double> pressureGradient_;
  std::vector<double> acceleration_;  // m/s2, (grad p - f)/rho with gravity's force f, a component and cell
  std::vector<double> relaxation_;    // 1/s, rate at which convection and viscosity renew a cell's momentum
  std::vector<double> excess_;  // m/s, a component and cell: half of what the last sweep changed, with the other sign
  std::vector<double> diagonal_, conductance_, source_, predicted_, inverseDensity_, pressureChange_;
};

}  // namespace lampblack::flow
