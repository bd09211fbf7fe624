// Small stiff systems y' = f(y) over short times, where a multistep method would spend its time on starting: RODAS3
// (Sandu, Verwer, Blom, Spee, Carmichael, Potra 1997), a Rosenbrock method of order 3 with an embedded one of order 2,
// L-stable and stiffly accurate. A step costs one Jacobian, one factorisation, three evaluations and four solutions,
// whatever the stiffness; where accuracy allows, the whole time is one step. Linear invariants of f, as elements, are
// kept to round-off as long as the Jacobian has them, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "chemistry/numerics/dense_lu.hpp"
#include "core/errors.hpp"
#include "core/rooms.hpp"

namespace lampblack::chemistry {

class RosenbrockSolver {
 public:
  // The error of a step is kept below `relative` times (|y| + smallest), in the root mean square over the unknowns.
  struct Tolerance {
    double relative = 1e-4;
    std::span<const double> smallest;
    int maximumSteps = 20000;
  };
  struct Result {
    int steps = 0, rejected = 0;
    bool isStopped = false;
  };

  // rates(y, f) fills f; jacobian(y, J) fills all rows of all columns of J. `y` is advanced over `dt`. Throws
  // NumericsError where steps become too small or too many, or values are not finite; `y` is then that of the last good
  // step. goesOn(y) is asked after every step; where it says no, that is the end.
  template <typename Rates, typename Jacobian, typename Guard>
  Result integrate(const Rates& rates, const Jacobian& jacobian, double dt, std::span<double> y,
                   const Tolerance& tolerance, const Guard& goesOn) {
    resize(y.size());
    Result result;
    double t = 0, h = dt;
    bool isRejected = false;
    while (t < dt) {
      if (result.steps + result.rejected >= tolerance.maximumSteps)
        throw NumericsError("the stiff integrator needs too many steps");
      if (h < smallestStep * dt) throw NumericsError("the stiff integrator's step has become too small");
      const bool isLast = t + h >= dt * (1 - roundOff);
      if (isLast) h = dt - t;
      const std::optional<double> error = step(rates, jacobian, h, y, tolerance);
      const double factor =
          error ? std::clamp(0.9 / std::cbrt(std::max(*error, 1e-10)), 0.1, isRejected ? 1.0 : 5.0) : 0.1;
      isRejected = !error || *error > 1;
      if (isRejected) {
        ++result.rejected;
        h *= std::min(factor, 0.9);
        continue;
      }
      ++result.steps;
      std::copy(end_.begin(), end_.end(), y.begin());
      result.isStopped = !goesOn(y);
      if (isLast || result.isStopped) break;
      t += h;
      h *= factor;
    }
    return result;
  }
  template <typename Rates, typename Jacobian>
  Result integrate(const Rates& rates, const Jacobian& jacobian, double dt, std::span<double> y,
                   const Tolerance& tolerance) {
    return integrate(rates, jacobian, dt, y, tolerance, [](std::span<const double>) { return true; });
  }

 private:
  static constexpr double smallestStep = 1e-13;  // over dt
  static constexpr double roundOff = 1e-12;
  static constexpr double gamma = 0.5;

  void resize(std::size_t n) {
    if (matrix_ && matrix_->size() == n) return;
    matrix_.emplace(n);
    for (std::vector<double>* v : {&f_, &k1_, &k2_, &k3_, &k4_, &end_}) v->resize(n);
  }

  // end_ = y after h; the scaled error, or nothing where the step cannot be taken.
  template <typename Rates, typename Jacobian>
  std::optional<double> step(const Rates& rates, const Jacobian& jacobian, double h, std::span<const double> y,
                             const Tolerance& tolerance) {
    const std::size_t n = y.size();
    jacobian(y, *matrix_);
    for (std::size_t j = 0; j < n; ++j) {
      double* column = matrix_->column(j);
      for (std::size_t i = 0; i < n; ++i) column[i] = -column[i];
      column[j] += 1 / (h * gamma);
    }
    if (!matrix_->factorise()) return {};
    // Coefficients in the form without products by the Jacobian (Hairer and Wanner, IV.7).
    rates(y, f_);
    for (std::size_t i = 0; i < n; ++i) k1_[i] = f_[i];
    matrix_->solve(k1_.data());
    for (std::size_t i = 0; i < n; ++i) k2_[i] = f_[i] + 4 / h * k1_[i];
    matrix_->solve(k2_.data());
    for (std::size_t i = 0; i < n; ++i) end_[i] = y[i] + 2 * k1_[i];
    rates(end_, f_);
    for (std::size_t i = 0; i < n; ++i) k3_[i] = f_[i] + (k1_[i] - k2_[i]) / h;
    matrix_->solve(k3_.data());
    for (std::size_t i = 0; i < n; ++i) end_[i] = y[i] + 2 * k1_[i] + k3_[i];
    rates(end_, f_);
    for (std::size_t i = 0; i < n; ++i) k4_[i] = f_[i] + (k1_[i] - k2_[i] - 8.0 / 3.0 * k3_[i]) / h;
    matrix_->solve(k4_.data());
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      end_[i] += k4_[i];
      const double scaled =
          k4_[i] / (tolerance.relative * (std::max(std::abs(y[i]), std::abs(end_[i])) + tolerance.smallest[i]));
      sum += scaled * scaled;
    }
    if (!std::isfinite(sum)) return {};
    return std::sqrt(sum / static_cast<double>(n));
  }

  std::optional<DenseLu> matrix_;
  std::vector<double> f_, k1_, k2_, k3_, k4_, end_;
};

}  // namespace lampblack::chemistry
