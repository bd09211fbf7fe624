// The steady state of a system of stiff equations: the transient from a start until little moves, then Newton's method
// to round-off. The transient decides which of several steady states (burning, extinct) is found.
#pragma once

#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct SteadyState {
  std::vector<double> y;
  double time = 0;      // of the transient, s
  long steps = 0;       // of the transient
  int iterations = 0;   // of Newton's method that led to the result
  double residual = 0;  // largest |timeScale f_i| / (|y_i| + 1e-6)
};

// `timeScale` (s) is that of the slowest change, such as a residence time. NumericsError, with the state, where the
// transient fails or does not come to rest within `patience` time scales.
SteadyState findSteadyState(OdeSystem& system, const std::vector<double>& start, double timeScale,
                            double patience = 1e5);

}  // namespace lampblack::chemistry
