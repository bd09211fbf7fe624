// What acts on the gas of the cells, at the faces as a step evaluates it: convection, viscosity, pressure, gravity, and
// in a swirling flow the centrifugal force. Forces are kept as a source and what viscosity couples, so that a step can
// take viscosity implicitly, and rates() of a state are what is left of the two.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/discretisation/upwind.hpp"
#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/equations/momentum_sweep.hpp"
#include "flow/equations/pressure_force.hpp"
#include "flow/equations/swirl.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// How velocities are interpolated to faces where they are carried.
enum class VelocityScheme {
  Limited,  // upwind of second order, of first where the flow is not smooth: for steady flames
  Central,  // of fourth order with little damping: for flows that have to keep their vortices
};

class MomentumForces {
 public:
  MomentumForces(const FlowContext& context, bool swirls, VelocityScheme scheme);  // collective

  // Collective. Forces of a sweep; the state has velocity and pressure of the last sweep or of the start, halos are
  // filled. Of the velocities at the sweep's end, without inertia:
  //   diagonal u + sum over interior faces of conductance (u - u_neighbour) = source.
  void assemble(const State& state, const MomentumSweep& sweep);
  [[nodiscard]] std::span<double> diagonal() { return diagonal_; }  // kg/s, a component and owned cell
  [[nodiscard]] std::span<const double> conductance() const { return conductance_; }  // kg/s, a component and face
  [[nodiscard]] std::span<double> source() { return source_; }                        // N, a component and owned cell
  // 1/s, a cell (halo not filled): rate at which convection and viscosity renew a cell's momentum.
  [[nodiscard]] std::span<double> relaxation() { return relaxation_; }
  // m/s2, (grad p - f)/rho with gravity's force f, a component and owned cell.
  void acceleration(std::span<const double> density, std::span<double> to) const;

  // Collective. Of a state: N on the gas of each owned cell, a component each; in a swirling flow N m, its moment about
  // the axis. The sweep's start and mean are the state itself.
  void rates(const State& state, const MomentumSweep& sweep, std::span<double> momentum,
             std::span<double> angularMomentum);

  // Pa/m, a component and owned cell, of a change of the pressure that leaves the outlets as they are; until the next
  // call. Collective.
  std::span<const double> gradientOfChange(std::span<const double> change);

  [[nodiscard]] VelocityGradient& gradient() { return gradient_; }
  [[nodiscard]] Swirl* swirl() { return swirl_ ? &*swirl_ : nullptr; }
  [[nodiscard]] const std::vector<BoundaryData>& pressureKnown() const { return pressureKnown_; }

  // The gradient of the state's velocity (halo filled), until the next step. Collective.
  const VelocityGradient& velocityGradient(const State& state);
  // N (per metre of depth or radian), friction of the gas on a boundary face: of the state whose gradient was last
  // asked for; Pa s.
  [[nodiscard]] Vector3 boundaryTraction(int face, const State& state, double viscosity) const;
  // Pa, hydrodynamic pressure at each boundary face.
  [[nodiscard]] std::vector<double> boundaryPressures(const State& state);

 private:
  static std::vector<BoundaryData> pressureData(const FlowContext& context);
  void outletPressures(const State& state);
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
  PressureForce pressureForce_;
  std::optional<Swirl> swirl_;
  std::vector<UpwindGeometry> upwind_;  // of each component
  std::vector<double> boundaryPressure_, pressureGradient_, relaxation_;
  std::vector<double> excess_;  // m/s, a component and cell: half of what the last sweep changed, with the other sign
  std::vector<double> diagonal_, conductance_, source_;
};

}  // namespace lampblack::flow
