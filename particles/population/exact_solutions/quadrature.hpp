// Integrals of smooth functions to round-off: Gauss-Legendre panels, halved until two halves agree with the whole.
#pragma once

#include <functional>
#include <span>

#include "core/modules.hpp"

namespace lampblack::particles {

// Integral of f over [a, b]. Breakpoints are kinks of f, and lengths on which it varies, in any order; those outside
// are ignored.
[[nodiscard]] double integral(const std::function<double(double)>& f, double a, double b,
                              std::span<const double> breakpoints = {});

// Integral over [a, b], 0 <= a < b <= infinity, of a density that varies on the scale of the size itself and has
// nothing left beyond `largest`: panels from one power of two to the next.
[[nodiscard]] double integralOverSizes(const std::function<double(double)>& f, double a, double b, double largest);

}  // namespace lampblack::particles
