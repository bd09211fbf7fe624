#include "chemistry/reactor_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lampblack {

ReactorSystem::ReactorSystem(const Mechanism& mechanism)
    : thermo_(mechanism),
      kinetics_(mechanism),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()) {
  for (const double W : weights_) inverseWeights_.push_back(1.0 / W);
  for (auto* work : {&source_, &c_, &wdot_, &h_, &cp_, &cpSlope_, &rowSum_, &byT_}) work->assign(weights_.size(), 0.0);
}

void ReactorSystem::setConditions(double pressure, std::span<const double> source) {
  pressure_ = pressure;
  hasSource_ = !source.empty();
  if (hasSource_)
    std::copy(source.begin(), source.end(), source_.begin());
  else
    std::fill(source_.begin(), source_.end(), 0.0);
}

// Density and concentrations.
bool ReactorSystem::prepare(const double* y) {
  const std::size_t n = weights_.size();
  const double T = y[n];
  if (!(T >= Thermo::minTemperature && T <= Thermo::maxTemperature)) return false;
  double moles = 0;
  for (std::size_t k = 0; k < n; ++k) moles += y[k] * inverseWeights_[k];
  if (!(moles > 0) || !std::isfinite(moles)) return false;
  meanWeight_ = 1.0 / moles;
  density_ = pressure_ * meanWeight_ / (constants::gasConstant * T);
  const double rho = density_;
  const double* __restrict inverse = inverseWeights_.data();
  double* __restrict c = c_.data();
  for (std::size_t k = 0; k < n; ++k) c[k] = y[k] * rho * inverse[k];
  return true;
}

bool ReactorSystem::chemicalRates(const double* y, double* f) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  kinetics_.netProductionRates(y[n], c_, wdot_);
  const double volume = 1.0 / density_;
  for (std::size_t k = 0; k < n; ++k) f[k] = wdot_[k] * weights_[k] * volume;
  return true;
}

bool ReactorSystem::rates(const double* y, double* f) {
  if (!chemicalRates(y, f)) return false;
  const std::size_t n = weights_.size();
  const double T = y[n];
  thermo_.speciesEnthalpies(T, h_);
  thermo_.speciesCp(T, cp_);
  double cp = 0, heat = 0;
  for (std::size_t k = 0; k < n; ++k) {
    f[k] += source_[k];
    cp += cp_[k] * y[k];
    heat += h_[k] * f[k];
  }
  f[n] = -heat / cp;
  return std::isfinite(f[n]);
}

// With A = d wdot/dc, s = A c, and rho ~ Wbar/T at constant pressure:
//   d(W_k wdot_k/rho)/dY_j = W_k/W_j [A_kj + (Wbar/rho)(wdot_k - s_k)]
//   d(W_k wdot_k/rho)/dT   = W_k/rho [d wdot_k/dT + (wdot_k - s_k)/T]
bool ReactorSystem::jacobian(const double* y, double* f, double* J, std::size_t ld) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  const double T = y[n];
  kinetics_.netProductionRatesAndJacobian(T, c_, wdot_, {J, ld * n}, byT_, ld);
  thermo_.speciesEnthalpies(T, h_);
  thermo_.speciesCp(T, cp_);
  thermo_.speciesCpSlope(T, cpSlope_);
  const double* __restrict W = weights_.data();
  double* __restrict excess = rowSum_.data();
  std::fill(rowSum_.begin(), rowSum_.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double c = c_[j];
    if (c == 0) continue;
    const double* __restrict A = J + j * ld;
    for (std::size_t k = 0; k < n; ++k) excess[k] += A[k] * c;
  }
  const double volume = 1.0 / density_;
  double cp = 0, heat = 0, heatByT = 0, cpByT = 0;
  double* __restrict last = J + n * ld;
  for (std::size_t k = 0; k < n; ++k) {
    excess[k] = wdot_[k] - excess[k];
    f[k] = wdot_[k] * W[k] * volume + source_[k];
    last[k] = W[k] * volume * (byT_[k] + excess[k] / T);
    cp += cp_[k] * y[k];
    cpByT += cpSlope_[k] * y[k];
    heat += h_[k] * f[k];
    heatByT += cp_[k] * f[k] + h_[k] * last[k];
    excess[k] *= meanWeight_ * volume;
  }
  const double inverseCp = 1.0 / cp;
  f[n] = -heat * inverseCp;
  const double* __restrict h = h_.data();
  for (std::size_t j = 0; j < n; ++j) {
    double* __restrict column = J + j * ld;
    const double inverse = inverseWeights_[j];
    for (std::size_t k = 0; k < n; ++k) column[k] = W[k] * inverse * (column[k] + excess[k]);
    double a = 0, b = 0, c = 0, d = 0;
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4) {
      a += h[k] * column[k];
      b += h[k + 1] * column[k + 1];
      c += h[k + 2] * column[k + 2];
      d += h[k + 3] * column[k + 3];
    }
    for (; k < n; ++k) a += h[k] * column[k];
    column[n] = -inverseCp * ((a + b) + (c + d) + cp_[j] * f[n]);
  }
  last[n] = -inverseCp * (heatByT + cpByT * f[n]);
  return std::isfinite(f[n]);
}

}  // namespace lampblack
