#include "chemistry/reactor/reactor_integrator.hpp"

#include <cvodes/cvodes.h>
#include <fmt/format.h>

#include <algorithm>

#include "numerics/short_vector.hpp"

namespace lampblack::chemistry {

using sundials::check;

ReactorIntegrator::ReactorIntegrator(ReactorSystem& system)
    : system_(system),
      context_(sundials::makeContext()),
      y_(sundials::makeShortVector(system.size(), context_.get())),
      tolerances_(sundials::makeShortVector(system.size(), context_.get())),
      linearSolver_(system, context_.get()),
      cvode_(CVodeCreate(CV_BDF, context_.get())) {
  void* memory = cvode_.get();
  check(memory, "CVodeCreate");
  check(CVodeInit(memory, rates, 0.0, y_.get()), "CVodeInit");
  N_VConst(1.0, tolerances_.get());
  check(CVodeSVtolerances(memory, 1.0, tolerances_.get()), "CVodeSVtolerances");
  check(CVodeSetUserData(memory, this), "CVodeSetUserData");
  sundials::keepErrors<keepMessage>(memory, context_.get(), this);
  linearSolver_.attach(memory);
}

int ReactorIntegrator::rates(sunrealtype /*t*/, N_Vector y, N_Vector f, void* data) {
  auto& self = *static_cast<ReactorIntegrator*>(data);
  return self.system_.rates(N_VGetArrayPointer(y), N_VGetArrayPointer(f)) ? 0 : 1;
}

void ReactorIntegrator::keepMessage(const char* function, const char* message, void* integrator) {
  auto& self = *static_cast<ReactorIntegrator*>(integrator);
  self.reason_ = fmt::format("{}: {}", function, message);
  if (!self.system_.refusal().empty())
    self.reason_ += fmt::format(" (the last state refused has {})", self.system_.refusal());
}

bool ReactorIntegrator::advance(const Interval& interval, Work& work, const Watcher& watcher) {
  void* memory = cvode_.get();
  reason_.clear();
  system_.clearRefusal();
  N_VConst(interval.absoluteTolerance, tolerances_.get());
  // A temperature error of the relative tolerance is enough; its absolute part only guards the weights.
  N_VGetArrayPointer(tolerances_.get())[system_.numSpecies()] = interval.relativeTolerance;
  check(CVodeReInit(memory, 0.0, y_.get()), "CVodeReInit");
  check(CVodeSVtolerances(memory, interval.relativeTolerance, tolerances_.get()), "CVodeSVtolerances");
  check(CVodeSetInitStep(memory, std::min(interval.firstStep, interval.duration)), "CVodeSetInitStep");
  check(CVodeSetMaxNumSteps(memory, interval.maxSteps), "CVodeSetMaxNumSteps");
  check(CVodeSetStopTime(memory, interval.duration), "CVodeSetStopTime");
  const bool arrived = run(interval, watcher);
  long steps = 0, rhsCalls = 0, jacobians = 0;
  check(CVodeGetNumSteps(memory, &steps), "CVodeGetNumSteps");
  check(CVodeGetNumRhsEvals(memory, &rhsCalls), "CVodeGetNumRhsEvals");
  check(CVodeGetNumJacEvals(memory, &jacobians), "CVodeGetNumJacEvals");
  check(CVodeGetLastStep(memory, &lastStep_), "CVodeGetLastStep");
  work.steps += static_cast<int>(steps);
  work.rhsEvaluations += static_cast<int>(rhsCalls);
  work.jacobianEvaluations += static_cast<int>(jacobians);
  return arrived;
}

bool ReactorIntegrator::run(const Interval& interval, const Watcher& watcher) {
  void* memory = cvode_.get();
  sunrealtype reached = 0;
  if (!watcher) return CVode(memory, interval.duration, y_.get(), &reached, CV_NORMAL) >= 0;
  for (int steps = 0; reached < interval.duration; ++steps) {
    if (steps == interval.maxSteps) {
      reason_ = fmt::format("{} steps taken before reaching the end", steps);
      return false;
    }
    if (CVode(memory, interval.duration, y_.get(), &reached, CV_ONE_STEP) < 0) return false;
    Step step{reached, 0, 0, state()[system_.numSpecies()]};
    check(CVodeGetLastStep(memory, &step.size), "CVodeGetLastStep");
    check(CVodeGetLastOrder(memory, &step.order), "CVodeGetLastOrder");
    watcher(step);
  }
  return true;
}

}  // namespace lampblack::chemistry
