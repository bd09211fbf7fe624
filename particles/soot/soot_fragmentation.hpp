// How often oxidation breaks an aggregate of soot up: k = A w n_p^(1/D_f) s(n_p), w being the carbon that it oxidises
// per area and time (Zhang, Thomson, Guo, Liu, Smallwood 2010). Of all populations that have aggregates: what an
// aggregate breaks into is their own. docs/theory/soot_models.md, "Fragmentation".
#pragma once

#include <array>
#include <cmath>

#include "core/modules.hpp"

namespace lampblack::particles {

struct SootFragmentation {
  bool active = false;
  double factor = 1e5;            // A, m2/kg
  double fractalDimension = 1.8;  // D_f, of the exponent alone

  // k/w of an aggregate of n_p primaries, 1/s per kg/m2/s, and its derivative by n_p. s goes smoothly from 0 at one
  // primary to 1 at two.
  [[nodiscard]] std::array<double, 2> perOxidation(double primaries) const {
    if (!active || primaries <= 1) return {0, 0};
    const double exponent = 1 / fractalDimension;
    const double value = factor * std::pow(primaries, exponent), slope = exponent * value / primaries;
    if (primaries >= 2) return {value, slope};
    const double t = primaries - 1, ramp = t * t * (3 - 2 * t), rampSlope = 6 * t * (1 - t);
    return {value * ramp, slope * ramp + value * rampSlope};
  }
};

}  // namespace lampblack::particles
