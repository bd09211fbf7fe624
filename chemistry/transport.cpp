#include "chemistry/transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/polynomial_fit.hpp"
#include "chemistry/pure_gas.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

constexpr double kTrace = 1e-12;  // added to every mole fraction

const double kMiddle = 0.5 * (std::log(Transport::maxTemperature) + std::log(Transport::minTemperature));
const double kHalf = 0.5 * (std::log(Transport::maxTemperature) - std::log(Transport::minTemperature));

constexpr std::size_t kBlock = 16;  // rows of a matrix that are summed in registers

// out = M x for a matrix of n columns of ld rows, ld a multiple of kBlock
void multiply(const double* __restrict M, std::size_t ld, const double* __restrict x, std::size_t n,
              double* __restrict out) {
  for (std::size_t block = 0; block < ld; block += kBlock) {
    double sum[kBlock] = {};
    const double* __restrict column = M + block;
    for (std::size_t j = 0; j < n; ++j, column += ld)
      for (std::size_t i = 0; i < kBlock; ++i) sum[i] += column[i] * x[j];
    for (std::size_t i = 0; i < kBlock; ++i) out[block + i] = sum[i];
  }
}

}  // namespace

Transport::Transport(const Mechanism& mechanism, CollisionIntegrals integrals)
    : n_(mechanism.numSpecies()),
      ld_((n_ + kBlock - 1) / kBlock * kBlock),
      table_(mechanism.allSpecies()),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()) {
  for (const double W : weights_) gasConstants_.push_back(constants::gasConstant / W);
  for (auto* work : {&cp_, &x_, &y_, &z_, &root_, &a_, &b_, &sum0_, &sum1_, &sum2_, &resist_, &own_})
    work->assign(ld_, 0.0);
  const PureGas gas(mechanism, integrals);
  fit(gas);
  setWilke();
  fitError_ = measureFitError(gas);
}

void Transport::fit(const PureGas& gas) {
  // Least squares at Chebyshev points of ln T.
  constexpr std::size_t points = 40;
  std::vector<double> s, T;
  for (std::size_t i = 0; i < points; ++i) {
    s.push_back(-std::cos((static_cast<double>(i) + 0.5) / points * constants::pi));
    T.push_back(std::exp(kMiddle + kHalf * s.back()));
  }
  std::vector<double> values(points), a;
  const auto approximate = [&](const PolynomialFit& polynomial, std::size_t terms, auto&& function) {
    for (std::size_t i = 0; i < points; ++i) values[i] = function(T[i]);
    a.assign(terms, 0.0);
    polynomial.solve(values, a);
  };
  const PolynomialFit pure(s, kPureTerms), pairs(s, kPairTerms);
  viscosity_.assign(kPureTerms * ld_, 0.0);
  rigid_ = vibrating_ = viscosity_;
  ownResistance_.assign(kPairTerms * ld_, 0.0);
  resistance_.assign(kPairTerms * ld_ * n_, 0.0);
  for (std::size_t k = 0; k < n_; ++k) {
    approximate(pure, kPureTerms, [&](double t) { return std::sqrt(gas.viscosity(k, t) / std::sqrt(t)); });
    for (std::size_t m = 0; m < kPureTerms; ++m) viscosity_[m * ld_ + k] = a[m];
    approximate(pure, kPureTerms, [&](double t) { return gas.euckenFactors(k, t).rigid; });
    for (std::size_t m = 0; m < kPureTerms; ++m) rigid_[m * ld_ + k] = a[m];
    approximate(pure, kPureTerms, [&](double t) { return gas.euckenFactors(k, t).vibrating; });
    for (std::size_t m = 0; m < kPureTerms; ++m) vibrating_[m * ld_ + k] = a[m];
    for (std::size_t j = 0; j <= k; ++j) {
      approximate(pairs, kPairTerms, [&](double t) { return t * std::sqrt(t) / gas.diffusionTimesPressure(j, k, t); });
      for (std::size_t m = 0; m < kPairTerms; ++m)
        resistance_[(m * n_ + j) * ld_ + k] = resistance_[(m * n_ + k) * ld_ + j] = a[m];
    }
    for (std::size_t m = 0; m < kPairTerms; ++m) ownResistance_[m * ld_ + k] = a[m];  // j = k came last
  }
}

double Transport::measureFitError(const PureGas& gas) const {
  double error = 0;
  const auto compare = [&](double fitted, double exact) { error = std::max(error, std::abs(fitted / exact - 1.0)); };
  constexpr std::size_t points = 41;  // not those of the fit
  for (std::size_t i = 0; i < points; ++i) {
    const double s = 2.0 * static_cast<double>(i) / (points - 1.0) - 1.0;
    const double T = std::clamp(std::exp(kMiddle + kHalf * s), minTemperature, maxTemperature);
    for (std::size_t k = 0; k < n_; ++k) {
      compare(speciesViscosity(T, k), gas.viscosity(k, T));
      compare(speciesConductivity(T, k), gas.conductivity(k, T));
      for (std::size_t j = 0; j <= k; ++j) compare(binaryDiffusion(T, 1.0, j, k), gas.diffusionTimesPressure(j, k, T));
    }
  }
  return error;
}

// Phi_kj = A_kj (1 + B_kj sqrt(mu_k/mu_j))^2 with A = (8 (1 + W_k/W_j))^(-1/2), B = (W_j/W_k)^(1/4), multiplied out.
void Transport::setWilke() {
  const auto& W = weights_;
  for (auto* matrix : {&wilke0_, &wilke1_, &wilke2_}) matrix->assign(n_ * ld_, 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    for (std::size_t k = 0; k < n_; ++k) {
      const double A = 1.0 / std::sqrt(8.0 * (1.0 + W[k] / W[j]));
      const double B = std::pow(W[j] / W[k], 0.25);
      wilke0_[j * ld_ + k] = A;
      wilke1_[j * ld_ + k] = 2.0 * A * B;
      wilke2_[j * ld_ + k] = A * B * B;
    }
  }
}

Transport::Basis Transport::basis(double T) const {
  if (!(T >= minTemperature && T <= maxTemperature))
    throw NumericsError(fmt::format("transport properties at {:.6g} K; they are known from {} to {} K", T,
                                    minTemperature, maxTemperature));
  Basis result{};
  const double s = (std::log(T) - kMiddle) / kHalf;
  result.powers[0] = 1.0;
  for (std::size_t m = 1; m < kPureTerms; ++m) result.powers[m] = result.powers[m - 1] * s;
  result.rootT = std::sqrt(T);
  return result;
}

double Transport::conductivity(double viscosity, std::size_t k, double rigid, double vibrating, double cpOverR) const {
  return viscosity * gasConstants_[k] * (rigid + vibrating * cpOverR);
}

Transport::Mixture Transport::mixture(double T, double p, std::span<const double> X, std::span<double> D) {
  const auto at = basis(T);
  const std::size_t n = n_, ld = ld_;
  double total = 0, meanWeight = 0;
  for (std::size_t k = 0; k < n; ++k) {
    x_[k] = std::max(X[k], 0.0) + kTrace;
    total += x_[k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    x_[k] /= total;
    meanWeight += x_[k] * weights_[k];
  }
  multiply(viscosity_.data(), ld, at.powers, kPureTerms, root_.data());
  multiply(rigid_.data(), ld, at.powers, kPureTerms, a_.data());
  multiply(vibrating_.data(), ld, at.powers, kPureTerms, b_.data());
  table_.cpOverR(T, cp_.data());

  Mixture result;
  double sum = 0, inverseSum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double lambda = conductivity(root_[k] * root_[k], k, a_[k], b_[k], cp_[k]);
    sum += x_[k] * lambda;
    inverseSum += x_[k] / lambda;
  }
  result.conductivity = 0.5 * at.rootT * (sum + 1.0 / inverseSum);

  for (std::size_t j = 0; j < n; ++j) {
    const double inverse = 1.0 / root_[j];
    y_[j] = x_[j] * inverse;
    z_[j] = y_[j] * inverse;
  }
  multiply(wilke0_.data(), ld, x_.data(), n, sum0_.data());
  multiply(wilke1_.data(), ld, y_.data(), n, sum1_.data());
  multiply(wilke2_.data(), ld, z_.data(), n, sum2_.data());
  double viscosity = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double square = root_[k] * root_[k];
    viscosity += x_[k] * square / (sum0_[k] + root_[k] * sum1_[k] + square * sum2_[k]);
  }
  result.viscosity = at.rootT * viscosity;

  // sum_{j != k} X_j T^(3/2)/(p D_jk): the polynomials' coefficients are summed over the species first.
  std::fill(resist_.begin(), resist_.end(), 0.0);
  for (std::size_t m = 0; m < kPairTerms; ++m) {
    multiply(&resistance_[m * n * ld], ld, x_.data(), n, sum0_.data());
    for (std::size_t k = 0; k < ld; ++k) resist_[k] += at.powers[m] * sum0_[k];
  }
  multiply(ownResistance_.data(), ld, at.powers, kPairTerms, own_.data());
  const double scale = T * at.rootT / (p * meanWeight);
  for (std::size_t k = 0; k < n; ++k)
    D[k] = scale * (meanWeight - x_[k] * weights_[k]) / (resist_[k] - x_[k] * own_[k]);
  return result;
}

double Transport::binaryDiffusion(double T, double p, std::size_t j, std::size_t k) const {
  const auto at = basis(T);
  double resistance = 0;
  for (std::size_t m = 0; m < kPairTerms; ++m) resistance += at.powers[m] * resistance_[(m * n_ + j) * ld_ + k];
  return T * at.rootT / (p * resistance);
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
  table_.cpOverR(T, cp_.data());
  return conductivity(speciesViscosity(T, k), k, rigid, vibrating, cp_[k]);
}

}  // namespace lampblack
