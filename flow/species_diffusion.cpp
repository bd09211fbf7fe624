#include "flow/species_diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

void SpeciesDiffusion::setUpBlock(int first, int count, std::span<const double> content,
                                  std::span<const double> newMass, double dt, std::span<const double> flux) {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::ptrdiff_t>(context_.mechanism.numSpecies());
  const auto width = static_cast<std::size_t>(count);
  blockDiagonal_.resize(m.owned * width);
  blockSource_.resize(m.owned * width);
  blockConductance_.resize(m.interiorFaces * width);
  blockSolution_.resize(m.cells * width);
  for (int c = 0; c < m.cells; ++c) std::copy_n(&solution_[c * n + first], count, &blockSolution_[c * width]);
  for (int c = 0; c < m.owned; ++c) {
    std::fill_n(&blockDiagonal_[c * width], count, newMass[c] / dt);
    for (std::size_t k = 0; k < width; ++k) blockSource_[c * width + k] = content[c * n + first + k] / dt;
  }
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double* f = &flux[face * n + first];
    const double* g = &conductance_[face * n + first];
    if (low < m.owned)
      for (std::size_t k = 0; k < width; ++k) blockSource_[low * width + k] -= f[k];
    if (high >= 0) {
      std::copy_n(g, count, &blockConductance_[face * width]);
      if (high < m.owned)
        for (std::size_t k = 0; k < width; ++k) blockSource_[high * width + k] += f[k];
    } else if (context_.isCompositionGiven(face)) {
      const double* given = &context_.boundaryY(face)[static_cast<std::size_t>(first)];
      for (std::size_t k = 0; k < width; ++k) {
        blockDiagonal_[low * width + k] += g[k];
        blockSource_[low * width + k] += g[k] * given[k];
      }
    }
  }
}

ImplicitDiffusion::Result SpeciesDiffusion::implicitFlux(const State& guess, std::span<const double> content,
                                                         std::span<const double> newMass, double dt,
                                                         std::span<double> flux) {
  const int n = guess.species;
  evaluate(guess.Y, false, flux);
  solution_.assign(guess.Y.begin(), guess.Y.end());
  ImplicitDiffusion::Result result;
  for (int first = 0; first < n; first += block) {
    const int count = std::min(block, n - first);
    setUpBlock(first, count, content, newMass, dt, flux);
    const auto solved = diffusion_.solve(count, blockDiagonal_, blockConductance_, blockSource_, blockSolution_);
    result.iterations = std::max(result.iterations, solved.iterations);
    result.worstResidual = std::max(result.worstResidual, solved.worstResidual);
    for (int c = 0; c < context_.mesh.cells; ++c)
      std::copy_n(&blockSolution_[static_cast<std::size_t>(c) * count], count,
                  &solution_[static_cast<std::size_t>(c) * n + first]);
  }
  evaluate(solution_, true, flux);
  return result;
}

}  // namespace lampblack::flow
