#include "flow/species_diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flow/face_fluxes.hpp"

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

void SpeciesDiffusion::prepare(const State& state, const GasProperties& properties) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const auto at = [n](int i) { return static_cast<std::size_t>(i) * n; };
  conductance_.assign(at(m.faces), 0.0);
  weightSlope_.assign(m.faces, 0.0);
  const bool alongMassFractions = context_.transportModel.hasLewisNumbers();
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double metric = m.area[face] / m.distance[face];
    double* g = &conductance_[at(face)];
    if (high >= 0) {
      const double w = m.lowWeight[face];
      for (int k = 0; k < n; ++k)
        g[k] = metric *
               (w * properties.massDiffusivity[at(low) + k] + (1.0 - w) * properties.massDiffusivity[at(high) + k]);
      if (!alongMassFractions)
        weightSlope_[face] = std::log(properties.molecularWeight[high] / properties.molecularWeight[low]);
    } else if (context_.isCompositionGiven(face)) {
      for (int k = 0; k < n; ++k) g[k] = metric * properties.massDiffusivity[at(low) + k];
      if (!alongMassFractions)
        weightSlope_[face] =
            std::log(context_.thermo.meanMolecularWeight(context_.boundaryY(face)) / properties.molecularWeight[low]);
    }
  }
  if (!detailed_) return;
  explicit_.clear();
  std::vector<double> flux(conductance_.size(), 0.0);
  if (context_.transportModel.isMulticomponent()) {
    evaluate(state.Y, true, flux);
    for (double& f : flux) f = -f;
  }
  detailed_->addFlux(state, properties, flux);
  explicit_ = std::move(flux);
}

void SpeciesDiffusion::evaluate(std::span<const double> Y, bool gradientTerm, std::span<double> flux) const {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(context_.mechanism.numSpecies());
  for (int face = 0; face < m.faces; ++face) {
    double* f = &flux[face * n];
    if (m.high[face] >= 0)
      faceFlux(face, gradientTerm, &Y[m.low[face] * n], &Y[m.high[face] * n], m.lowWeight[face], f);
    else if (context_.isCompositionGiven(face))
      faceFlux(face, gradientTerm, &Y[m.low[face] * n], context_.boundaryY(face).data(), 0.0, f);
    else
      std::fill_n(f, n, 0.0);
  }
  for (std::size_t i = 0; i < explicit_.size(); ++i) flux[i] += explicit_[i];
}

void SpeciesDiffusion::presentFlux(const State& state, std::span<double> flux) const {
  evaluate(state.Y, true, flux);
}

ImplicitDiffusion::Result SpeciesDiffusion::implicitFlux(const State& guess, std::span<const double> content,
                                                         std::span<const double> newMass, double dt,
                                                         std::span<double> flux) {
  const Mesh& m = context_.mesh;
  const int n = guess.species;
  const auto at = [n](int i) { return static_cast<std::size_t>(i) * n; };
  diagonal_.resize(at(m.owned));
  source_.resize(at(m.owned));
  for (int c = 0; c < m.owned; ++c)
    for (int k = 0; k < n; ++k) {
      diagonal_[at(c) + k] = newMass[c] / dt;
      source_[at(c) + k] = content[at(c) + k] / dt;
    }
  evaluate(guess.Y, false, flux);
  addFaceFluxes(m, flux, n, 1.0, source_);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (!context_.isCompositionGiven(face)) continue;
    const std::vector<double>& given = context_.boundaryY(face);
    for (int k = 0; k < n; ++k) {
      const double g = conductance_[at(face) + k];
      diagonal_[at(m.low[face]) + k] += g;
      source_[at(m.low[face]) + k] += g * given[k];
    }
  }
  solution_.assign(guess.Y.begin(), guess.Y.end());
  const auto result = diffusion_.solve(n, diagonal_, conductance_, source_, solution_);
  evaluate(solution_, true, flux);
  return result;
}

}  // namespace lampblack::flow
