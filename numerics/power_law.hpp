// A power law through points by least squares in the logarithms.
#pragma once

#include <span>

namespace lampblack::numerics {

// A straight line through points by least squares.
struct FittedLine {
  double slope = 0, slopeError = 0;  // and its standard error; NaN of two points, which leave nothing to judge it by
};
// Of log(y) over log(x). Points with x or y not positive, or y not finite, are left out; NaN where fewer than two, or
// only one x, are left.
FittedLine fitPowerLaw(std::span<const double> x, std::span<const double> y);

}  // namespace lampblack::numerics
