#include "flow/equations/species_diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flow/discretisation/face_fluxes.hpp"

namespace lampblack::flow {

SpeciesDiffusion::SpeciesDiffusion(const FlowContext& context, ImplicitDiffusion& diffusion)
    : context_(context),
      diffusion_(diffusion),
      row_(context.mechanism.numSpecies()),
      startRow_(context.mechanism.numSpecies()) {
  if (context.transportModel.isMulticomponent() || context.transportModel.soret) detailed_.emplace(context);
  if (context.mesh.isOblique()) oblique_.emplace(context);
}

const double* SpeciesDiffusion::diffusivity(const Coefficients& of, int cell) const {
  const std::vector<double>& all = of.ofStart.empty() ? properties_->massDiffusivity : of.ofStart;
  return &all[static_cast<std::size_t>(cell) * context_.mechanism.numSpecies()];
}

void SpeciesDiffusion::conductance(int face, std::span<const int> species, double* g) const {
  const Mesh& m = context_.mesh;
  const double metric = m.area[face] / m.distance[face];
  const double* low = diffusivity(now_, m.low[face]);
  if (m.high[face] >= 0) {
    const double* high = diffusivity(now_, m.high[face]);
    const double ofLow = metric * m.lowWeight[face], ofHigh = metric * (1.0 - m.lowWeight[face]);
    for (std::size_t i = 0; i < species.size(); ++i) g[i] = ofLow * low[species[i]] + ofHigh * high[species[i]];
  } else {
    const double share = context_.isCompositionGiven(face) ? metric : 0.0;
    for (std::size_t i = 0; i < species.size(); ++i) g[i] = share * low[species[i]];
  }
  const std::vector<double>& eddies = properties_->eddyDiffusivity;
  if (eddies.empty() || (m.high[face] < 0 && !context_.isCompositionGiven(face))) return;
  for (std::size_t i = 0; i < species.size(); ++i) g[i] += metric * ofEddies(eddies, face);
}

bool SpeciesDiffusion::flux(const Coefficients& of, int face, std::span<const double> Y, std::span<double> row) const {
  if (!molecularFlux(of, face, Y, row)) return false;
  const std::vector<double>& eddies = of.ofStart.empty() ? properties_->eddyDiffusivity : of.eddiesOfStart;
  if (eddies.empty()) return true;
  const Mesh& m = context_.mesh;
  const std::size_t n = row.size();
  const bool isInside = m.high[face] >= 0;
  const double* low = &Y[static_cast<std::size_t>(m.low[face]) * n];
  const double* high = isInside ? &Y[static_cast<std::size_t>(m.high[face]) * n] : context_.boundaryY(face).data();
  const double g = m.area[face] / m.distance[face] * ofEddies(eddies, face);
  for (std::size_t k = 0; k < n; ++k) row[k] -= g * (high[k] - low[k]);
  return true;
}

// kg/m/s, at a face.
double SpeciesDiffusion::ofEddies(const std::vector<double>& eddies, int face) const {
  const Mesh& m = context_.mesh;
  const double w = m.lowWeight[face];
  return m.high[face] < 0 ? eddies[m.low[face]] : w * eddies[m.low[face]] + (1.0 - w) * eddies[m.high[face]];
}

bool SpeciesDiffusion::molecularFlux(const Coefficients& of, int face, std::span<const double> Y,
                                     std::span<double> row) const {
  const Mesh& m = context_.mesh;
  const std::size_t n = row.size();
  const bool isInside = m.high[face] >= 0;
  if (!isInside && !context_.isCompositionGiven(face)) {
    std::ranges::fill(row, 0.0);
    return false;
  }
  const double* low = &Y[static_cast<std::size_t>(m.low[face]) * n];
  const double* high = isInside ? &Y[static_cast<std::size_t>(m.high[face]) * n] : context_.boundaryY(face).data();
  const double* lowD = diffusivity(of, m.low[face]);
  const double* highD = isInside ? diffusivity(of, m.high[face]) : lowD;
  // At a boundary the gas is that beyond it, its diffusivity the cell's.
  const double w = isInside ? m.lowWeight[face] : 0.0;
  const double metric = m.area[face] / m.distance[face];
  const double slope = of.weightSlope[face];
  double net = 0.0, sumY = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double g = metric * (w * lowD[k] + (1.0 - w) * highD[k]);
    const double y = w * low[k] + (1.0 - w) * high[k];
    row[k] = -g * ((high[k] - low[k]) + y * slope);
    net += row[k];
    sumY += y;
  }
  const double correction = -net / sumY;
  for (std::size_t k = 0; k < n; ++k) row[k] += (w * low[k] + (1.0 - w) * high[k]) * correction;
  if (!of.ofDetails.empty()) {
    const double* details = &of.ofDetails[static_cast<std::size_t>(face) * n];
    for (std::size_t k = 0; k < n; ++k) row[k] += details[k];
  }
  return true;
}

bool SpeciesDiffusion::flux(int face, std::span<const double> Y, std::span<double> row) const {
  return flux(now_, face, Y, row);
}

void SpeciesDiffusion::prepare(const State& state, const GasProperties& properties) {
  const Mesh& m = context_.mesh;
  properties_ = &properties;
  now_.weightSlope.assign(m.faces, 0.0);
  now_.ofDetails.clear();
  if (!context_.transportModel.hasLewisNumbers())
    for (int face = 0; face < m.faces; ++face) {
      const double low = properties.molecularWeight[m.low[face]];
      if (m.high[face] >= 0)
        now_.weightSlope[face] = std::log(properties.molecularWeight[m.high[face]] / low);
      else if (context_.isCompositionGiven(face))
        now_.weightSlope[face] = std::log(context_.thermo.meanMolecularWeight(context_.boundaryY(face)) / low);
    }
  if (!detailed_ && !oblique_) return;
  const std::size_t n = row_.size();
  std::vector<double> details(static_cast<std::size_t>(m.faces) * n, 0.0);
  if (context_.transportModel.isMulticomponent())
    for (int face = 0; face < m.faces; ++face) {
      molecularFlux(now_, face, state.Y, row_);
      for (std::size_t k = 0; k < n; ++k) details[face * n + k] = -row_[k];
    }
  if (detailed_) detailed_->addFlux(state, properties, details);
  if (oblique_) oblique_->addFlux(state, properties, details);
  now_.ofDetails = std::move(details);
}

void SpeciesDiffusion::keepStart() {
  start_ = now_;
  start_.ofStart = properties_->massDiffusivity;
  start_.eddiesOfStart = properties_->eddyDiffusivity;
}

void SpeciesDiffusion::correct(std::span<const double> start, int face, double present, std::span<double> row) const {
  flux(start_, face, start, startRow_);
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = 0.5 * startRow_[k] + present * row[k];
}

int SpeciesDiffusion::advance(const Gas& gas, double dt, const Sink& sink) {
  const Mesh& m = context_.mesh;
  const std::size_t n = row_.size();
  const bool isCorrected = !gas.start.empty();
  // At what rate the contents change by everything else and by the guess's diffusion.
  const std::span<double> Y = gas.solution;
  inertia_.resize(static_cast<std::size_t>(m.owned));
  for (int c = 0; c < m.owned; ++c) {
    inertia_[c] = gas.mass[c] / dt;
    for (std::size_t i = c * n; i < (c + 1) * n; ++i) Y[i] = gas.content[i] / dt - inertia_[c] * gas.guess[i];
  }
  for (int face = 0; face < m.faces; ++face) {
    if (!flux(face, gas.guess, row_)) continue;
    if (isCorrected) correct(gas.start, face, 0.5, row_);
    addFaceFlux(m, face, row_, 1.0, Y);
  }
  const auto through = [this](int face, std::span<const int> species, double* g) { conductance(face, species, g); };
  const auto result = diffusion_.changes(static_cast<int>(n), inertia_, through, Y);
  for (std::size_t i = 0; i < Y.size(); ++i) Y[i] += gas.guess[i];

  std::vector<double> found(isCorrected ? n : 0);
  for (int face = 0; face < m.faces; ++face) {
    if (!flux(face, Y, row_)) continue;
    if (isCorrected) {
      found = row_;
      flux(face, gas.guess, row_);
      correct(gas.start, face, -0.5, row_);
      for (std::size_t k = 0; k < n; ++k) row_[k] += found[k];
    }
    addFaceFlux(m, face, row_, dt, gas.content);
    sink(face, row_);
  }
  return result.iterations;
}

}  // namespace lampblack::flow
