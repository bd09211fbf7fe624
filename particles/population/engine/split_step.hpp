// The one splitting of all stochastic populations (Strang 1968): processes over one step, each but the last for half of
// it before those that follow and for half of it after them. Of second order in the step, whose length the callers
// choose by what a population changes in it.
#pragma once

#include "core/modules.hpp"

namespace lampblack::particles {

template <class Process>
void splitStep(double dt, Process&& last) {
  last(dt);
}
// Each is process(time), s.
template <class Process, class... Others>
void splitStep(double dt, Process&& first, Others&&... others) {
  first(0.5 * dt);
  splitStep(dt, others...);
  first(0.5 * dt);
}

// Steps one after the other over dt (s), while length(time that is left) gives one that is not longer, and not zero.
template <class Length, class Step>
void inSteps(double dt, Length length, Step step) {
  for (double remaining = dt; remaining > 0;) {
    const double next = length(remaining);
    if (!(next > 0)) return;
    step(next);
    remaining = next < remaining ? remaining - next : 0;
  }
}

}  // namespace lampblack::particles
