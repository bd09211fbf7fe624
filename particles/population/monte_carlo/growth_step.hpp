// The step of time over which growth is split from the jumps, or deferred.
#pragma once

#include <algorithm>
#include <limits>

#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

// How fast growth changes volumes relative to themselves, |dv/dt| / v, and how often jumps happen, 1/s.
struct GrowthPace {
  double population = 0;   // mean over the particles
  double nucleus = 0;      // of a particle just nucleated; zero without nucleation
  double jumpsOfEach = 0;  // rate of jumps in which one particle takes part, or a bound from above
};

// The step, s, in which growth changes the volumes by the share `part`. Towards its burn-out a particle loses its
// volume ever faster relative to itself (dd/dt is constant), and steps of a share of what is left would never reach the
// end. But growth alone is exact in a step of any length: only jumps that happen within a step are treated wrongly. So
// particles that shrink take no steps shorter than those in which one in a thousand jumps.
inline double growthStep(const GrowthOptions& growth, double part, const GrowthPace& pace) {
  constexpr double jumping = 1e-3;
  const bool shrinks = growth.condensation < 0 || growth.surface() < 0;
  if (growth.step > 0) return growth.step;
  const double population = shrinks ? std::min(pace.population, part / jumping * pace.jumpsOfEach) : pace.population;
  const double rate = std::max(population, pace.nucleus);
  return rate > 0 ? part / rate : std::numeric_limits<double>::infinity();
}

}  // namespace lampblack::particles
