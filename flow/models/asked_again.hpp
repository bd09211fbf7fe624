// When a cell whose reactions grew in no step is asked again how fast they do, which costs as much as some of its steps
// of chemistry.
#pragma once

#include <cmath>

namespace lampblack::flow {

struct AskedAgain {
  // After so many steps; after more where a step changes about as much as when it was asked last, as in a steady flame.
  static constexpr double soon = 8.0, late = 32.0;
  // At once where a step changes so much more; late where it changes by no more than this share less.
  static constexpr double more = 1.25, less = 0.25;

  // One more step, which changes a mass fraction by `change`. `asked`: the change in the step in which the cell was
  // asked last, zero: never; `left`: steps until it is asked. Both go on from step to step.
  static bool isDue(double change, double& asked, double& left) {
    if (change < more * asked && --left > 0.0) return false;
    left = std::abs(change - asked) <= less * asked ? late : soon;
    asked = change;
    return true;
  }
};

}  // namespace lampblack::flow
