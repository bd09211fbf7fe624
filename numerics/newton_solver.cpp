#include "numerics/newton_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "numerics/newton_iteration.hpp"

namespace lampblack::numerics {
namespace {

NewtonOptions ofTimeSteps(NewtonOptions newton, const PseudoTransientOptions& transient) {
  newton.stepTolerance = transient.stepTolerance;
  newton.maximumSteps = transient.newtonSteps;
  newton.polish = 0;
  return newton;
}

// False, with x as it was, where the step does not converge.
bool attempt(NewtonIteration& iteration, std::span<double> x, double dt, NewtonReport& report) {
  const std::vector<double> old(x.begin(), x.end());
  iteration.eulerStep(old, dt, x, report);
  if (!report.converged) std::ranges::copy(old, x.begin());
  return report.converged;
}

// Counts of `part` go to `whole`; the rest is that of `part`.
void addCounts(NewtonReport& whole, NewtonReport part) {
  part.steps += whole.steps;
  part.factorisations += whole.factorisations;
  part.residuals += whole.residuals;
  part.timeSteps += whole.timeSteps;
  whole = std::move(part);
}

}  // namespace

struct NewtonSolver::Data {
  NewtonOptions newton;
  PseudoTransientOptions transient;
  NewtonReport last;  // of steady()

  // Some time steps from x, the first of length dt; dt becomes that of the next. Returns why they had to stop early;
  // empty otherwise.
  std::string advance(NewtonSystem& system, std::span<double> x, double& dt, NewtonReport& report) const {
    NewtonIteration iteration(system, ofTimeSteps(newton, transient));
    for (std::size_t done = 0; done < transient.stepsBetweenNewton && dt <= transient.largestStep;) {
      if (report.timeSteps >= transient.maximumSteps)
        return fmt::format("not steady after {} time steps, the next of {:.3g} s", report.timeSteps, dt);
      const std::size_t before = report.steps;
      if (attempt(iteration, x, dt, report)) {
        ++report.timeSteps;
        ++done;
        system.clipNegativeAmounts(x);
        if (3 * (report.steps - before) <= transient.newtonSteps) dt *= transient.growth;
      } else {
        dt *= transient.cut;
        if (dt < transient.smallestStep)
          return fmt::format("a time step shorter than {:g} s failed: {}", transient.smallestStep, report.reason);
      }
    }
    return {};
  }
};

NewtonSolver::NewtonSolver(NewtonOptions options, PseudoTransientOptions transient)
    : data_(std::make_unique<Data>(Data{options, transient, {}})) {}

NewtonSolver::~NewtonSolver() = default;

NewtonReport NewtonSolver::newton(NewtonSystem& system, std::span<double> x) {
  NewtonReport report;
  NewtonIteration(system, data_->newton).steady(x, report);
  return report;
}

bool NewtonSolver::timeStep(NewtonSystem& system, std::span<double> x, double dt, NewtonReport& report) {
  NewtonIteration iteration(system, ofTimeSteps(data_->newton, data_->transient));
  if (!attempt(iteration, x, dt, report)) return false;
  ++report.timeSteps;
  return true;
}

NewtonReport NewtonSolver::steady(NewtonSystem& system, std::vector<double>& x, const std::function<void()>& between) {
  NewtonReport& report = data_->last;
  report = {};
  double dt = data_->transient.firstStep;
  std::vector<double> solution = x;
  while (true) {
    NewtonReport part;
    try {
      NewtonIteration(system, data_->newton).steady(solution, part);
    } catch (...) {
      addCounts(report, std::move(part));
      throw;
    }
    addCounts(report, std::move(part));
    if (report.converged) {
      x = std::move(solution);
      return report;
    }
    if (dt > data_->transient.largestStep) {
      report.reason = fmt::format("time steps went beyond {:g} s, but Newton's method does not converge: {}",
                                  data_->transient.largestStep, report.reason);
      return report;
    }
    if (between) between();
    if (const std::string stopped = data_->advance(system, x, dt, report); !stopped.empty()) {
      report.converged = false;
      report.reason = stopped;
      return report;
    }
    solution = x;
  }
}

const NewtonReport& NewtonSolver::report() const {
  return data_->last;
}

}  // namespace lampblack::numerics
