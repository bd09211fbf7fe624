#include "chemistry/transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chemistry/polynomial_fit.hpp"
#include "chemistry/pure_gas.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

constexpr double kTrace = 1e-12;  // added to every mole fraction

double scaledLog(double T) {
  static const double middle = 0.5 * (std::log(Transport::maxTemperature) + std::log(Transport::minTemperature));
  static const double half = 0.5 * (std::log(Transport::maxTemperature) - std::log(Transport::minTemperature));
  return (std::log(T) - middle) / half;
}

// out += M x for a matrix of ld-row columns
void addProduct(const double* __restrict M, std::size_t ld, const double* x, std::size_t n, double* __restrict out) {
  for (std::size_t j = 0; j < n; ++j) {
    const double value = x[j];
    const double* __restrict column = M + j * ld;
    for (std::size_t k = 0; k < ld; ++k) out[k] += column[k] * value;
  }
}

}  // namespace

Transport::Transport(const Mechanism& mechanism)
    : n_(mechanism.numSpecies()),
      ld_((n_ + 7) / 8 * 8),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()) {
  fit(mechanism);
  setWilke(mechanism);
  for (auto* work : {&x_, &root_, &inverseRoot_, &lambda_, &sum0_, &sum1_, &sum2_, &resist_}) work->assign(ld_, 0.0);
}

void Transport::fit(const Mechanism& mechanism) {
  const PureGas gas(mechanism);
  // Chebyshev points of ln T for the fit, twice as many and shifted for the error.
  constexpr std::size_t points = 40;
  std::vector<double> s, T;
  const double middle = 0.5 * (std::log(maxTemperature) + std::log(minTemperature));
  const double half = 0.5 * (std::log(maxTemperature) - std::log(minTemperature));
  for (std::size_t i = 0; i < points; ++i) {
    s.push_back(-std::cos((static_cast<double>(i) + 0.5) / points * 3.14159265358979323846));
    T.push_back(std::exp(middle + half * s.back()));
  }
  const PolynomialFit polynomial(s, kTerms);
  std::vector<double> values(points);
  std::array<double, kTerms> a{};
  const auto approximate = [&](auto&& function, int power) {
    for (std::size_t i = 0; i < points; ++i) values[i] = function(T[i]);
    polynomial.solve(values, a);
    for (std::size_t i = 0; i < 2 * points; ++i) {
      const double at = -1.0 + 2.0 * static_cast<double>(i) / (2.0 * points - 1.0);
      double sum = 0;
      for (std::size_t m = kTerms; m-- > 0;) sum = sum * at + a[m];
      const double exact = function(std::exp(middle + half * at));
      fitError_ = std::max(fitError_, power * std::abs(sum / exact - 1.0));
    }
  };
  viscosity_.assign(kTerms * ld_, 0.0);
  conductivity_.assign(kTerms * ld_, 0.0);
  resistance_.assign(kTerms * ld_ * n_, 0.0);
  for (std::size_t k = 0; k < n_; ++k) {
    approximate([&](double t) { return std::sqrt(gas.viscosity(k, t) / std::sqrt(t)); }, 2);
    for (std::size_t m = 0; m < kTerms; ++m) viscosity_[m * ld_ + k] = a[m];
    approximate([&](double t) { return gas.conductivity(k, t) / std::sqrt(t); }, 1);
    for (std::size_t m = 0; m < kTerms; ++m) conductivity_[m * ld_ + k] = a[m];
    for (std::size_t j = 0; j <= k; ++j) {
      approximate([&](double t) { return t * std::sqrt(t) / gas.diffusionTimesPressure(j, k, t); }, 1);
      for (std::size_t m = 0; m < kTerms; ++m)
        resistance_[(m * n_ + j) * ld_ + k] = resistance_[(m * n_ + k) * ld_ + j] = a[m];
    }
  }
}

// Phi_kj = A_kj (1 + B_kj sqrt(mu_k/mu_j))^2 with A = (8 (1 + W_k/W_j))^(-1/2), B = (W_j/W_k)^(1/4), multiplied out.
void Transport::setWilke(const Mechanism& mechanism) {
  const auto W = mechanism.molecularWeights();
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

double Transport::basis(double T, double* powers) const {
  if (!(T >= minTemperature && T <= maxTemperature))
    throw NumericsError(fmt::format("transport properties at {:.6g} K; they are known from {} to {} K", T,
                                    minTemperature, maxTemperature));
  const double s = scaledLog(T);
  powers[0] = 1.0;
  for (std::size_t m = 1; m < kTerms; ++m) powers[m] = powers[m - 1] * s;
  return std::sqrt(T);
}

Transport::Mixture Transport::mixture(double T, double p, std::span<const double> X, std::span<double> D) {
  std::array<double, kTerms> powers{};
  const double rootT = basis(T, powers.data());
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
  for (auto* sum : {&root_, &lambda_, &sum0_, &sum1_, &sum2_, &resist_}) std::fill(sum->begin(), sum->end(), 0.0);
  addProduct(viscosity_.data(), ld, powers.data(), kTerms, root_.data());
  addProduct(conductivity_.data(), ld, powers.data(), kTerms, lambda_.data());

  Mixture result;
  double sum = 0, inverseSum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += x_[k] * lambda_[k];
    inverseSum += x_[k] / lambda_[k];
  }
  result.conductivity = 0.5 * rootT * (sum + 1.0 / inverseSum);

  std::array<double, 3> weighted{};
  for (std::size_t j = 0; j < n; ++j) {
    const double inverse = 1.0 / root_[j];
    weighted = {x_[j], x_[j] * inverse, x_[j] * inverse * inverse};
    const double* __restrict a = &wilke0_[j * ld], * __restrict b = &wilke1_[j * ld], * __restrict c = &wilke2_[j * ld];
    double* __restrict s0 = sum0_.data(), * __restrict s1 = sum1_.data(), * __restrict s2 = sum2_.data();
    for (std::size_t k = 0; k < ld; ++k) {
      s0[k] += a[k] * weighted[0];
      s1[k] += b[k] * weighted[1];
      s2[k] += c[k] * weighted[2];
    }
  }
  double viscosity = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double square = root_[k] * root_[k];
    viscosity += x_[k] * square / (sum0_[k] + root_[k] * sum1_[k] + square * sum2_[k]);
  }
  result.viscosity = rootT * viscosity;

  // sum_{j != k} X_j T^(3/2)/(p D_jk): the polynomials' coefficients are summed over the species first.
  for (std::size_t m = 0; m < kTerms; ++m) {
    std::fill(sum0_.begin(), sum0_.end(), 0.0);
    addProduct(&resistance_[m * n * ld], ld, x_.data(), n, sum0_.data());
    for (std::size_t k = 0; k < ld; ++k) resist_[k] += powers[m] * sum0_[k];
  }
  const double scale = T * rootT / p;
  for (std::size_t k = 0; k < n; ++k) {
    double own = 0;
    for (std::size_t m = 0; m < kTerms; ++m) own += powers[m] * resistance_[(m * n + k) * ld + k];
    D[k] = scale * (meanWeight - x_[k] * weights_[k]) / (meanWeight * (resist_[k] - x_[k] * own));
  }
  return result;
}

double Transport::binaryDiffusion(double T, double p, std::size_t j, std::size_t k) const {
  std::array<double, kTerms> powers{};
  const double rootT = basis(T, powers.data());
  double resistance = 0;
  for (std::size_t m = 0; m < kTerms; ++m) resistance += powers[m] * resistance_[(m * n_ + j) * ld_ + k];
  return T * rootT / (p * resistance);
}

double Transport::speciesViscosity(double T, std::size_t k) const {
  std::array<double, kTerms> powers{};
  const double rootT = basis(T, powers.data());
  double root = 0;
  for (std::size_t m = 0; m < kTerms; ++m) root += powers[m] * viscosity_[m * ld_ + k];
  return rootT * root * root;
}

double Transport::speciesConductivity(double T, std::size_t k) const {
  std::array<double, kTerms> powers{};
  const double rootT = basis(T, powers.data());
  double value = 0;
  for (std::size_t m = 0; m < kTerms; ++m) value += powers[m] * conductivity_[m * ld_ + k];
  return rootT * value;
}

}  // namespace lampblack
