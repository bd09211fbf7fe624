#include "chemistry/transport/multicomponent_transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

using constants::gasConstant;
using constants::pi;

constexpr double kLeastInternal = 1e-3;  // internal heat capacity over R below which a species counts as without

}  // namespace

MulticomponentTransport::MulticomponentTransport(const Mechanism& mechanism, CollisionIntegrals integrals)
    : n_(mechanism.numSpecies()),
      gas_(mechanism, integrals),
      averaged_(mechanism, {integrals, DiffusionModel::MixtureAveraged, {}}),
      thermo_(mechanism.allSpecies()),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      ordinary_(n_),
      thermal_(3 * n_) {
  for (auto* work : {&x_, &drag_, &viscosity_, &cp_, &internal_, &rotation_, &averagedDiffusion_})
    work->assign(n_, 0.0);
  unknowns_.assign(3 * n_, 0.0);
  for (auto* pairs : {&conductance_, &a_, &b_, &c_}) pairs->assign(n_ * n_, 0.0);
}

void MulticomponentTransport::setMixture(double T, std::span<const double> X) {
  double total = 0;
  for (std::size_t i = 0; i < n_; ++i) total += x_[i] = std::max(X[i], 0.0);
  for (double& x : x_) x /= total;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      conductance_[i * n_ + j] = conductance_[j * n_ + i] = 1.0 / gas_.diffusionTimesPressure(i, j, T);
  for (std::size_t i = 0; i < n_; ++i) {
    drag_[i] = 0;
    for (std::size_t k = 0; k < n_; ++k)
      if (k != i) drag_[i] += x_[k] * conductance_[i * n_ + k];
  }
}

// L00,00 (Kee et al. eq. 12.117) over 16 T/25, with what multiplies x_j a_j, not a_j, in column j: so absent species
// leave the matrix regular. The diagonal is zero.
double MulticomponentTransport::ordinary(std::size_t i, std::size_t j) const {
  if (n_ == 1) return 1.0;  // nothing diffuses
  return i == j ? 0.0 : weights_[j] / weights_[i] * drag_[i] + x_[i] * conductance_[i * n_ + j];
}

void MulticomponentTransport::setPairs(double T) {
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      a_[i * n_ + j] = a_[j * n_ + i] = gas_.ratioA(i, j, T);
      b_[i * n_ + j] = b_[j * n_ + i] = gas_.ratioB(i, j, T);
      c_[i * n_ + j] = c_[j * n_ + i] = gas_.ratioC(i, j, T);
    }
  thermo_.cpOverR(T, cp_.data());
  for (std::size_t i = 0; i < n_; ++i) {
    viscosity_[i] = gas_.viscosity(i, T);
    internal_[i] = cp_[i] - 2.5;
    // Rotational heat capacity over the collision number; one of less than a collision at 298 K has no meaning here.
    rotation_[i] = gas_.rotationalHeatCapacity(i) / gas_.rotationalRelaxation(i, T, 1.0);
  }
}

// The blocks of Kee et al. eqs 12.118 to 12.127, with columns for x_j a_j as in ordinary(), and the right-hand side.
void MulticomponentTransport::fillThermalSystem(double T) {
  const std::size_t n = n_;
  for (std::size_t j = 0; j < 3 * n; ++j) std::fill_n(thermal_.column(j), 3 * n, 0.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& { return thermal_.column(column)[row]; };
  for (std::size_t i = 0; i < n; ++i) {
    const double Wi = weights_[i];
    const bool hasInternal = internal_[i] > kLeastInternal;
    const double exchange = hasInternal ? 32.0 * T / (5.0 * pi) * Wi * rotation_[i] / internal_[i] : 0.0;
    double thermalDrag = 0, collisions = 0, exchanges = 0, internalDrag = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double Wj = weights_[j], sum = Wi + Wj, A = a_[i * n + j], B = b_[i * n + j];
      const double conductance = conductance_[i * n + j];
      const double f = 1.6 * T * (1.2 * c_[i * n + j] - 1.0) * conductance / sum;
      const double inelastic = 4.0 * A * (1.0 + 5.0 / (3.0 * pi) * (rotation_[i] + rotation_[j]));
      const double scale = 16.0 * T / 25.0 * conductance / (sum * sum);
      at(i, j) = 16.0 * T / 25.0 * ordinary(i, j);
      if (j != i) {
        at(i, n + j) = -x_[i] * Wi * f;
        at(n + i, j) = -x_[i] * Wj * f;
        thermalDrag += x_[j] * Wj * f;
        internalDrag += x_[j] * conductance * A * 2.4 * Wi * rotation_[i] / (pi * Wj);
      }
      at(n + i, n + j) = x_[i] * Wi * Wj * scale * (13.75 - 3.0 * B - inelastic);
      collisions += x_[j] * scale * (7.5 * Wi * Wi + Wj * Wj * (6.25 - 3.0 * B) + Wi * Wj * inelastic);
      // Exchange of translational and internal energy: row i of one block, column i of the other.
      at(2 * n + i, n + j) = exchange * x_[i] * A * conductance / sum;
      at(n + j, 2 * n + i) = exchange * x_[j] * A * conductance / sum;
      exchanges += exchange * x_[j] * A * conductance / sum;
    }
    at(i, n + i) = thermalDrag;
    at(n + i, i) = thermalDrag;
    at(n + i, n + i) -= collisions;
    at(2 * n + i, n + i) += exchanges;
    at(n + i, 2 * n + i) += exchanges;
    const double selfDrag = drag_[i] + x_[i] * conductance_[i * n + i];
    at(2 * n + i, 2 * n + i) = hasInternal ? -8.0 / pi * Wi * x_[i] * rotation_[i] /
                                                     (internal_[i] * internal_[i] * gasConstant * viscosity_[i]) -
                                                 4.0 * T / internal_[i] * (selfDrag + internalDrag / internal_[i])
                                           : 1.0;
    unknowns_[i] = 0.0;
    unknowns_[n + i] = x_[i];
    unknowns_[2 * n + i] = hasInternal ? x_[i] : 0.0;
  }
}

void MulticomponentTransport::singular(double T, double p) {
  throw NumericsError(
      fmt::format("the multicomponent transport equations at {:.6g} K and {:.6g} Pa are singular", T, p));
}

MulticomponentTransport::Mixture MulticomponentTransport::mixture(double T, double p, std::span<const double> X,
                                                                  std::span<double> DT) {
  const auto averaged = averaged_.mixture(T, p, X, averagedDiffusion_);
  setMixture(T, X);
  setPairs(T);
  fillThermalSystem(T);
  if (!thermal_.factorise()) singular(T, p);
  thermal_.solve(unknowns_.data());
  double sum = 0;
  for (std::size_t i = n_; i < 3 * n_; ++i) sum += unknowns_[i];
  for (std::size_t i = 0; i < n_; ++i) DT[i] = 1.6 / gasConstant * weights_[i] * unknowns_[i];
  return {averaged.viscosity, -4.0 * sum};
}

// D_ij = x_i 16 T W/(25 p W_j) (P_ij - P_ii) with P the inverse of L00,00 (Kee et al. eq. 12.116).
void MulticomponentTransport::diffusion(double T, double p, std::span<const double> X, std::span<double> D) {
  Transport::requireInRange(T);
  setMixture(T, X);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) ordinary_.column(j)[i] = ordinary(i, j);
  if (!ordinary_.factorise()) singular(T, p);
  double meanWeight = 0;
  for (std::size_t i = 0; i < n_; ++i) meanWeight += x_[i] * weights_[i];
  for (std::size_t j = 0; j < n_; ++j) {
    std::fill_n(unknowns_.begin(), n_, 0.0);
    unknowns_[j] = 1.0;
    ordinary_.solve(unknowns_.data());
    for (std::size_t i = 0; i < n_; ++i) D[i * n_ + j] = unknowns_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const double own = D[i * n_ + i];
    for (std::size_t j = 0; j < n_; ++j) D[i * n_ + j] = meanWeight / (p * weights_[j]) * (D[i * n_ + j] - own);
  }
}

}  // namespace lampblack
