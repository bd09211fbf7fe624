#include "flow/equations/detailed_diffusion.hpp"

#include <cmath>

namespace lampblack::flow {

DetailedDiffusion::DetailedDiffusion(const FlowContext& context) : context_(context) {
  if (context.transportModel.isMulticomponent())
    multicomponent_.emplace(context.mechanism, context.transportModel.integrals);
  for (auto* work : {&X_, &step_, &flux_}) work->resize(context.mechanism.numSpecies());
}

// `metric`: area over distance, m.
void DetailedDiffusion::addOfFace(double p, const Side& low, const Side& high, double lowWeight, double metric,
                                  double* flux) {
  const std::size_t n = X_.size();
  if (multicomponent_) {
    for (std::size_t k = 0; k < n; ++k) {
      const double inverse = 1.0 / context_.mechanism.molecularWeights()[k];
      const double before = low.Y[k] * low.molecularWeight * inverse;
      const double behind = high.Y[k] * high.molecularWeight * inverse;
      X_[k] = lowWeight * before + (1.0 - lowWeight) * behind;
      step_[k] = metric * (behind - before);
    }
    const double T = lowWeight * low.temperature + (1.0 - lowWeight) * high.temperature;
    multicomponent_->diffusionFluxes(T, p, X_, step_, flux_);
    for (std::size_t k = 0; k < n; ++k) flux[k] += flux_[k];
  }
  if (low.thermalDiffusion == nullptr) return;
  const double warming = metric * std::log(high.temperature / low.temperature);
  for (std::size_t k = 0; k < n; ++k)
    flux[k] -= warming * (lowWeight * low.thermalDiffusion[k] + (1.0 - lowWeight) * high.thermalDiffusion[k]);
}

void DetailedDiffusion::addFlux(const State& state, const GasProperties& properties, std::span<double> flux) {
  const Mesh& m = context_.mesh;
  const std::size_t n = X_.size();
  const auto of = [&](int cell) -> Side {
    const std::size_t begin = static_cast<std::size_t>(cell) * n;
    return {&state.Y[begin], properties.thermalDiffusion.empty() ? nullptr : &properties.thermalDiffusion[begin],
            state.temperature[cell], properties.molecularWeight[cell]};
  };
  for (int face = 0; face < m.faces; ++face) {
    const Side low = of(m.low[face]);
    const double metric = m.area[face] / m.distance[face];
    double* f = &flux[static_cast<std::size_t>(face) * n];
    if (m.high[face] >= 0) {
      addOfFace(state.thermodynamicPressure, low, of(m.high[face]), m.lowWeight[face], metric, f);
    } else if (context_.isCompositionGiven(face)) {
      const std::vector<double>& Y = context_.boundaryY(face);
      const Side beyond{Y.data(), low.thermalDiffusion, context_.boundaryTemperature(face),
                        context_.thermo.meanMolecularWeight(Y)};
      addOfFace(state.thermodynamicPressure, low, beyond, 0.0, metric, f);
    }
  }
}

}  // namespace lampblack::flow
