#include "chemistry/transport/multicomponent_transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/numerics/dot.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

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
      thermal_(4 * n_ * n_),
      pivots_(2 * n_) {
  for (auto* work : {&x_, &drag_, &viscosity_, &cp_, &internal_, &rotation_, &averagedDiffusion_, &internalDiagonal_,
                     &thermalDrag_, &collisions_})
    work->assign(n_, 0.0);
  unknowns_.assign(3 * n_, 0.0);
  for (auto* pairs : {&conductance_, &a_, &b_, &c_, &ordinary_, &inverse_, &toInternal_, &fromInternal_})
    pairs->assign(n_ * n_, 0.0);
}

void MulticomponentTransport::setMixture(double T, std::span<const double> X) {
  double total = 0;
  for (std::size_t i = 0; i < n_; ++i) total += x_[i] = std::max(X[i], 0.0);
  for (double& x : x_) x /= total;
  setTemperature(T);
  for (std::size_t i = 0; i < n_; ++i) {
    const double* conductance = &conductance_[i * n_];
    drag_[i] = dot(x_.data(), conductance, i) + dot(x_.data() + i + 1, conductance + i + 1, n_ - i - 1);
  }
}

// L00,00 (Kee et al. eq. 12.117) over 16 T/25, with what multiplies x_j a_j, not a_j, in column j: so absent species
// leave the matrix regular. The diagonal is zero.
double MulticomponentTransport::ordinary(std::size_t i, std::size_t j) const {
  if (n_ == 1) return 1.0;  // nothing diffuses
  return i == j ? 0.0 : weights_[j] / weights_[i] * drag_[i] + x_[i] * conductance_[i * n_ + j];
}

void MulticomponentTransport::setTemperature(double T) {
  if (T == temperature_) return;
  temperature_ = T;
  gas_.pairProperties(T, conductance_.data(), a_.data(), b_.data(), c_.data());
  thermo_.cpOverR(T, cp_.data());
  for (std::size_t i = 0; i < n_; ++i) {
    viscosity_[i] = gas_.viscosity(i, T);
    // Atoms have none: what excites their electrons is not exchanged in collisions of kinetic theory.
    internal_[i] = gas_.rotationalHeatCapacity(i) > 0 ? cp_[i] - 2.5 : 0.0;
    // Rotational heat capacity over the collision number; one of less than a collision at 298 K has no meaning here.
    rotation_[i] = gas_.rotationalHeatCapacity(i) / gas_.rotationalRelaxation(i, T, 1.0);
  }
}

// The blocks of Kee et al. eqs 12.118 to 12.127, with columns for x_j a_j as in ordinary(), and the right-hand side.
void MulticomponentTransport::fillThermalSystem(double T) {
  const std::size_t n = n_, ld = 2 * n;
  const auto at = [&](std::size_t row, std::size_t column) -> double& { return thermal_[column * ld + row]; };
  // Column after column: pairs are symmetric but for the factor x of the row.
  for (std::size_t i = 0; i < n; ++i) {
    const double Wi = weights_[i];
    const bool hasInternal = internal_[i] > kLeastInternal;
    const double exchange = hasInternal ? 32.0 * T / (5.0 * pi) * Wi * rotation_[i] / internal_[i] : 0.0;
    double thermalDrag = 0, collisions = 0, exchanges = 0, internalDrag = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double Wj = weights_[j], sum = Wi + Wj, A = a_[i * n + j], B = b_[i * n + j];
      const double conductance = conductance_[i * n + j];
      const double f = i == j ? 0.0 : 1.6 * T * (1.2 * c_[i * n + j] - 1.0) * conductance / sum;
      const double inelastic = 4.0 * A * (1.0 + 5.0 / (3.0 * pi) * (rotation_[i] + rotation_[j]));
      const double scale = 16.0 * T / 25.0 * conductance / (sum * sum);
      at(j, i) = 16.0 * T / 25.0 * ordinary(j, i);
      at(j, n + i) = -x_[j] * Wj * f;
      at(n + j, i) = -x_[j] * Wi * f;
      at(n + j, n + i) = x_[j] * Wi * Wj * scale * (13.75 - 3.0 * B - inelastic);
      thermalDrag += x_[j] * Wj * f;
      if (j != i) internalDrag += x_[j] * conductance * A * 2.4 * Wi * rotation_[i] / (pi * Wj);
      collisions += x_[j] * scale * (7.5 * Wi * Wi + Wj * Wj * (6.25 - 3.0 * B) + Wi * Wj * inelastic);
      // Exchange of translational and internal energy: row i of one block, column i of the other.
      const double part = exchange * A * conductance / sum;
      fromInternal_[j * n + i] = part * x_[i];
      toInternal_[i * n + j] = part * x_[j];
      exchanges += part * x_[j];
    }
    thermalDrag_[i] = thermalDrag;
    collisions_[i] = collisions;
    fromInternal_[i * n + i] += exchanges;
    toInternal_[i * n + i] += exchanges;
    const double selfDrag = drag_[i] + x_[i] * conductance_[i * n + i];
    internalDiagonal_[i] = hasInternal ? -8.0 / pi * Wi * x_[i] * rotation_[i] /
                                                 (internal_[i] * internal_[i] * gasConstant * viscosity_[i]) -
                                             4.0 * T / internal_[i] * (selfDrag + internalDrag / internal_[i])
                                       : 1.0;
    unknowns_[i] = 0.0;
    unknowns_[n + i] = x_[i];
    unknowns_[2 * n + i] = hasInternal ? x_[i] : 0.0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    at(i, n + i) = at(n + i, i) = thermalDrag_[i];
    at(n + i, n + i) -= collisions_[i];
  }
}

// The equation of an internal energy contains no other: its unknowns are eliminated at once.
void MulticomponentTransport::eliminateInternal() {
  const std::size_t n = n_;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) fromInternal_[j * n + i] /= internalDiagonal_[i];
    unknowns_[2 * n + j] /= internalDiagonal_[j];
  }
  dense_.subtractProduct(n, n, n, toInternal_.data(), n, fromInternal_.data(), n, &thermal_[2 * n * n + n], 2 * n);
  addProduct(n, n, -1.0, toInternal_.data(), &unknowns_[2 * n], &unknowns_[n]);
}

void MulticomponentTransport::singular(double T, double p) {
  throw NumericsError(
      fmt::format("the multicomponent transport equations at {:.6g} K and {:.6g} Pa are singular", T, p));
}

MulticomponentTransport::Mixture MulticomponentTransport::mixture(double T, double p, std::span<const double> X,
                                                                  std::span<double> DT) {
  const auto averaged = averaged_.mixture(T, p, X, averagedDiffusion_);
  setMixture(T, X);
  fillThermalSystem(T);
  eliminateInternal();
  if (!dense_.factorise(2 * n_, thermal_.data(), pivots_.data())) singular(T, p);
  dense_.solve(2 * n_, thermal_.data(), pivots_.data(), 1, unknowns_.data());
  addProduct(n_, n_, -1.0, fromInternal_.data(), &unknowns_[n_], &unknowns_[2 * n_]);
  double sum = 0;
  for (std::size_t i = n_; i < 3 * n_; ++i) sum += unknowns_[i];
  for (std::size_t i = 0; i < n_; ++i) DT[i] = 1.6 / gasConstant * weights_[i] * unknowns_[i];
  return {averaged.viscosity, -4.0 * sum};
}

// inverse_: of ordinary_, column after column.
void MulticomponentTransport::invert(double T, double p) {
  if (!dense_.factorise(n_, ordinary_.data(), pivots_.data())) singular(T, p);
  std::fill(inverse_.begin(), inverse_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) inverse_[i * n_ + i] = 1.0;
  dense_.solve(n_, ordinary_.data(), pivots_.data(), n_, inverse_.data());
}

// D_ij = x_i 16 T W/(25 p W_j) (P_ij - P_ii) with P the inverse of L00,00 (Kee et al. eq. 12.116).
void MulticomponentTransport::diffusion(double T, double p, std::span<const double> X, std::span<double> D) {
  Transport::requireInRange(T);
  setMixture(T, X);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) ordinary_[j * n_ + i] = ordinary(i, j);
  invert(T, p);
  double meanWeight = 0;
  for (std::size_t i = 0; i < n_; ++i) meanWeight += x_[i] * weights_[i];
  for (std::size_t i = 0; i < n_; ++i) {
    const double own = inverse_[i * n_ + i];
    for (std::size_t j = 0; j < n_; ++j) D[i * n_ + j] = meanWeight / (p * weights_[j]) * (inverse_[j * n_ + i] - own);
  }
}

// The Stefan-Maxwell equations sum_j x_i c_ij v_j - drag_i v_i = grad x_i are dependent: their sum is zero. Any column
// a times the row of weights can be added to make them regular, for the solution has sum_j W_j v_j = 0 then; ordinary()
// is that with a = drag_i/W_i. Here a is -x_i, which keeps every row i but for its diagonal in proportion to x_i.
void MulticomponentTransport::fluxMatrix(double T, double p, std::span<const double> X, std::span<double> M) {
  Transport::requireInRange(T);
  setMixture(T, X);
  double drag = 0, weight = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    drag += x_[i] * drag_[i];
    weight += x_[i] * weights_[i];
  }
  // A gas of one species: nothing diffuses.
  const double frame = (n_ > 1 && drag > 0 ? drag : 1.0) / weight;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i)
      ordinary_[j * n_ + i] =
          i == j ? -drag_[i] - frame * x_[i] * weights_[i] : x_[i] * (conductance_[i * n_ + j] - frame * weights_[j]);
  invert(T, p);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) M[i * n_ + j] = inverse_[j * n_ + i];
}

}  // namespace lampblack::chemistry
