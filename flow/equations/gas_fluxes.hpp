// What convection and diffusion carry through a face of the gas: mass of each species, and enthalpy with it. From low
// to high or outwards.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/equations/species_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class GasFluxes {
 public:
  // What is at the faces, and how species diffuse, both prepared with the state below.
  GasFluxes(const FlowContext& context, FaceState& faces, const SpeciesDiffusion& diffusion);

  // kg/s of each species by this mass flux (kg/s) and by diffusion, to `row`; W, the enthalpy of both, without
  // conduction. The face's temperature, density and enthalpy (FaceState) are those upwind of the mass flux afterwards.
  double through(const State& state, int face, double massFlux, std::span<double> row);
  // W, the enthalpy of species (kg/s) that diffuse through a face.
  double ofDiffusion(const State& state, int face, std::span<const double> species);

 private:
  const FlowContext& context_;
  FaceState& faces_;
  const SpeciesDiffusion& diffusion_;
  std::vector<double> diffuses_, enthalpies_;
};

}  // namespace lampblack::flow
