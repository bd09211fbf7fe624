// How particles and other carried scalars come from the centre of a cell to a wall that the gas sticks to. Where the
// law of the wall stands for what is between (flow/boundaries/wall_law.hpp), there are two ways, one behind the other:
// first eddies bring them to a still layer, with no drift to speak of, then they drift and diffuse through that
// (flow/boundaries/wall_flux.hpp). Elsewhere there is the second alone. docs/theory/turbulence.md, "Wall
// functions".
#pragma once

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// The eddies' way: zeros where there are none.
struct WallEddies {
  double ofHeat = 0.0;      // share of the temperature's rise from the wall to the centre that lies in it
  double resistance = 0.0;  // s/kg, of it to a scalar: its difference per mass of gas over what passes
};
// Of a state that the properties were evaluated from.
[[nodiscard]] WallEddies eddiesToWall(const FlowContext& context, const State& state, const GasProperties& properties,
                                      int face);

// kg/s of gas: the conductance for diffusion through the still layer, of a scalar of diffusivity `D`
// (m^2/s). `density`: at the face, kg/m^3.
[[nodiscard]] double conductanceToWall(const FlowContext& context, const State& state, const GasProperties& properties,
                                       int face, double density, double D);

}  // namespace lampblack::flow
