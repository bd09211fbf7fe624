#include "flow/mixing_layer.hpp"

#include <algorithm>
#include <cmath>

#include "flow/burnt_mixture.hpp"

namespace lampblack::flow {

void setMixingLayer(const FlowContext& context, const MixingLayer& layer, State& state) {
  const Mesh& m = context.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  BurntMixture burnt(context.mechanism, context.thermo);
  std::vector<double> Y(n);
  const double lowEnthalpy = context.thermo.enthalpyMass(layer.low.temperature, layer.low.Y);
  const double highEnthalpy = context.thermo.enthalpyMass(layer.high.temperature, layer.high.Y);
  for (int c = 0; c < m.cells; ++c) {
    const double x = m.centre[c][layer.axis];
    const double share = 0.5 * (1.0 - std::tanh(2.0 * (x - layer.position) / layer.width));  // of the low stream
    for (std::size_t k = 0; k < n; ++k) Y[k] = share * layer.low.Y[k] + (1.0 - share) * layer.high.Y[k];
    const double h = share * lowEnthalpy + (1.0 - share) * highEnthalpy;
    double T = context.thermo.temperatureFromEnthalpy(h, Y, layer.low.temperature);
    if (layer.burnt) {
      T = burnt.burn(h, state.thermodynamicPressure, std::max(T, layer.temperature), Y);
    } else {
      const double away = (x - layer.hotPosition) / layer.hotWidth;
      T = std::max(T, T + (layer.temperature - T) * std::exp(-away * away));
    }
    std::copy(Y.begin(), Y.end(), &state.Y[c * n]);
    state.temperature[c] = T;
    state.enthalpy[c] = context.thermo.enthalpyMass(T, Y);
    state.density[c] = context.thermo.density(T, state.thermodynamicPressure, Y);
  }
}

}  // namespace lampblack::flow
