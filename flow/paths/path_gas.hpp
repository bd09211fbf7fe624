// The gas on paths of particles, as particles see it, between the cells' centres, their vertices and what is given at
// the boundaries.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "core/place_in_cell.hpp"
#include "flow/discretisation/vertex_field.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class PathGas {
 public:
  // Collective. With the concentrations of the species that have these numbers in the mechanism.
  PathGas(const FlowContext& context, const State& state, const GasProperties& properties,
          const std::vector<std::size_t>& species);

  // The gas as numbers that can travel: so many of them, at a place in one of this rank's cells, appended.
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(width_); }
  void append(const PlaceInCell& place, std::vector<double>& numbers) const;
  // And back; its concentrations are those among the numbers.
  [[nodiscard]] ParticleGas gasOf(std::span<const double> numbers) const;

 private:
  static constexpr int fixed = 4;  // temperature, density, viscosity, mean weight
  double pressure_;
  int width_;
  VertexField field_;
};

}  // namespace lampblack::flow
