// Derivatives of the reactor equations. With A = d wdot/dc at constant T and s = A c, at constant density
//   d(W_k wdot_k/rho)/dY_j = W_k/W_j A_kj                           d(W_k wdot_k/rho)/dT = W_k/rho d wdot_k/dT,
// to which rho ~ Wbar/T adds at constant pressure
//   W_k/W_j (Wbar/rho)(wdot_k - s_k)                          and   W_k/rho (wdot_k - s_k)/T.
// In both the part of A that is the same for all columns, and the added one, are products with 1/W_j.
//
// C dT/dt = q - r e - sum_k e_k f_k, where e and C are enthalpy and cp or internal energy and cv, gives the row of the
// temperature from the rows of the species without their removal: -r e_j cancels against -sum_k e_k (-r delta_kj), and
// -r C against -sum_k C_k (-r Y_k).
#include <algorithm>

#include "chemistry/reactor/reactor_system.hpp"
#include "core/errors.hpp"
#include "numerics/dot.hpp"

namespace lampblack::chemistry {

// From excess_ = s to what constant pressure adds, in units of A; zero at constant density. Leaves the column of the
// temperature, its last entry excepted.
void ReactorSystem::finishExcess(double T, double* temperatureColumn) {
  const std::size_t n = weights_.size();
  const double volume = 1.0 / density_;
  const double* __restrict W = weights_.data();
  const double* __restrict byT = byT_.data();
  const double* __restrict wdot = wdot_.data();
  double* __restrict excess = excess_.data();
  double* __restrict column = temperatureColumn;
  const double byComposition = conditions_.held == Held::Pressure ? meanWeight_ * volume : 0.0;
  const double byTemperature = conditions_.held == Held::Pressure ? 1.0 / T : 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double difference = wdot[k] - excess[k];
    column[k] = W[k] * volume * (byT[k] + difference * byTemperature);
    excess[k] = difference * byComposition;
  }
}

// f from the production rates, the energies of the species, and the mixture's heat capacity.
bool ReactorSystem::finishRates(const double* y, double* f) {
  const std::size_t n = weights_.size();
  const double volume = 1.0 / density_;
  for (std::size_t k = 0; k < n; ++k)
    f[k] = wdot_[k] * weights_[k] * volume + source_[k] - (conditions_.removal + loss_[k]) * y[k];
  const bool given = conditions_.energy == Energy::GivenTemperature;
  if (carried_ != nullptr && !addCarriedRates(y, f)) return false;
  if (!given) speciesEnergies(y[n]);
  inverseCapacity_ = given ? 0.0 : 1.0 / heatCapacity(y);
  f[n] = temperatureSlope(y, f);
  return true;
}

double ReactorSystem::temperatureDiagonal(const double* y, const double* f, const double* temperatureColumn) {
  const std::size_t n = weights_.size();
  if (inverseCapacity_ == 0) return 0;
  thermo_.speciesCpSlope(y[n], capacitySlope_);
  double closed = dot(capacity_.data(), f, n) + conditions_.removal * dot(capacity_.data(), y, n);
  // Without the slope of its heat capacity: a small part of a small part.
  if (const std::size_t count = numCarried(); count > 0)
    closed += dot(carriedCapacity_.data(), f + n + 1, count) +
              conditions_.removal * dot(carriedCapacity_.data(), y + n + 1, count) +
              dot(carriedEnergy_.data(), temperatureColumn + n + 1, count);
  const double work = conditions_.expansion * pressure_ / density_ / y[n];  // e p/rho by T
  return -inverseCapacity_ *
         (closed + work + dot(energy_.data(), temperatureColumn, n) + dot(capacitySlope_.data(), y, n) * f[n]);
}

bool ReactorSystem::jacobian(const double* y, double* f, double* J, std::size_t ld) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  try {
    if (conditions_.reacts) {
      kinetics_.netProductionRatesAndJacobian(y[n], c_, wdot_, {J, ld * n}, byT_, ld);
    } else {
      std::fill_n(J, ld * n, 0.0);
      std::fill(wdot_.begin(), wdot_.end(), 0.0);
      std::fill(byT_.begin(), byT_.end(), 0.0);
    }
  } catch (const NumericsError& error) {
    return refuse(error.what());
  }
  for (const std::span<double> part : {std::span(wdot_), std::span(byT_), std::span(J, ld * n)}) scaleRates(part);
  std::fill(excess_.begin(), excess_.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double c = c_[j];
    const double* __restrict A = J + j * ld;
    double* __restrict s = excess_.data();
    for (std::size_t k = 0; k < n; ++k) s[k] += A[k] * c;
  }
  double* last = J + n * ld;
  finishExcess(y[n], last);
  if (!finishRates(y, f)) return false;
  speciesBlock(J, ld);
  if (carried_ != nullptr) addCarriedJacobian(y, J, ld);
  const std::size_t count = numCarried();
  const auto heating = [&](const double* column) {
    const double gas = dot(energy_.data(), column, n);
    return count == 0 ? gas : gas + dot(carriedEnergy_.data(), column + n + 1, count);
  };
  for (std::size_t j = 0; j < n; ++j)
    J[n + j * ld] = -inverseCapacity_ * (heating(J + j * ld) + capacity_[j] * f[n] + workByFraction(j, y[n]));
  last[n] = temperatureDiagonal(y, f, last);
  for (std::size_t s = 0; s < count; ++s) {
    double* column = J + (n + 1 + s) * ld;
    column[n] = -inverseCapacity_ * (heating(column) + carriedCapacity_[s] * f[n]);
    column[n + 1 + s] -= conditions_.removal + conditions_.carriedRemoval;
  }
  for (std::size_t k = 0; k < n; ++k) J[k + k * ld] -= conditions_.removal + loss_[k];
  return accept(f);
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

bool ReactorSystem::sparseJacobian(const double* y, double* f, SparseJacobian& J) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  J.species.resize(pattern().numEntries());
  J.temperatureRow.resize(n);
  J.temperatureColumn.resize(n + 1);
  J.product.resize(n + 1);
  try {
    if (conditions_.reacts) {
      kinetics_.netProductionRatesAndSparseJacobian(y[n], c_, wdot_, J.species, common_, byT_);
    } else {
      for (auto* zero : {&J.species, &wdot_, &common_, &byT_}) std::fill(zero->begin(), zero->end(), 0.0);
    }
  } catch (const NumericsError& error) {
    return refuse(error.what());
  }
  for (auto* part : {&wdot_, &byT_, &common_, &J.species}) scaleRates(*part);
  double total = 0;
  for (const double c : c_) total += c;
  for (std::size_t k = 0; k < n; ++k) excess_[k] = common_[k] * total;
  const auto& entries = pattern();
  for (std::size_t j = 0; j < n; ++j) {
    const double c = c_[j];
    for (auto e = entries.columnStart[j]; e < entries.columnStart[j + 1]; ++e)
      excess_[entries.row[e]] += J.species[e] * c;
  }
  finishExcess(y[n], J.temperatureColumn.data());
  if (!finishRates(y, f)) return false;
  sparseColumns(J);
  for (std::size_t k = 0; k < n; ++k) J.product[k] = weights_[k] * (common_[k] + excess_[k]);
  J.product[n] = -inverseCapacity_ * dot(energy_.data(), J.product.data(), n);
  for (std::size_t j = 0; j < n; ++j)
    J.temperatureRow[j] = -inverseCapacity_ * (J.temperatureRow[j] + capacity_[j] * f[n] + workByFraction(j, y[n]));
  J.temperatureColumn[n] = temperatureDiagonal(y, f, J.temperatureColumn.data());
  return accept(f);
}

// d wdot/dc of the pattern becomes the derivative by mass fractions; leaves sum_k e_k S_kj in the row of the
// temperature.
void ReactorSystem::sparseColumns(SparseJacobian& J) const {
  const auto& entries = pattern();
  const double* __restrict W = weights_.data();
  const double* __restrict energy = energy_.data();
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const double inverse = inverseWeights_[j];
    double sum = 0;
    for (auto e = entries.columnStart[j]; e < entries.columnStart[j + 1]; ++e) {
      const auto k = static_cast<std::size_t>(entries.row[e]);
      const double value = J.species[e] * inverse * W[k];
      sum += energy[k] * value;
      J.species[e] = k == j ? value - conditions_.removal - loss_[j] : value;
    }
    J.temperatureRow[j] = sum;
  }
}

}  // namespace lampblack::chemistry
