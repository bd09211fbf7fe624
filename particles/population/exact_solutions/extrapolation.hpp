// Ordinary differential equations to round-off: Gragg's midpoint rule with Richardson extrapolation (Bulirsch and Stoer
// 1966; Hairer, Norsett and Wanner 1993, II.9), order 16. For the few smooth and mildly stiff equations of moments.
#pragma once

#include <array>
#include <functional>

#include "core/modules.hpp"

namespace lampblack::particles::exact {

using FourMoments = std::array<double, 4>;
using MomentRates = std::function<FourMoments(double time, const FourMoments& y)>;

// y at `end`, from y at `start`; errors of a step stay below 1e-13 of each value. Throws NumericsError where the step
// vanishes, with the time reached.
[[nodiscard]] FourMoments extrapolated(const MomentRates& rates, double start, double end, FourMoments y);

}  // namespace lampblack::particles::exact
