#include "chemistry/reactor_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lampblack {

namespace {

// sum_k a_k b_k with four running sums, which the processor can add side by side.
double dot(const double* __restrict a, const double* __restrict b, std::size_t n) {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    s0 += a[k] * b[k];
    s1 += a[k + 1] * b[k + 1];
    s2 += a[k + 2] * b[k + 2];
    s3 += a[k + 3] * b[k + 3];
  }
  for (; k < n; ++k) s0 += a[k] * b[k];
  return (s0 + s1) + (s2 + s3);
}

}  // namespace

ReactorSystem::ReactorSystem(const Mechanism& mechanism)
    : thermo_(mechanism),
      kinetics_(mechanism),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()) {
  for (const double W : weights_) {
    inverseWeights_.push_back(1.0 / W);
    gasConstants_.push_back(constants::gasConstant / W);
  }
  for (auto* work : {&source_, &c_, &wdot_, &energy_, &capacity_, &capacitySlope_, &excess_, &byT_})
    work->assign(weights_.size(), 0.0);
}

void ReactorSystem::setConditions(const Conditions& conditions) {
  conditions_ = conditions;
  if (conditions.source.empty())
    std::fill(source_.begin(), source_.end(), 0.0);
  else
    std::copy(conditions.source.begin(), conditions.source.end(), source_.begin());
  conditions_.source = {};
}

void ReactorSystem::setConditions(double pressure, std::span<const double> source) {
  Conditions conditions;
  conditions.value = pressure;
  conditions.source = source;
  setConditions(conditions);
}

// Density, pressure and concentrations.
bool ReactorSystem::prepare(const double* y) {
  const std::size_t n = weights_.size();
  const double T = y[n];
  if (!(T >= Thermo::minTemperature && T <= Thermo::maxTemperature)) return false;
  const double moles = dot(y, inverseWeights_.data(), n);
  if (!(moles > 0) || !std::isfinite(moles)) return false;
  meanWeight_ = 1.0 / moles;
  const double massPerPressure = meanWeight_ / (constants::gasConstant * T);
  const bool pressureHeld = conditions_.held == Held::Pressure;
  density_ = pressureHeld ? conditions_.value * massPerPressure : conditions_.value;
  pressure_ = pressureHeld ? conditions_.value : conditions_.value / massPerPressure;
  const double rho = density_;
  const double* __restrict inverse = inverseWeights_.data();
  double* __restrict c = c_.data();
  for (std::size_t k = 0; k < n; ++k) c[k] = y[k] * rho * inverse[k];
  return true;
}

// What dT/dt weighs the change of composition with, and the heat capacity that goes with it.
void ReactorSystem::speciesEnergies(double T) {
  thermo_.speciesEnthalpies(T, energy_);
  thermo_.speciesCp(T, capacity_);
  if (conditions_.held == Held::Pressure) return;
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    energy_[k] -= gasConstants_[k] * T;
    capacity_[k] -= gasConstants_[k];
  }
}

bool ReactorSystem::chemicalRates(const double* y, double* f) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  kinetics_.netProductionRates(y[n], c_, wdot_);
  const double volume = 1.0 / density_;
  for (std::size_t k = 0; k < n; ++k) f[k] = wdot_[k] * weights_[k] * volume;
  return true;
}

// dT/dt from the finished dY/dt in f and speciesEnergies().
double ReactorSystem::temperatureSlope(const double* y, const double* f) {
  if (conditions_.energy == Energy::GivenTemperature) return conditions_.temperatureRate;
  const std::size_t n = weights_.size();
  double supply = conditions_.heating;
  if (conditions_.removal != 0) supply -= conditions_.removal * dot(energy_.data(), y, n);
  return (supply - dot(energy_.data(), f, n)) / dot(capacity_.data(), y, n);
}

bool ReactorSystem::rates(const double* y, double* f) {
  if (!chemicalRates(y, f)) return false;
  const std::size_t n = weights_.size();
  const double removal = conditions_.removal;
  for (std::size_t k = 0; k < n; ++k) f[k] += source_[k] - removal * y[k];
  if (conditions_.energy == Energy::Conserved) speciesEnergies(y[n]);
  f[n] = temperatureSlope(y, f);
  return std::isfinite(f[n]);
}

// With A = d wdot/dc at constant T and s = A c. Constant density:
//   d(W_k wdot_k/rho)/dY_j = W_k/W_j A_kj                           d(W_k wdot_k/rho)/dT = W_k/rho d wdot_k/dT
// At constant pressure rho ~ Wbar/T adds
//   W_k/W_j (Wbar/rho)(wdot_k - s_k)                          and   W_k/rho (wdot_k - s_k)/T.
bool ReactorSystem::jacobian(const double* y, double* f, double* J, std::size_t ld) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  const double T = y[n], volume = 1.0 / density_;
  kinetics_.netProductionRatesAndJacobian(T, c_, wdot_, {J, ld * n}, byT_, ld);
  speciesEnergies(T);
  double* __restrict excess = excess_.data();
  std::fill(excess_.begin(), excess_.end(), 0.0);
  double* __restrict last = J + n * ld;
  const double* __restrict W = weights_.data();
  if (conditions_.held == Held::Pressure) {
    for (std::size_t j = 0; j < n; ++j) {
      const double c = c_[j];
      if (c == 0) continue;
      const double* __restrict A = J + j * ld;
      for (std::size_t k = 0; k < n; ++k) excess[k] -= A[k] * c;
    }
    for (std::size_t k = 0; k < n; ++k) {
      excess[k] += wdot_[k];
      last[k] = W[k] * volume * (byT_[k] + excess[k] / T);
      excess[k] *= meanWeight_ * volume;
    }
  } else {
    for (std::size_t k = 0; k < n; ++k) last[k] = W[k] * volume * byT_[k];
  }
  for (std::size_t k = 0; k < n; ++k) f[k] = wdot_[k] * W[k] * volume + source_[k] - conditions_.removal * y[k];
  f[n] = temperatureSlope(y, f);
  speciesBlock(J, ld);
  temperatureRow(y, f, J, ld);
  if (conditions_.removal != 0)
    for (std::size_t k = 0; k < n; ++k) J[k + k * ld] -= conditions_.removal;
  return std::isfinite(f[n]);
}

// d wdot/dc becomes the derivative by mass fractions, without the removal.
void ReactorSystem::speciesBlock(double* J, std::size_t ld) const {
  const std::size_t n = weights_.size();
  const double* __restrict W = weights_.data();
  const double* __restrict excess = excess_.data();
  for (std::size_t j = 0; j < n; ++j) {
    double* __restrict column = J + j * ld;
    const double inverse = inverseWeights_[j];
    for (std::size_t k = 0; k < n; ++k) column[k] = W[k] * inverse * (column[k] + excess[k]);
  }
}

// From C dT/dt = q - r e - sum_k e_k f_k. The terms of r cancel: -r e_j against -sum_k e_k (-r delta_kj), and -r C
// against -sum_k C_k (-r Y_k).
void ReactorSystem::temperatureRow(const double* y, const double* f, double* J, std::size_t ld) {
  const std::size_t n = weights_.size();
  if (conditions_.energy == Energy::GivenTemperature) {
    for (std::size_t j = 0; j <= n; ++j) J[n + j * ld] = 0;
    return;
  }
  const double slope = f[n], inverseCapacity = 1.0 / dot(capacity_.data(), y, n);
  for (std::size_t j = 0; j < n; ++j)
    J[n + j * ld] = -inverseCapacity * (dot(energy_.data(), J + j * ld, n) + capacity_[j] * slope);
  thermo_.speciesCpSlope(y[n], capacitySlope_);
  const double closed = dot(capacity_.data(), f, n) + conditions_.removal * dot(capacity_.data(), y, n);
  J[n + n * ld] =
      -inverseCapacity * (closed + dot(energy_.data(), J + n * ld, n) + dot(capacitySlope_.data(), y, n) * slope);
}

}  // namespace lampblack
