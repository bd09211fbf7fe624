// Scalars that the flow carries for a model (State::carried): convection with the gas and thermophoresis by the limited
// scheme, explicit, then implicit diffusion.
#pragma once

#include <span>
#include <vector>

#include "core/rooms.hpp"
#include "flow/face_state.hpp"
#include "flow/flow_context.hpp"
#include "flow/gas_properties.hpp"
#include "flow/implicit_diffusion.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class CarriedTransport {
 public:
  CarriedTransport(const FlowContext& context, int scalars)
      : context_(context),
        diffusion_(context.mesh, context.halo),
        flux_(static_cast<std::size_t>(context.mesh.faces) * static_cast<std::size_t>(scalars), 0.0) {}

  // Collective. `faceVelocity` (m/s, every face) and `newMass` (kg, of the gas in each owned cell after the step) are
  // those the gas is advanced with; `faces` holds its face values.
  void advance(State& state, const GasProperties& properties, const FaceState& faces,
               std::span<const double> faceVelocity, std::span<const double> newMass, double dt);

  // Convective flux of the last step, per s, scalars a face, positive from low to high or outwards; what crosses the
  // boundary is in here, as diffusion does not cross it.
  [[nodiscard]] std::span<const double> flux() const { return flux_; }

 private:
  void diffuse(const State& state, const FaceState& faces, std::span<const double> newMass, double dt,
               std::span<double> content);

  const FlowContext& context_;
  ImplicitDiffusion diffusion_;
  std::vector<double> flux_;
};

}  // namespace lampblack::flow
