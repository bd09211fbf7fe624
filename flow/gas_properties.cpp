#include "flow/gas_properties.hpp"

#include <algorithm>

namespace lampblack::flow {

void GasProperties::update(const FlowContext& context, const State& state) {
  const int cells = context.mesh.cells;
  const int n = state.species;
  viscosity.resize(cells);
  conductivity.resize(cells);
  heatCapacity.resize(cells);
  molecularWeight.resize(cells);
  massDiffusivity.resize(static_cast<std::size_t>(cells) * n);
  X_.resize(n);
  DT_.resize(n);
  const TransportModel& model = context.transportModel;
  if (model.isMulticomponent() && !multicomponent_) multicomponent_.emplace(context.mechanism, model.integrals);
  if (model.soret) thermalDiffusion.resize(massDiffusivity.size());
  const auto molecularWeights = context.mechanism.molecularWeights();
  for (int cell = 0; cell < cells; ++cell) {
    const std::span<const double> Y{state.Y.data() + static_cast<std::ptrdiff_t>(cell) * n,
                                    static_cast<std::size_t>(n)};
    const double T = state.temperature[cell];
    double moles = 0.0;
    for (int k = 0; k < n; ++k) moles += X_[k] = std::max(Y[k], 0.0) / molecularWeights[k];
    for (double& x : X_) x /= moles;
    const std::span<double> D{massDiffusivity.data() + static_cast<std::ptrdiff_t>(cell) * n,
                              static_cast<std::size_t>(n)};
    const auto mixture = context.transport.mixture(T, state.thermodynamicPressure, X_, D);
    for (double& d : D) d *= state.density[cell];
    viscosity[cell] = mixture.viscosity;
    conductivity[cell] = mixture.conductivity;
    if (multicomponent_)
      conductivity[cell] = multicomponent_->mixture(T, state.thermodynamicPressure, X_, DT_).conductivity;
    else if (model.soret)
      context.transport.thermalDiffusion(T, state.thermodynamicPressure, X_, DT_);
    if (model.soret) std::ranges::copy(DT_, &thermalDiffusion[static_cast<std::size_t>(cell) * n]);
    heatCapacity[cell] = context.thermo.cpMass(T, Y);
    molecularWeight[cell] = context.thermo.meanMolecularWeight(Y);
  }
}

}  // namespace lampblack::flow
