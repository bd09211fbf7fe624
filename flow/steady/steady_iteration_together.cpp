// Iterations that change gas and flow together: Newton's method, and steps of one time.
#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "flow/stepping/time_step.hpp"

namespace lampblack::flow {
namespace {

// Of Newton's linear systems; of their pseudo-time, which goes on growing with each step that is taken, as thin cells
// would hold the flow in a short one; of what there was, what a step may leave at the longest: after more iterations of
// the other kind follow, each time twice as many.
constexpr double newtonReduction = 0.01;
constexpr double leastNewtonGrowth = 4.0, mostNewtonGrowth = 10.0, mostNewtonCourant = 1e9;
constexpr int mostPause = 1000;
constexpr double enoughOfNewton = 0.5;
constexpr int mostShorter = 6;  // implicit steps in one iteration, each shorter than that before

}  // namespace

SteadyIteration::Outcome SteadyIteration::attemptTogether(State& state) {
  Outcome outcome;
  outcome.courant = courant_;
  double last = measure_;
  NewtonKrylov::Result step;
  try {
    if (!state.eddyViscosity.empty()) {
      // Viscosities of the molecules have followed the last iteration: what is left is that of what they are now, as it
      // is of the states beside this one.
      for (Operator* op : operators_) op->setDiffusivities(state);
      state.updateHalo(context_.halo);
      residual_.evaluate(state);
      last = measure(state);
    }
    setInertia(state);
    step = newton_->advance(state, inertia_, newtonReduction);
    keepMass(state, massOf(*before_));
    outcome.newtonIterations = step.iterations;
    outcome.largestRise = step.largestRise;
    outcome.limited = step.limited;
    outcome.held = step.held;
    for (Operator* op : operators_) op->setDiffusivities(state);
    state.updateHalo(context_.halo);
    if (carried_ && state.eddyViscosity.empty()) outcome.held = advanceCarried(state);
    residual_.evaluate(state);
    measure_ = outcome.measure = measure(state);
  } catch (const NumericsError& error) {
    outcome.why = error.what();
    return outcome;
  }
  if (!(measure_ <= last) || step.limited > 0) return outcome;
  hurry();
  if (measure_ <= enoughOfNewton * last)
    pause_ = leastPause;
  else if (courant_ >= mostNewtonCourant)
    waitForNewton();
  outcome.taken = true;
  isAnew_ = false;
  mixing_.clear();
  courant_ = std::min(courant_ * std::clamp(last / measure_, leastNewtonGrowth, mostNewtonGrowth), mostNewtonCourant);
  return outcome;
}

SteadyIteration::Outcome SteadyIteration::stepInTime(State& state) {
  Outcome outcome;
  outcome.courant = courant_;
  double tried = 0.0;  // s
  try {
    const ImplicitStep::Result step = step_->advance(state, haste_);
    tried = step.time;
    outcome.newtonIterations = step.vectors;
    outcome.largestRise = step.largestRise;
    outcome.limited = step.limited;
    outcome.held = step.held;
    outcome.taken = step.taken;
    if (step.taken) measure_ = outcome.measure = measure(state);
  } catch (const NumericsError& error) {
    outcome.why = error.what();
    step_->shorten();
    return outcome;
  }
  hurry();
  if (!outcome.taken) outcome.why = fmt::format("Newton's method leads nowhere in a step of {:.2g} s", tried);
  return outcome;
}

SteadyIteration::Outcome SteadyIteration::attemptInTime(State& state) {
  const double last = measure_;
  Outcome outcome;
  for (int tries = 0; tries < mostShorter; ++tries) {
    outcome = stepInTime(state);
    if (outcome.taken) break;
    takeBack(state, last);
    outcome.measure = last;
  }
  // Newton's method goes on with the time of the step in the cell that gas leaves first, as others begin.
  if (outcome.taken) courant_ = step_->time() / convectiveTimeStep(context_.mesh, state, 1.0);
  isLimited_ = !outcome.taken || outcome.limited > 0;
  isAnew_ = !outcome.taken;
  mixing_.clear();
  return outcome;
}

void SteadyIteration::waitForNewton() {
  waits_ = pause_;
  if (!step_) pause_ = std::min(2 * pause_, mostPause);
}

}  // namespace lampblack::flow
