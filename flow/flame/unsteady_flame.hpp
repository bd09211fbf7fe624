// Flames in time: PETSc's TS with backward differences of variable step (BDF), steps chosen by the error of those
// unknowns that have a rate of change; each step is solved by the damped Newton method of steady flames
// (newton_iteration.hpp), which keeps factors from step to step.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "numerics/newton_solver.hpp"
#include "numerics/unsteady_system.hpp"

namespace lampblack::flow {

struct UnsteadyOptions {
  double start = 0, end = 0;  // s
  double firstStep = 1e-6;    // s
  double largestStep = std::numeric_limits<double>::infinity();
  double smallestStep = 1e-14;  // s: below it the solution has failed
  int order = 2;                // of the differences, 1 to 5; above 2 slow for modes that oscillate
  // Local error of a step: root mean square over unknowns with a rate of change, in units of NewtonSystem::scales
  // (relative tolerances of 1e-4 for flames: 1e-3).
  double accuracy = 10;
  NewtonOptions newton = {.stepTolerance = 0.1, .maximumSteps = 12};  // tolerance below the accuracy
  std::vector<double> outputTimes;                                    // rising, within [start, end]
  std::function<double(double time)> load;                            // empty: the load of the start
};

struct UnsteadyReport {
  std::size_t steps = 0, rejected = 0;
  NewtonReport newton;  // counts of all steps
};

// From x at the start to x at the end. `output` is called at the output times with states interpolated to the order of
// the method. Algebraic unknowns of x need not be consistent at the start. InputError for options that make no sense;
// NumericsError (with time and unknown) where steps become too short. Collective.
UnsteadyReport integrateInTime(UnsteadySystem& system, std::span<double> x, const UnsteadyOptions& options,
                               const std::function<void(double time, std::span<const double> x)>& output = {});

}  // namespace lampblack::flow
