// Momentum of the low-Mach equations (Wang 2025, eqs. 6-2 and 6-5): limited upwind convection by the face
// mass flux, implicit viscosity, and the pressure gradient of the last step; the projection finds by how much the
// pressure changes (incremental projection, van Kan 1986). A steady flow has no change left to find, and knows no time
// step.
#pragma once

#include <span>
#include <vector>

#include "core/rooms.hpp"
#include "flow/face_velocity.hpp"
#include "flow/flow_context.hpp"
#include "flow/gas_properties.hpp"
#include "flow/gradient.hpp"
#include "flow/implicit_diffusion.hpp"
#include "flow/projection.hpp"
#include "flow/state.hpp"
#include "flow/upwind.hpp"

namespace lampblack::flow {

class Momentum {
 public:
  explicit Momentum(const FlowContext& context);

  // Collective. Advances velocity and pressure over dt so that the face velocities have the given divergence (1/s,
  // owned cells). `newDensity` (cells, halo filled) is the density at the end of the step.
  // `faceVelocity` (m/s, every face) receives the projected normal velocities.
  Projection::Result advance(State& state, const GasProperties& properties, std::span<const double> newDensity,
                             std::span<const double> divergence, double dt, std::span<double> faceVelocity);

  void saveOrLoad(StateArchive& archive) {
    projection_.saveOrLoad(archive);
    faceVelocity_.saveOrLoad(archive);
  }

 private:
  void boundaryVelocities(const State& state);
  void outletPressures(const State& state);
  void predict(State& state, const GasProperties& properties, std::span<const double> newDensity, double dt);
  void explicitStress(const State& state, const GasProperties& properties);
  void outletStress(const State& state, const GasProperties& properties);

  const FlowContext& context_;
  Gradient gradient_;
  ImplicitDiffusion diffusion_;
  Projection projection_;
  FaceVelocity faceVelocity_;
  std::vector<BoundaryData> velocityKnown_, pressureKnown_;  // two a boundary face; one
  std::vector<UpwindGeometry> upwind_;                       // of each component
  std::vector<double> boundaryVelocity_, boundaryPressure_;
  std::vector<double> velocityGradient_, pressureGradient_;
  std::vector<double> acceleration_;  // m/s2, (grad p)/rho, two a cell
  std::vector<double> relaxation_;    // 1/s, rate at which convection and viscosity renew a cell's momentum
  std::vector<double> diagonal_, conductance_, source_, predicted_, inverseDensity_, pressureChange_;
};

}  // namespace lampblack::flow
