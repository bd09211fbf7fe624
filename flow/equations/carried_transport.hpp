// Scalars that the flow carries for their owners (State::carried): convection with the gas and thermophoresis by the
// limited scheme, explicit, then implicit diffusion; in several sweeps as the gas (TransportOperator). Gas that comes
// in has what the boundary says (ScalarBoundary). Walls that hold a scalar have the flux of drift and diffusion to the
// value there (flow/boundaries/wall_flux.hpp), implicit as diffusion is, and so have inlets, without drift.
// What owners take in proportion to what there is (State::Balance::carriedSink) is implicit, too.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class CarriedTransport {
 public:
  CarriedTransport(const FlowContext& context, const State& state, ImplicitDiffusion& diffusion)
      : context_(context),
        diffusion_(diffusion),
        gradient_(context.mesh),
        flux_(static_cast<std::size_t>(context.mesh.faces) * state.scalars.size(), 0.0),
        driftFlux_(static_cast<std::size_t>(state.scalars.empty() ? 0 : context.mesh.faces), 0.0),
        faceDensity_(driftFlux_.size(), 0.0) {}

  // The gas of a sweep: the step's start, and its mean with what the last sweep found (both the state itself in the
  // first sweep), viscosity (Pa s, cells) and values at faces of that mean, and what the gas is advanced with.
  struct Gas {
    const State& start;
    const State& mean;
    std::span<const double> viscosity;
    const FaceState& faces;
    std::span<const double> faceVelocity;  // m/s, every face
    std::span<const double> newMass;       // kg, of the gas in each owned cell after the step
    const GasProperties& properties;       // beside the boundaries
    std::span<const double> heat;          // W, conducted through every face in the step
  };
  // Collective.
  void advance(State& state, const Gas& gas, double dt);

  // Collective. Flux (per s, scalars a face, from low to high or outwards) of a state as it is, which is the gas's
  // start and mean.
  void presentFlux(const State& state, const Gas& gas, std::span<double> flux);

  // Collective. Flux of the state by its own diffusivities, and the conductances (per s) it has through the faces.
  void diffusiveFlux(const State& state, const FaceState& faces, const GasProperties& properties,
                     std::span<double> conductance, std::span<double> flux) const;

  // Flux of the last step, or of the last presentFlux(), per s, scalars a face, positive from low to high or outwards:
  // all that crosses the boundary, between cells the convective part.
  [[nodiscard]] std::span<const double> flux() const { return flux_; }
  // kg/s, what thermophoresis moves of the gas's mass through each face in the last step for a coefficient of one:
  // particles drift as if so much gas flowed; of the boundary's faces to the walls that take particles or hold a scalar
  // alone.
  [[nodiscard]] std::vector<double>& driftFlux() { return driftFlux_; }
  [[nodiscard]] const std::vector<double>& driftFlux() const { return driftFlux_; }
  // kg/m3, with which what is carried diffuses through each face in the last step.
  [[nodiscard]] std::vector<double>& faceDensity() { return faceDensity_; }
  [[nodiscard]] const std::vector<double>& faceDensity() const { return faceDensity_; }

 private:
  void findDrift(const Gas& gas);
  [[nodiscard]] double driftToWall(const Gas& gas, int face) const;
  [[nodiscard]] double wallDiffusion(const State& state, const FaceState& faces, const GasProperties& properties,
                                     int face, int scalar) const;
  void convectiveFlux(const State& state, const Gas& gas);
  void diffuse(const State& state, const Gas& gas, double dt, std::span<double> content);
  void findHeld(const State& state, const ScalarBoundaries& boundaries) const;
  void addCrossed(std::span<const double> flux);
  static void leaveOut(const State& state, std::span<double> perFace);
  [[nodiscard]] double densityBetween(const State& state, int face) const;
  [[nodiscard]] std::size_t firstOfBoundary() const;  // in flux()
  [[nodiscard]] bool hasDriftToWall(const FaceState& faces, int face) const;
  void solveChanges(const State& state, std::span<const double> inertia, std::span<const double> conductance,
                    std::span<const double> sinks, std::span<double> change);
  // m^2/s, scalars a local cell: their own and that of the eddies.
  [[nodiscard]] const std::vector<double>& diffusivities(const State& state) const;

  const FlowContext& context_;
  ImplicitDiffusion& diffusion_;
  Gradient gradient_;
  std::vector<double> flux_, driftFlux_, faceDensity_;
  // Of what is carried per mass of gas, where steps are oblique to faces.
  mutable std::vector<double> perMass_, perMassGradient_;
  mutable std::vector<BoundaryData> known_;  // of each scalar at each boundary face
  mutable std::vector<double> held_;
  mutable std::vector<double> diffusivity_;  // with that of the eddies; unused in laminar flow
};

}  // namespace lampblack::flow
