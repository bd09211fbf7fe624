// What a carried phase adds to the equations of a reactor. With amounts z_s per kg of gas and particles, rho the mass
// of both per volume, n = rho z, rates R_s(n, c, T) and exchange X_k(n, c, T) per volume,
//   dz_s/dt = R_s/rho,   dY_k/dt += W_k X_k/rho.
// For a row F = R/rho (or W X/rho):
//   dF/dz_t = dR/dn_t,   dF/dY_j = (dR/dc_j)/W_j + g Q,   dF/dT = (dR/dT)/rho + g_T Q,
//   Q = (sum_t n_t dR/dn_t + sum_j c_j dR/dc_j - R)/rho,
// with g = d ln rho/dY_j = -Wbar/W_j, g_T = -1/T at constant pressure, zero at constant density.
#include <algorithm>

#include "chemistry/reactor/reactor_system.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

bool ReactorSystem::addCarriedRates(const double* y, double* f) {
  const std::size_t n = weights_.size(), count = carried_->size();
  const double* z = y + n + 1;
  for (std::size_t s = 0; s < count; ++s) carriedDensity_[s] = density_ * z[s];
  try {
    carried_->sources(y[n], pressure_, c_, carriedDensity_, carriedRates_, exchange_);
  } catch (const NumericsError& error) {
    return refuse(error.what());
  }
  const double volume = 1.0 / density_;
  for (std::size_t s = 0; s < count; ++s)
    f[n + 1 + s] =
        carriedRates_[s] * volume + carriedSource_[s] - (conditions_.removal + conditions_.carriedRemoval) * z[s];
  const auto& species = carried_->exchanged();
  for (std::size_t i = 0; i < species.size(); ++i) f[species[i]] += exchange_[i] * weights_[species[i]] * volume;
  if (conditions_.energy == Energy::Conserved) carried_->enthalpies(y[n], carriedEnergy_, carriedCapacity_);
  return true;
}

void ReactorSystem::addCarriedJacobian(const double* y, double* J, std::size_t ld) {
  const std::size_t n = weights_.size(), count = carried_->size();
  const auto& species = carried_->exchanged();
  const std::size_t rows = count + species.size(), columns = rows + 1;
  carried_->jacobian(y[n], pressure_, c_, carriedDensity_, carriedJacobian_);
  const double volume = 1.0 / density_;
  const bool pressureHeld = conditions_.held == Held::Pressure;
  for (std::size_t j = 0; j <= n; ++j) std::fill_n(J + n + 1 + j * ld, count, 0.0);
  for (std::size_t s = 0; s < count; ++s) std::fill_n(J + (n + 1 + s) * ld, size(), 0.0);
  for (std::size_t r = 0; r < rows; ++r) {
    const double* slope = carriedJacobian_.data() + r * columns;
    const bool isScalar = r < count;
    const std::size_t row = isScalar ? n + 1 + r : species[r - count];
    const double unit = isScalar ? 1.0 : weights_[row];
    double excess = isScalar ? -carriedRates_[r] : -exchange_[r - count];
    for (std::size_t s = 0; s < count; ++s) {
      excess += carriedDensity_[s] * slope[s];
      J[row + (n + 1 + s) * ld] += unit * slope[s];
    }
    for (std::size_t i = 0; i < species.size(); ++i) {
      excess += c_[species[i]] * slope[count + i];
      J[row + species[i] * ld] += unit * slope[count + i] * inverseWeights_[species[i]];
    }
    J[row + n * ld] += unit * volume * slope[rows];
    if (!pressureHeld) continue;
    excess *= unit * volume;
    for (std::size_t j = 0; j < n; ++j) J[row + j * ld] -= excess * meanWeight_ * inverseWeights_[j];
    J[row + n * ld] -= excess / y[n];
  }
}

}  // namespace lampblack::chemistry
