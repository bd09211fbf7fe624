// Small nonlinear systems with dense factors, on which the solvers of flames are tested.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numerics/loaded_system.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// LU factors with partial pivoting, row-major.
class DenseFactors {
 public:
  // False where singular.
  bool factorise(std::vector<double> a, std::size_t n) {
    a_ = std::move(a);
    n_ = n;
    pivot_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t p = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::abs(at(i, k)) > std::abs(at(p, k))) p = i;
      pivot_[k] = p;
      if (at(p, k) == 0 || !std::isfinite(at(p, k))) return false;
      for (std::size_t j = 0; j < n; ++j) std::swap(at(k, j), at(p, j));
      for (std::size_t i = k + 1; i < n; ++i) {
        const double factor = at(i, k) /= at(k, k);
        if (factor == 0) continue;
        for (std::size_t j = k + 1; j < n; ++j) at(i, j) -= factor * at(k, j);
      }
    }
    return true;
  }
  void solve(std::span<double> b) const {
    for (std::size_t k = 0; k < n_; ++k) std::swap(b[k], b[pivot_[k]]);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < i; ++j) b[i] -= at(i, j) * b[j];
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t j = i + 1; j < n_; ++j) b[i] -= at(i, j) * b[j];
      b[i] /= at(i, i);
    }
  }

 private:
  double& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return a_[i * n_ + j]; }
  std::vector<double> a_;
  std::vector<std::size_t> pivot_;
  std::size_t n_ = 0;
};

// A system given by functions; matrices row-major. Base: any interface derived from NewtonSystem.
template <typename Base>
class SmallSystemOf : public Base {
 public:
  using Residual = std::function<void(std::span<const double> x, std::span<double> F)>;
  using Matrix = std::function<void(std::span<const double> x, std::vector<double>& J)>;

  SmallSystemOf(std::size_t n, Residual f, Matrix j) : n_(n), residual_(std::move(f)), matrix_(std::move(j)) {
    weights.assign(n, 1);
    lower.assign(n, -std::numeric_limits<double>::infinity());
    upper.assign(n, std::numeric_limits<double>::infinity());
    scale.assign(n, 1e-4);
  }

  [[nodiscard]] std::size_t size() const override { return n_; }
  void residual(std::span<const double> x, std::span<double> F) override {
    for (std::size_t i = 0; i < n_; ++i) outOfBounds = outOfBounds || x[i] < lower[i] || x[i] > upper[i];
    residual_(x, F);
  }
  void timeWeights(std::span<const double>, std::span<double> M) override {
    for (std::size_t i = 0; i < n_; ++i) M[i] = weights[i];
  }
  [[nodiscard]] bool factorise(std::span<const double> x, double inverseTimeStep) override {
    return factoriseWith(x, inverseTimeStep, {});
  }
  void solve(std::span<double> b) override { factors_.solve(b); }
  void bounds(std::span<double> l, std::span<double> u) const override {
    for (std::size_t i = 0; i < n_; ++i) {
      l[i] = lower[i];
      u[i] = upper[i];
    }
  }
  void scales(std::span<const double>, std::span<double> s) const override {
    for (std::size_t i = 0; i < n_; ++i) s[i] = scale[i];
  }
  [[nodiscard]] std::string nameOf(std::size_t unknown) const override {
    return std::string("x").append(std::to_string(unknown));
  }

  std::vector<double> weights, lower, upper, scale;
  std::size_t factorisations = 0;
  bool outOfBounds = false;  // whether the residual was ever asked for out of bounds

 protected:
  // With more entries of the time derivative than the weights (none, or n x n).
  bool factoriseWith(std::span<const double> x, double shift, const std::vector<double>& more) {
    ++factorisations;
    std::vector<double> J(n_ * n_, 0.0);
    matrix_(x, J);
    for (std::size_t i = 0; i < n_; ++i) J[i * n_ + i] += weights[i] * shift;
    for (std::size_t k = 0; k < more.size(); ++k) J[k] += shift * more[k];
    return factors_.factorise(std::move(J), n_);
  }

 private:
  std::size_t n_;
  Residual residual_;
  Matrix matrix_;
  DenseFactors factors_;
};

using SmallSystem = SmallSystemOf<NewtonSystem>;

// One equation f(x) = 0.
inline SmallSystem scalar(std::function<double(double)> f, std::function<double(double)> derivative) {
  return {1, [f](auto x, auto F) { F[0] = f(x[0]); },
          [derivative](auto x, std::vector<double>& J) { J[0] = derivative(x[0]); }};
}

// Equations of all unknowns but the load; the last row is added here.
template <typename Base>
class SmallLoadedSystemOf : public SmallSystemOf<Base> {
 public:
  using typename SmallSystemOf<Base>::Residual;
  using typename SmallSystemOf<Base>::Matrix;

  SmallLoadedSystemOf(std::size_t n, Residual f, Matrix j)
      : SmallSystemOf<Base>(
            n,
            [this, n, f](std::span<const double> x, std::span<double> F) {
              f(x, F);
              F[n - 1] = constraint_ ? -constraint_->value : x[n - 1] - load_;
              if (constraint_)
                for (std::size_t i = 0; i < n; ++i) F[n - 1] += constraint_->coefficients[i] * x[i];
            },
            [this, n, j](std::span<const double> x, std::vector<double>& J) {
              j(x, J);
              for (std::size_t i = 0; i < n; ++i)
                J[n * (n - 1) + i] = constraint_ ? constraint_->coefficients[i] : (i == n - 1 ? 1.0 : 0.0);
            }) {
    this->weights[n - 1] = 0;
  }
  void setLoad(double load) override { load_ = load; }
  void setConstraint(std::optional<LoadConstraint> constraint) override { constraint_ = std::move(constraint); }

 private:
  double load_ = 0;
  std::optional<LoadConstraint> constraint_;
};

using SmallLoadedSystem = SmallLoadedSystemOf<LoadedSystem>;

// Bratu's problem -u'' - load e^u = 0, u(0) = u(1) = 0, with central differences at n inner points.
inline void bratuResidual(std::span<const double> u, std::size_t n, double load, std::span<double> F) {
  const double h = 1.0 / static_cast<double>(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = i > 0 ? u[i - 1] : 0, right = i + 1 < n ? u[i + 1] : 0;
    F[i] = (2 * u[i] - left - right) / (h * h) - load * std::exp(u[i]);
  }
}

// Its derivatives, into the first n rows and columns of a matrix with rows of `stride`.
inline void bratuMatrix(std::span<const double> u, std::size_t n, double load, std::size_t stride,
                        std::vector<double>& J) {
  const double h = 1.0 / static_cast<double>(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    J[i * stride + i] = 2 / (h * h) - load * std::exp(u[i]);
    if (i > 0) J[i * stride + i - 1] = -1 / (h * h);
    if (i + 1 < n) J[i * stride + i + 1] = -1 / (h * h);
  }
}

inline SmallSystem bratu(std::size_t n, double load) {
  return {n, [=](auto u, auto F) { bratuResidual(u, n, load, F); },
          [=](auto u, std::vector<double>& J) { bratuMatrix(u, n, load, n, J); }};
}

// Solution of the differential equation on its lower branch: u = 2 ln(cosh(t/4) / cosh((x - 1/2) t/2)) with
// t = sqrt(2 load) cosh(t/4), by fixed-point iteration, which converges on this branch.
inline double bratuExact(double x, double load) {
  double t = 0;
  for (int i = 0; i < 500; ++i) t = std::sqrt(2 * load) * std::cosh(t / 4);
  return 2 * std::log(std::cosh(t / 4) / std::cosh((x - 0.5) * t / 2));
}

}  // namespace lampblack::test
