// Stiff systems y' = f(y) over short times, where a multistep method would spend its time on starting: RODAS3
// (Sandu, Verwer, Blom, Spee, Carmichael, Potra 1997), a Rosenbrock method of order 3 with an embedded one of order 2,
// L-stable and stiffly accurate. A step costs one Jacobian, one factorisation, three evaluations and four solutions,
// whatever the stiffness; where accuracy allows, the whole time is one step. Linear invariants of f, as elements, are
// kept to round-off as long as the Jacobian has them, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "numerics/dense_lu.hpp"

namespace lampblack::numerics {

// What the method needs of a system. False: the state has no rates, or the matrix no factors.
template <typename System>
concept RosenbrockSystem = requires(System& system, std::span<const double> y, std::span<double> f, double gamma) {
  { system.rates(y, f) } -> std::convertible_to<bool>;       // f(y)
  { system.linearise(y, f) } -> std::convertible_to<bool>;   // f(y), and keeps the Jacobian J at y
  { system.factorise(gamma) } -> std::convertible_to<bool>;  // I - gamma J
  system.solve(f);                                           // overwrites the right-hand side with the solution
};

struct DenseRosenbrockMatrices {
  explicit DenseRosenbrockMatrices(std::size_t n) : derivatives(n), factors(n) {}
  DenseLu derivatives, factors;
};

// A system with a full matrix: rates(y, f) fills f; jacobian(y, J) fills all rows of all columns of J.
template <typename Rates, typename Jacobian>
class DenseRosenbrockSystem {
 public:
  DenseRosenbrockSystem(const Rates& rates, const Jacobian& jacobian, DenseRosenbrockMatrices& matrices)
      : rates_(rates), jacobian_(jacobian), matrices_(matrices) {}

  bool rates(std::span<const double> y, std::span<double> f) {
    rates_(y, f);
    return true;
  }
  bool linearise(std::span<const double> y, std::span<double> f) {
    jacobian_(y, matrices_.derivatives);
    return rates(y, f);
  }
  bool factorise(double gamma) {
    const std::size_t n = matrices_.factors.size();
    for (std::size_t j = 0; j < n; ++j) {
      const double* derivatives = matrices_.derivatives.column(j);
      double* column = matrices_.factors.column(j);
      for (std::size_t i = 0; i < n; ++i) column[i] = -gamma * derivatives[i];
      column[j] += 1;
    }
    return matrices_.factors.factorise();
  }
  void solve(std::span<double> b) { matrices_.factors.solve(b.data()); }

 private:
  const Rates& rates_;
  const Jacobian& jacobian_;
  DenseRosenbrockMatrices& matrices_;
};

class RosenbrockSolver {
 public:
  // The error of a step is kept below `relative` times (|y| + smallest), in the root mean square over the unknowns.
  struct Tolerance {
    double relative = 1e-4;
    std::span<const double> smallest;
    int maximumSteps = 20000;  // those rejected among them
  };
  struct Result {
    int steps = 0, rejected = 0;
    bool isStopped = false;
    // What the error of the last step, taken or rejected, asks of the next: longer than all of the time, if it may be.
    double nextStep = 0;
  };

  static constexpr double smallestStep = 1e-13;  // over dt
  static constexpr double roundOff = 1e-12;      // of dt, that may be left at the end

  // What follows on a step of size h: whether it is rejected, and the size of the next.
  struct StepSize {
    double size;
    bool isRejected;
  };
  static StepSize nextStep(double h, std::optional<double> error, bool wasRejected) {
    const double factor =
        error ? std::clamp(0.9 / std::cbrt(std::max(*error, 1e-10)), 0.1, wasRejected ? 1.0 : 5.0) : 0.1;
    const bool isRejected = !error || *error > 1;
    return {h * (isRejected ? std::min(factor, 0.9) : factor), isRejected};
  }

  // `y` is advanced over `dt`, at first by a step of `firstStep` (0: all of it). goesOn(y, h) is asked
  // after every step, of size h; where it says no, that is the end. Throws NumericsError where steps become too small
  // or too many, or values are not finite; `y` is then that of the last good step.
  template <RosenbrockSystem System, typename Guard>
  Result integrate(System& system, double dt, double firstStep, std::span<double> y, const Tolerance& tolerance,
                   const Guard& goesOn) {
    Result result;
    if (!tryToIntegrate(system, dt, firstStep, y, tolerance, goesOn, result))
      throw NumericsError(result.steps + result.rejected >= tolerance.maximumSteps
                              ? "the stiff integrator needs too many steps"
                              : "the stiff integrator cannot go on, however small its steps");
    return result;
  }

  // The same for whoever has another way: false where the other throws. `result` is told in any case.
  template <RosenbrockSystem System, typename Guard>
  bool tryToIntegrate(System& system, double dt, double firstStep, std::span<double> y, const Tolerance& tolerance,
                      const Guard& goesOn, Result& result) {
    for (std::vector<double>* v : {&f_, &start_, &k1_, &k2_, &k3_, &k4_, &end_}) v->resize(y.size());
    result = {};
    double t = 0, h = firstStep > 0 ? std::min(firstStep, dt) : dt;
    bool isRejected = false;
    while (t < dt) {
      result.nextStep = h;
      if (result.steps + result.rejected >= tolerance.maximumSteps || h < smallestStep * dt) return false;
      const bool isLast = t + h >= dt * (1 - roundOff);
      if (isLast) h = dt - t;
      if (!isRejected && !system.linearise(y, start_)) return false;  // else those of the step rejected
      const std::optional<double> error = step(system, h, y, tolerance);
      const StepSize next = nextStep(h, error, isRejected);
      isRejected = next.isRejected;
      result.nextStep = next.size;
      if (isRejected) {
        ++result.rejected;
        h = result.nextStep;
        continue;
      }
      ++result.steps;
      std::copy(end_.begin(), end_.end(), y.begin());
      result.isStopped = !goesOn(y, h);
      if (isLast || result.isStopped) break;
      t += h;
      h = result.nextStep;
    }
    return true;
  }

  // What a step makes of a small change of its start, by the derivatives there: for goesOn, which is asked while the
  // matrix is that of the step.
  template <RosenbrockSystem System>
  void carry(System& system, std::span<double> change) {
    const std::size_t n = change.size();
    const auto solveFor = [&](std::vector<double>& k, const auto& rightSide) {
      for (std::size_t i = 0; i < n; ++i) k[i] = rightSide(i);
      system.solve(k);
    };
    // (I - gamma h J)^-1 gamma h J v = (I - gamma h J)^-1 v - v.
    solveFor(k1_, [&](std::size_t i) { return change[i]; });
    for (std::size_t i = 0; i < n; ++i) k1_[i] -= change[i];
    solveFor(k2_, [&](std::size_t i) { return k1_[i]; });
    for (std::size_t i = 0; i < n; ++i) {
      k2_[i] = k1_[i] + 2 * k2_[i];
      end_[i] = change[i] + 2 * k1_[i];
    }
    solveFor(k3_, [&](std::size_t i) { return end_[i] + (k1_[i] - k2_[i]) / 2; });
    for (std::size_t i = 0; i < n; ++i) {
      k3_[i] -= end_[i];
      end_[i] += k3_[i];
    }
    solveFor(k4_, [&](std::size_t i) { return end_[i] + (k1_[i] - k2_[i] - 8.0 / 3.0 * k3_[i]) / 2; });
    for (std::size_t i = 0; i < n; ++i) change[i] = k4_[i];
  }

  template <typename Rates, typename Jacobian, typename Guard>
  requires(!RosenbrockSystem<Rates>) Result
      integrate(const Rates& rates, const Jacobian& jacobian, double dt, std::span<double> y,
                const Tolerance& tolerance, const Guard& goesOn) {
    if (!dense_ || dense_->factors.size() != y.size()) dense_.emplace(y.size());
    DenseRosenbrockSystem system(rates, jacobian, *dense_);
    return integrate(system, dt, 0, y, tolerance, goesOn);
  }
  template <typename Rates, typename Jacobian>
  requires(!RosenbrockSystem<Rates>) Result integrate(const Rates& rates, const Jacobian& jacobian, double dt,
                                                      std::span<double> y, const Tolerance& tolerance) {
    return integrate(rates, jacobian, dt, y, tolerance, [](std::span<const double>, double) { return true; });
  }

 private:
  static constexpr double gamma = 0.5;

  // end_ = y after h; the scaled error, or nothing where the step cannot be taken.
  template <RosenbrockSystem System>
  std::optional<double> step(System& system, double h, std::span<const double> y, const Tolerance& tolerance) {
    const std::size_t n = y.size();
    const double scale = gamma * h;
    if (!system.factorise(scale)) return {};
    // Coefficients in the form without products by the Jacobian (Hairer and Wanner, IV.7), times gamma h.
    for (std::size_t i = 0; i < n; ++i) k1_[i] = scale * start_[i];
    system.solve(k1_);
    for (std::size_t i = 0; i < n; ++i) k2_[i] = scale * start_[i] + 2 * k1_[i];
    system.solve(k2_);
    for (std::size_t i = 0; i < n; ++i) end_[i] = y[i] + 2 * k1_[i];
    if (!system.rates(end_, f_)) return {};
    for (std::size_t i = 0; i < n; ++i) k3_[i] = scale * f_[i] + (k1_[i] - k2_[i]) / 2;
    system.solve(k3_);
    for (std::size_t i = 0; i < n; ++i) end_[i] = y[i] + 2 * k1_[i] + k3_[i];
    if (!system.rates(end_, f_)) return {};
    for (std::size_t i = 0; i < n; ++i) k4_[i] = scale * f_[i] + (k1_[i] - k2_[i] - 8.0 / 3.0 * k3_[i]) / 2;
    system.solve(k4_);
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

  std::optional<DenseRosenbrockMatrices> dense_;
  std::vector<double> f_, start_, k1_, k2_, k3_, k4_, end_;
};

}  // namespace lampblack::numerics
