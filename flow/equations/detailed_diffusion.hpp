// Multicomponent diffusion and the Soret effect in a flow: the fluxes of the Stefan-Maxwell equations and of thermal
// diffusion through every face, from the gas on its two sides (Kee, Coltrin, Glarborg 2003, sections 12.4 and 12.7).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class DetailedDiffusion {
 public:
  explicit DetailedDiffusion(const FlowContext& context);

  // Adds to `flux` (kg/s, species a face, low to high or outwards) what the context's TransportModel asks for of the
  // two. Nothing where the composition beyond a boundary face is not given.
  void addFlux(const State& state, const GasProperties& properties, std::span<double> flux);

 private:
  // The gas on the side of a face.
  struct Side {
    const double* Y;
    const double* thermalDiffusion;  // kg/m/s, species; null without the Soret effect
    double temperature, molecularWeight;
  };

  void addOfFace(double p, const Side& low, const Side& high, double lowWeight, double metric, double* flux);

  const FlowContext& context_;
  std::optional<MulticomponentTransport> multicomponent_;
  std::vector<double> X_, step_, flux_;
};

}  // namespace lampblack::flow
