#include "chemistry/transport/transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chemistry/transport/fit_points.hpp"
#include "chemistry/transport/transport_margin.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/dot.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::chemistry {

namespace {

constexpr double kTrace = 1e-12;  // added to every mole fraction

// sum_m powers[m] a[m] of eight species, in rows of ld values
template <std::size_t Terms>
Lanes evaluate(const double* a, const double* powers, std::size_t ld) {
  Lanes sum = loadLanes(a) * powers[0];
  for (std::size_t m = 1; m < Terms; ++m) sum += loadLanes(a + m * ld) * powers[m];
  return sum;
}

// out[r] = M x[r] for blocks of eight rows of M, so many at once that the sums do not wait for each other
template <std::size_t Blocks, std::size_t Vectors>
void multiplyBlocks(const double* M, std::size_t n, std::size_t ld, const std::array<const double*, Vectors>& x,
                    const std::array<double*, Vectors>& out, std::size_t first) {
  std::array<std::array<Lanes, Vectors>, Blocks> sums{};
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t b = 0; b < Blocks; ++b) {
      const Lanes entries = loadLanes(M + j * ld + first + b * laneCount);
      for (std::size_t r = 0; r < Vectors; ++r) sums[b][r] += entries * x[r][j];
    }
  for (std::size_t b = 0; b < Blocks; ++b)
    for (std::size_t r = 0; r < Vectors; ++r) storeLanes(out[r] + first + b * laneCount, sums[b][r]);
}

}  // namespace

void Transport::requireInRange(double T) {
  if (!(T >= transportmargin::coldest && T <= transportmargin::hottest))
    throw NumericsError(
        fmt::format("transport properties at {:.6g} K; they are known from {} to {} K, and used from {} "
                    "to {} K",
                    T, minTemperature, maxTemperature, transportmargin::coldest, transportmargin::hottest));
}

Transport::Basis Transport::basis(double T) const {
  requireInRange(T);
  return {fitPowers<kMostTerms>(T), std::sqrt(T)};
}

void Transport::setMoleFractions(std::span<const double> X) {
  for (std::size_t k = 0; k < n_; ++k) x_[k] = std::max(X[k], 0.0) + kTrace;
  const double scale = 1.0 / sumOf(x_.data(), n_);
  for (std::size_t k = 0; k < n_; ++k) x_[k] *= scale;
  meanWeight_ = dot(x_.data(), weights_.data(), n_);
}

// Phi_kj = (8 (1 + W_k/W_j))^(-1/2) (1 + (mu_k/mu_j)^(1/2) (W_j/W_k)^(1/4))^2, multiplied out: with
// u = (mu/T^(1/2))^(1/2) W^(-1/4) and S_kj = (8 (W_k + W_j))^(-1/2),
// sum_j X_j Phi_kj = sum_j S_kj X_j W_j^(1/2) (1 + 2 u_k/u_j + u_k^2/u_j^2).
void Transport::wilkeSums(const Basis& at) {
  for (std::size_t j = 0; j < ld_; j += laneCount) {
    const Lanes root = evaluate<kPureTerms>(&viscosity_[j], at.powers.data(), ld_);
    const Lanes u = root * loadLanes(&quarterRoots_[j]);
    const Lanes a = loadLanes(&x_[j]) * loadLanes(&roots_[j]);
    const Lanes b = a / u;
    storeLanes(&root_[j], root);
    storeLanes(&u_[j], u);
    storeLanes(&a_[j], a);
    storeLanes(&b_[j], b);
    storeLanes(&c_[j], b / u);
  }
  const std::array<const double*, 3> vectors{a_.data(), b_.data(), c_.data()};
  const std::array<double*, 3> sums{sum0_.data(), sum1_.data(), sum2_.data()};
  std::size_t row = 0;
  for (; row + 4 * laneCount <= ld_; row += 4 * laneCount)
    multiplyBlocks<4>(wilke_.data(), n_, ld_, vectors, sums, row);
  for (; row < ld_; row += laneCount) multiplyBlocks<1>(wilke_.data(), n_, ld_, vectors, sums, row);
  for (std::size_t k = 0; k < n_; ++k) wilkeSum_[k] = sum0_[k] + u_[k] * (2.0 * sum1_[k] + u_[k] * sum2_[k]);
}

Transport::Mixture Transport::viscosityAndConductivity(double T, const Basis& at) {
  wilkeSums(at);
  thermo_.cpOverR(T, cp_.data());
  for (std::size_t k = 0; k < ld_; k += laneCount) {
    const Lanes root = loadLanes(&root_[k]), wilke = loadLanes(&wilkeSum_[k]);
    const Lanes rigid = evaluate<kPureTerms>(&rigid_[k], at.powers.data(), ld_);
    const Lanes vibrating = evaluate<kPureTerms>(&vibrating_[k], at.powers.data(), ld_);
    const Lanes viscosity = root * root;
    const Lanes lambda = viscosity * loadLanes(&gasConstants_[k]) * (rigid + vibrating * loadLanes(&cp_[k]));
    const Lanes inverse = 1.0 / (wilke * lambda);
    storeLanes(&a_[k], viscosity * lambda * inverse);
    storeLanes(&b_[k], lambda);
    storeLanes(&c_[k], wilke * inverse);
  }
  const double arithmetic = dot(x_.data(), b_.data(), n_), harmonic = 1.0 / dot(x_.data(), c_.data(), n_);
  return {at.rootT * dot(x_.data(), a_.data(), n_), 0.5 * at.rootT * (arithmetic + harmonic)};
}

Transport::Mixture Transport::bySutherland(double T) {
  thermo_.cpOverR(T, cp_.data());
  const double cp = constants::gasConstant * dot(x_.data(), cp_.data(), n_) / meanWeight_;
  const double viscosity = sutherland_->viscosityAt(T);
  return {viscosity, viscosity * cp / sutherland_->prandtl};
}

Transport::Mixture Transport::mixture(double T, double p, std::span<const double> X, std::span<double> D) {
  const auto at = basis(T);
  setMoleFractions(X);
  const auto result = sutherland_ ? bySutherland(T) : viscosityAndConductivity(T, at);
  if (model_ == DiffusionModel::MixtureAveraged) {
    averagedDiffusion(T, p, at, D);
  } else {
    const double cp = dot(x_.data(), cp_.data(), n_);  // of the mixture, in units of R
    const double thermal = result.conductivity * T / (p * cp);
    for (std::size_t k = 0; k < n_; ++k) D[k] = thermal * inverseLewis_[k];
  }
  return result;
}

void Transport::averagedDiffusion(double T, double p, const Basis& at, std::span<double> D) {
  resistance_.multiply<1>(at.powers.data(), {x_.data()}, {sum0_.data()});
  const double scale = T * at.rootT / (p * meanWeight_);
  for (std::size_t k = 0; k < n_; ++k) D[k] = scale * (meanWeight_ - x_[k] * weights_[k]) / sum0_[k];
  restAlone(D);
}

// A gas of one species has nothing to diffuse in.
void Transport::restAlone(std::span<double> D) const {
  if (n_ == 1) D[0] = 0.0;
}

void Transport::molarDiffusion(double T, double p, std::span<const double> X, std::span<double> D) {
  const auto at = basis(T);
  setMoleFractions(X);
  resistance_.multiply<1>(at.powers.data(), {x_.data()}, {sum0_.data()});
  const double scale = T * at.rootT / p;
  for (std::size_t k = 0; k < n_; ++k) D[k] = scale * (1.0 - x_[k]) / sum0_[k];
  restAlone(D);
}

void Transport::massDiffusion(double T, double p, std::span<const double> X, std::span<double> D) {
  const auto at = basis(T);
  setMoleFractions(X);
  for (std::size_t k = 0; k < n_; ++k) a_[k] = x_[k] * weights_[k];
  resistance_.multiply<2>(at.powers.data(), {x_.data(), a_.data()}, {sum0_.data(), sum1_.data()});
  const double scale = T * at.rootT / p;
  for (std::size_t k = 0; k < n_; ++k) D[k] = scale / (sum0_[k] + x_[k] / (meanWeight_ - a_[k]) * sum1_[k]);
  restAlone(D);
}

// DT_k = W_k W D_k sum_j (6/5 C*_kj - 1)/((W_k + W_j) D_kj) (Y_k a_j - Y_j a_k), then the sum's share Y_k taken off,
// with a_k = 15/4 mu_k/W_k X_k/(X_k + 1.065 sum_{j!=k} X_j Phi_kj), which is the translational conductivity over R of
// species k in the mixture (Mason, Saxena, Phys. Fluids 1 (1958) 361-369).
void Transport::thermalDiffusion(double T, double p, std::span<const double> X, std::span<double> DT) {
  const auto at = basis(T);
  setMoleFractions(X);
  averagedDiffusion(T, p, at, DT);
  wilkeSums(at);
  for (std::size_t k = 0; k < n_; ++k) {
    const double viscosity = at.rootT * root_[k] * root_[k];
    a_[k] = 3.75 * viscosity / weights_[k] * x_[k] / (x_[k] + 1.065 * (wilkeSum_[k] - x_[k]));
    b_[k] = x_[k] * weights_[k] / meanWeight_;
  }
  thermal_.multiply<2>(at.powers.data(), {a_.data(), b_.data()}, {sum0_.data(), sum1_.data()});
  const double scale = p / (T * at.rootT);  // turns resistances to 1/D
  double total = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    DT[k] *= scale * weights_[k] * meanWeight_ * (b_[k] * sum0_[k] - a_[k] * sum1_[k]);
    total += DT[k];
  }
  for (std::size_t k = 0; k < n_; ++k) DT[k] -= b_[k] * total;
}

double Transport::binaryDiffusion(double T, double p, std::size_t j, std::size_t k) const {
  const auto at = basis(T);
  return T * at.rootT / (p * pairResistance(at, j, k));
}

double Transport::pairResistance(const Basis& at, std::size_t j, std::size_t k) const {
  if (j != k) return resistance_.value(j, k, at.powers.data());
  double sum = 0;
  for (std::size_t m = 0; m < kPairTerms; ++m) sum += at.powers[m] * ownResistance_[m * ld_ + k];
  return sum;
}

double Transport::speciesViscosity(double T, std::size_t k) const {
  const auto at = basis(T);
  double root = 0;
  for (std::size_t m = 0; m < kPureTerms; ++m) root += at.powers[m] * viscosity_[m * ld_ + k];
  return at.rootT * root * root;
}

double Transport::speciesConductivity(double T, std::size_t k) const {
  const auto at = basis(T);
  double rigid = 0, vibrating = 0;
  for (std::size_t m = 0; m < kPureTerms; ++m) {
    rigid += at.powers[m] * rigid_[m * ld_ + k];
    vibrating += at.powers[m] * vibrating_[m * ld_ + k];
  }
  thermo_.cpOverR(T, cp_.data());
  return speciesViscosity(T, k) * gasConstants_[k] * (rigid + vibrating * cp_[k]);
}

}  // namespace lampblack::chemistry
