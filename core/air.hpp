// Air, in place of a gas whose transport is not known.
#pragma once

#include <cmath>

namespace lampblack {

// Pa s, at a temperature in K: Sutherland's law, 1.458e-6 T^1.5/(T + 110.4) Pa s (as in Kazakov and Frenklach 1998).
[[nodiscard]] inline double viscosityOfAir(double T) {
  return 1.458e-6 * T * std::sqrt(T) / (T + 110.4);
}

}  // namespace lampblack
