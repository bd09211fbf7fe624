#include "flow/flame/flame_jacobian.hpp"

namespace lampblack::flow {

void FaceDerivatives::side(const FlameEquations::Data& data, std::size_t f, bool isRight) {
  const std::size_t n = data.species(), i = isRight ? f + 1 : f;
  const FlameFaces& faces = data.gas.faces;
  const auto& weights = data.gas.weights;
  const double sign = isRight ? 1 : -1;
  const double W = data.gas.nodes.weight[i];
  const double* X = &data.gas.nodes.X[i * n];
  double* out = isRight ? right.data() : left.data();
  const double* a = &faces.conductance[f * n];

  // scaled_[k]: what every column has in proportion to W/W_j; sum_[j]: the change of the sum of all fluxes.
  if (data.gas.multicomponent()) {
    const double* G = &faces.pairs[f * n * n];
    for (std::size_t k = 0; k < n; ++k) {
      double sum = 0;
      for (std::size_t l = 0; l < n; ++l) sum += G[k * n + l] * X[l];
      scaled_[k] = sum;
    }
    for (std::size_t j = 0; j < n; ++j) {
      const double w = W / weights[j];
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double value = sign * (G[k * n + j] - scaled_[k]) * w;
        out[j * n + k] = value;
        sum += value;
      }
      sum_[j] = sum;
    }
  } else if (data.gas.massBasis()) {
    std::fill(out, out + n * n, 0.0);
    for (std::size_t j = 0; j < n; ++j) out[j * n + j] = sum_[j] = -sign * a[j];
  } else {
    double mean = 0;
    for (std::size_t k = 0; k < n; ++k) mean += scaled_[k] = a[k] * X[k];
    for (std::size_t j = 0; j < n; ++j) {
      const double w = sign * W / weights[j];
      double* column = out + j * n;
      for (std::size_t k = 0; k < n; ++k) column[k] = scaled_[k] * w;
      column[j] -= a[j] * w;
      sum_[j] = -w * (a[j] - mean);
    }
  }
  const auto Yl = data.profile.massFractions(f), Yr = data.profile.massFractions(f + 1);
  const double m = data.profile.at(f, FlameLayout::massFlux);
  const double lean = faces.lean(f, m);
  const double own = m * (isRight ? 0.5 - lean : 0.5 + lean) - 0.5 * faces.excess[f];
  for (std::size_t j = 0; j < n; ++j) {
    double* column = out + j * n;
    const double sum = 0.5 * sum_[j];
    for (std::size_t k = 0; k < n; ++k) column[k] -= (Yl[k] + Yr[k]) * sum;
    column[j] += own;
  }
}

void FaceDerivatives::compute(const FlameEquations::Data& data, std::size_t f) {
  const std::size_t n = data.species();
  for (auto* v : {&left, &right}) v->resize(n * n);
  for (auto* v : {&leftTemperature, &rightTemperature, &massFlux, &sum_, &scaled_}) v->resize(n);
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
