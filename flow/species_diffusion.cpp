#include "flow/species_diffusion.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::flow {

void SpeciesDiffusion::faceFlux(int face, bool gradientTerm, const double* low, const double* high, double lowWeight,
                                double* flux) const {
  const int n = static_cast<int>(context_.mechanism.numSpecies());
  const double* g = &conductance_[static_cast<std::size_t>(face) * n];
  const double slope = weightSlope_[face];
  double net = 0.0;
  double sumY = 0.0;
  for (int k = 0; k < n; ++k) {
    const double y = lowWeight * low[k] + (1.0 - lowWeight) * high[k];
    const double weightPart = -g[k] * y * slope;
    const double gradientPart = -g[k] * (high[k] - low[k]);
    flux[k] = gradientTerm ? gradientPart + weightPart : weightPart;
    net += gradientPart + weightPart;
    sumY += y;
  }
  const double correction = -net / sumY;
  for (int k = 0; k < n; ++k) flux[k] += (lowWeight * low[k] + (1.0 - lowWeight) * high[k]) * correction;
}

ImplicitDiffusion::Result SpeciesDiffusion::computeFlux(const State& state, const GasProperties& properties,
                                                        std::span<const double> content,
                                                        std::span<const double> newMass, double dt,
                                                        std::span<double> flux) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const auto at = [n](int i) { return static_cast<std::size_t>(i) * n; };
  conductance_.assign(at(m.faces), 0.0);
  weightSlope_.assign(m.faces, 0.0);
  diagonal_.resize(at(m.owned));
  source_.resize(at(m.owned));
  for (int c = 0; c < m.owned; ++c)
    for (int k = 0; k < n; ++k) {
      diagonal_[at(c) + k] = newMass[c] / dt;
      source_[at(c) + k] = content[at(c) + k] / dt;
    }

  const auto dirichlet = [&](int face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    return boundary.kind == BoundaryKind::Inlet && boundary.fixedComposition;
  };
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double metric = m.area[face] / m.distance[face];
    double* g = &conductance_[at(face)];
    double* explicitFlux = &flux[at(face)];
    std::fill_n(explicitFlux, n, 0.0);
    if (high >= 0) {
      const double w = m.lowWeight[face];
      for (int k = 0; k < n; ++k)
        g[k] = metric *
               (w * properties.massDiffusivity[at(low) + k] + (1.0 - w) * properties.massDiffusivity[at(high) + k]);
      weightSlope_[face] = std::log(properties.molecularWeight[high] / properties.molecularWeight[low]);
      faceFlux(face, false, &state.Y[at(low)], &state.Y[at(high)], w, explicitFlux);
    } else if (dirichlet(face)) {
      const std::vector<double>& given = context_.boundaryOf(face).Y;
      for (int k = 0; k < n; ++k) g[k] = metric * properties.massDiffusivity[at(low) + k];
      weightSlope_[face] = std::log(context_.thermo.meanMolecularWeight(given) / properties.molecularWeight[low]);
      faceFlux(face, false, &state.Y[at(low)], given.data(), 0.0, explicitFlux);
      for (int k = 0; k < n; ++k) {
        diagonal_[at(low) + k] += g[k];
        source_[at(low) + k] += g[k] * given[k];
      }
    }
    for (int k = 0; k < n; ++k) {
      if (low < m.owned) source_[at(low) + k] -= explicitFlux[k];
      if (high >= 0 && high < m.owned) source_[at(high) + k] += explicitFlux[k];
    }
  }
  solution_.assign(state.Y.begin(), state.Y.end());
  const auto result = diffusion_.solve(n, diagonal_, conductance_, source_, solution_);

  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    if (high >= 0)
      faceFlux(face, true, &solution_[at(low)], &solution_[at(high)], m.lowWeight[face], &flux[at(face)]);
    else if (dirichlet(face))
      faceFlux(face, true, &solution_[at(low)], context_.boundaryOf(face).Y.data(), 0.0, &flux[at(face)]);
  }
  return result;
}

}  // namespace lampblack::flow
