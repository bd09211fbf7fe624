// How far beyond their range transport polynomials are evaluated, smoothly: an iteration towards a state at an end of
// the range has room there, while inputs stay within Transport::minTemperature and maxTemperature.
#pragma once

#include "core/modules.hpp"

namespace lampblack::chemistry::transportmargin {

inline constexpr double coldest = 190.0;   // K
inline constexpr double hottest = 4200.0;  // K

}  // namespace lampblack::chemistry::transportmargin
