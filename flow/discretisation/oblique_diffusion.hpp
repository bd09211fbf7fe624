// What is missing from the diffusive fluxes of species where the step between two cells is oblique to their face: the
// part of the gradient along Mesh::oblique, from the cells' gradients (the over-relaxed correction; Jasak 1996, section
// 3.3.1.3).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/row_gradient.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class ObliqueDiffusion {
 public:
  explicit ObliqueDiffusion(const FlowContext& context);

  // Collective. Adds to `flux` (kg/s, species a face, low to high or outwards); all species together add nothing.
  void addFlux(const State& state, const GasProperties& properties, std::span<double> flux);

 private:
  const FlowContext& context_;
  Gradient gradient_;
  RowGradient YGradient_;
  std::vector<BoundaryData> known_;
  std::vector<double> boundaryY_, logWeight_, boundaryLogWeight_, logWeightGradient_;
  std::vector<double> lowSlope_, highSlope_, flux_;
};

}  // namespace lampblack::flow
