#include "flow/discretisation/oblique_diffusion.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::flow {

ObliqueDiffusion::ObliqueDiffusion(const FlowContext& context)
    : context_(context),
      gradient_(context.mesh),
      YGradient_(context, static_cast<int>(context.mechanism.numSpecies())) {
  const Mesh& m = context.mesh;
  const std::size_t n = context.mechanism.numSpecies();
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryKind kind = context.boundaryOf(face).kind;
    known_.push_back(context.isCompositionGiven(face)                               ? BoundaryData::Value
                     : kind == BoundaryKind::Wall || kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                                                    : BoundaryData::Nothing);
  }
  boundaryY_.resize(known_.size() * n);
  boundaryLogWeight_.resize(known_.size());
  logWeight_.resize(static_cast<std::size_t>(m.cells));
  logWeightGradient_.resize(logWeight_.size() * static_cast<std::size_t>(m.dimension));
  for (std::vector<double>* row : {&lowSlope_, &highSlope_, &flux_}) row->resize(n);
}

void ObliqueDiffusion::addFlux(const State& state, const GasProperties& properties, std::span<double> flux) {
  const Mesh& m = context_.mesh;
  const std::size_t n = flux_.size();
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    if (known_[b] != BoundaryData::Value) continue;
    const std::vector<double>& Y = context_.boundaryY(face);
    std::ranges::copy(Y, &boundaryY_[b * n]);
    boundaryLogWeight_[b] = std::log(context_.thermo.meanMolecularWeight(Y));
  }
  YGradient_.prepare(state.Y, boundaryY_, known_);
  const bool isOfMoles = !context_.transportModel.hasLewisNumbers();
  if (isOfMoles) {
    for (int c = 0; c < m.cells; ++c) logWeight_[c] = std::log(properties.molecularWeight[c]);
    gradient_.compute(logWeight_, boundaryLogWeight_, 1, logWeightGradient_, known_);
    context_.halo.update(logWeightGradient_, m.dimension);
  }
  for (int face = 0; face < m.faces; ++face) {
    const Vector3& oblique = m.oblique[face];
    const bool isInside = m.high[face] >= 0;
    if (oblique == Vector3{} || (!isInside && !context_.isCompositionGiven(face))) continue;
    const int low = m.low[face], high = isInside ? m.high[face] : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    YGradient_.along(oblique, low, lowSlope_);
    if (isInside) YGradient_.along(oblique, high, highSlope_);
    const double weightSlope = isOfMoles ? faceSlope(m, face, oblique, logWeightGradient_) : 0.0;
    const double* lowD = &properties.massDiffusivity[static_cast<std::size_t>(low) * n];
    const double* highD = &properties.massDiffusivity[static_cast<std::size_t>(high) * n];
    const double* lowY = &state.Y[static_cast<std::size_t>(low) * n];
    const double* highY = isInside ? &state.Y[static_cast<std::size_t>(high) * n] : context_.boundaryY(face).data();
    const double ofY = isInside ? w : 0.0;
    double eddies = 0.0;
    if (const std::vector<double>& of = properties.eddyDiffusivity; !of.empty())
      eddies = w * of[low] + (1.0 - w) * of[high];
    double net = 0.0, sumY = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double y = ofY * lowY[k] + (1.0 - ofY) * highY[k];
      const double slope = isInside ? w * lowSlope_[k] + (1.0 - w) * highSlope_[k] : lowSlope_[k];
      flux_[k] = -m.area[face] * (w * lowD[k] + (1.0 - w) * highD[k]) * (slope + y * weightSlope);
      if (eddies > 0.0) flux_[k] -= m.area[face] * eddies * slope;
      net += flux_[k];
      sumY += y;
    }
    for (std::size_t k = 0; k < n; ++k)
      flux[face * n + k] += flux_[k] - net / sumY * (ofY * lowY[k] + (1.0 - ofY) * highY[k]);
  }
}

}  // namespace lampblack::flow
