#include "flow/flame/flame_jacobian.hpp"

namespace lampblack::flow {

void FaceDerivatives::side(const FlameEquations::Data& data, std::size_t f, bool isRight) {
  const std::size_t n = data.species(), i = isRight ? f + 1 : f;
  const FlameFaces& faces = data.gas.faces;
  const auto& weights = data.gas.weights;
  const double sign = isRight ? 1 : -1;
  const double W = data.gas.nodes.weight[i];
  const double* X = &data.gas.nodes.X[i * n];
  FluxDerivatives& of = isRight ? right : left;
  double* out = of.entries.data();
  const double* a = &faces.conductance[f * n];
  auto &scaled = of.meanWeight, &with = of.meanWeightWith, &sum = of.sumWith;

  // scaled[k]: what every column has in proportion to with[j], W/W_j; sum[j]: half the change of the sum of all fluxes.
  for (std::size_t j = 0; j < n; ++j) with[j] = sign * W / weights[j];
  if (data.gas.multicomponent()) {
    const double* G = &faces.pairs[f * n * n];
    for (std::size_t k = 0; k < n; ++k) {
      double all = 0;
      for (std::size_t l = 0; l < n; ++l) all += G[k * n + l] * X[l];
      scaled[k] = all;
    }
    for (std::size_t j = 0; j < n; ++j) {
      sum[j] = 0;
      for (std::size_t k = 0; k < n; ++k) sum[j] += 0.5 * (out[j * n + k] = (G[k * n + j] - scaled[k]) * with[j]);
    }
  } else if (data.gas.massBasis()) {
    std::fill(of.entries.begin(), of.entries.end(), 0.0);
    std::fill(scaled.begin(), scaled.end(), 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      out[j * n + j] = of.diagonal[j] = -sign * a[j];
      sum[j] = 0.5 * of.diagonal[j];
    }
  } else {
    double mean = 0;
    for (std::size_t k = 0; k < n; ++k) mean += scaled[k] = a[k] * X[k];
    for (std::size_t j = 0; j < n; ++j) {
      double* column = out + j * n;
      for (std::size_t k = 0; k < n; ++k) column[k] = scaled[k] * with[j];
      of.diagonal[j] = -a[j] * with[j];
      column[j] += of.diagonal[j];
      sum[j] = -0.5 * with[j] * (a[j] - mean);
    }
  }
  const auto Yl = data.profile.massFractions(f), Yr = data.profile.massFractions(f + 1);
  const double m = data.profile.at(f, FlameLayout::massFlux);
  const double lean = faces.lean(f, m);
  const double own = m * (isRight ? 0.5 - lean : 0.5 + lean) - 0.5 * faces.excess[f];
  for (std::size_t k = 0; k < n; ++k) of.ofSum[k] = -(Yl[k] + Yr[k]);
  for (std::size_t j = 0; j < n; ++j) {
    double* column = out + j * n;
    for (std::size_t k = 0; k < n; ++k) column[k] += of.ofSum[k] * sum[j];
    column[j] += own;
    of.diagonal[j] += own;
  }
}

void FaceDerivatives::compute(const FlameEquations::Data& data, std::size_t f) {
  const std::size_t n = data.species();
  for (auto* of : {&left, &right}) {
    of->entries.resize(n * n);
    for (auto* v : {&of->diagonal, &of->meanWeight, &of->meanWeightWith, &of->ofSum, &of->sumWith}) v->resize(n);
  }
  for (auto* v : {&leftTemperature, &rightTemperature, &massFlux}) v->resize(n);
  side(data, f, false);
  side(data, f, true);
  const FlameFaces& faces = data.gas.faces;
  const double Tl = data.profile.temperature(f), Tr = data.profile.temperature(f + 1), T = 0.5 * (Tl + Tr);
  const double h = data.profile.z[f + 1] - data.profile.z[f];
  const double m = data.profile.at(f, FlameLayout::massFlux);
  const double lean = faces.lean(f, m);
  const auto Yl = data.profile.massFractions(f), Yr = data.profile.massFractions(f + 1);
  for (std::size_t k = 0; k < n; ++k) {
    massFlux[k] = (0.5 + lean) * Yl[k] + (0.5 - lean) * Yr[k];
    const double growth = 0.5 * conductanceExponent * faces.diffusion[f * n + k] / T;
    leftTemperature[k] = rightTemperature[k] = growth;
    if (data.problem.transport.soret) {
      const double DT = faces.thermal[f * n + k] / (h * T);
      leftTemperature[k] += DT * (1 + 0.5 * (Tr - Tl) / T);
      rightTemperature[k] += DT * (-1 + 0.5 * (Tr - Tl) / T);
    }
  }
}

}  // namespace lampblack::flow
