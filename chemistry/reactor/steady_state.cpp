#include "chemistry/reactor/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "numerics/dense_lu.hpp"

namespace lampblack::chemistry {

namespace {

// Unknowns below this size count as much as it.
constexpr double kFloor = 1e-6;
// Newton's method is tried when the transient moves less than this in a time scale or has gone on for long, and may not
// lead further away than ten times this: it polishes a steady state and does not search for one.
constexpr double kAtRest = 1e-3;
constexpr double kLong = 30;
constexpr double kConverged = 1e-11;
constexpr int kMostIterations = 12;

class Newton {
 public:
  Newton(OdeSystem& system, double timeScale)
      : system_(system), timeScale_(timeScale), n_(system.size()), lu_(n_), f_(n_), J_(lu_.leadingDimension() * n_) {}

  // Largest relative change in a time scale.
  double motion(const std::vector<double>& y) {
    if (!system_.rates(0.0, y.data(), f_.data())) return INFINITY;
    double largest = 0;
    for (std::size_t i = 0; i < n_; ++i)
      largest = std::max(largest, std::abs(timeScale_ * f_[i]) / (std::abs(y[i]) + kFloor));
    return largest;
  }

  // From near a steady state to it; nothing where the iterations do not shrink or lead away.
  std::optional<std::vector<double>> solve(const std::vector<double>& start, int& iterations) {
    std::vector<double> y = start, step(n_);
    double previous = INFINITY;
    for (iterations = 1; iterations <= kMostIterations; ++iterations) {
      if (!factorise(y)) return std::nullopt;
      step.assign(f_.begin(), f_.end());
      lu_.solve(step.data());
      double size = 0, distance = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        y[i] -= step[i];
        size = std::max(size, std::abs(step[i]) / (std::abs(y[i]) + kFloor));
        distance = std::max(distance, std::abs(y[i] - start[i]) / (std::abs(start[i]) + kFloor));
      }
      if (!(distance < 10 * kAtRest)) return std::nullopt;
      // Round-off ends the shrinking; what is left then has to be small.
      if (size < kConverged || (size >= 0.5 * previous && size < 1e3 * kConverged)) return y;
      if (size > previous) return std::nullopt;
      previous = size;
    }
    return std::nullopt;
  }

 private:
  bool factorise(const std::vector<double>& y) {
    const std::size_t ld = lu_.leadingDimension();
    if (!system_.jacobian(0.0, y.data(), f_.data(), J_.data(), ld)) return false;
    for (std::size_t j = 0; j < n_; ++j) std::copy_n(J_.data() + j * ld, n_, lu_.column(j));
    for (std::size_t i = 0; i < n_; ++i) {  // a given unknown has no equation
      bool empty = f_[i] == 0;
      for (std::size_t j = 0; empty && j < n_; ++j) empty = J_[i + j * ld] == 0;
      if (empty) lu_.column(i)[i] = 1.0;
    }
    return lu_.factorise();
  }

  OdeSystem& system_;
  double timeScale_;
  std::size_t n_;
  DenseLu lu_;
  std::vector<double> f_, J_;
};

}  // namespace

SteadyState findSteadyState(OdeSystem& system, const std::vector<double>& start, double timeScale, double patience) {
  Newton newton(system, timeScale);
  StiffIntegrator integrator(system, {1e-7, 1e-13, 0.0, 1000000});
  SteadyState result;
  integrator.start(0.0, start, patience * timeScale);
  double nextTry = timeScale;
  while (integrator.time() < patience * timeScale) {
    if (const int signal = stopRequest(); signal != 0)
      throw Stopped(signal, "stopped by " + signalName(signal) + " on the way to the steady state: nothing is kept");
    integrator.step();
    if (integrator.time() < nextTry) continue;
    const std::vector<double> y(integrator.state().begin(), integrator.state().end());
    // Over many time scales the balance of large rates is noise that hides the rest.
    if (newton.motion(y) > kAtRest && integrator.time() < kLong * timeScale) continue;
    nextTry = 1.5 * integrator.time();
    const auto found = newton.solve(y, result.iterations);
    if (!found) continue;
    result.y = *found;
    result.time = integrator.time();
    result.steps = integrator.statistics().steps;
    result.residual = newton.motion(*found);
    return result;
  }
  throw NumericsError(fmt::format("no steady state within {:.6g} s: {}", integrator.time(),
                                  system.describe(integrator.time(), integrator.state().data())));
}

}  // namespace lampblack::chemistry
