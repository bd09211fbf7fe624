// A start for diffusion flames: two streams that mix across a layer, burnt or hot.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct Stream {
  double temperature = 298.0;  // K
  std::vector<double> Y;
};

struct MixingLayer {
  int axis = 1;           // the layer is normal to this axis
  double position = 0.0;  // m, where the mixture is half and half
  double width = 1e-3;    // m, distance over which the mixture fraction changes by most (that of its tanh)
  Stream low, high;       // streams at the low and high end of the axis
  // Burnt: fuel and oxygen that meet have burnt (BurntMixture), and are no hotter than `temperature`. Not burnt: mixed
  // cold, then heated to at least `temperature` within a hot layer `hotWidth` around `hotPosition`.
  bool burnt = true;
  double temperature = 2200.0;               // K
  double hotPosition = 0.0, hotWidth = 0.0;  // m
};

// Fills temperature, Y, enthalpy and density (halo included); leaves the velocity alone.
void setMixingLayer(const FlowContext& context, const MixingLayer& layer, State& state);

}  // namespace lampblack::flow
