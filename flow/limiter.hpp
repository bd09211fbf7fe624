// Limited second-order upwind interpolation to a face.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/rooms.hpp"
#include "flow/upwind.hpp"

namespace lampblack::flow {

// Face value between the upwind value `up` and the downwind value `down`. `gradient` is that of the upwind cell along
// the direction up -> down, by the parabola of Gradient. Between the values of both sides' neighbours whatever the
// distances are, so that steps of half a cell's volume make no new extrema.
//
// van Leer's limiter (1974), the harmonic mean of the slopes ahead and behind, on a graded mesh with the weights by
// which the arithmetic mean is the parabola's slope (as Fritsch and Butland 1984 have them for interpolation).
inline double limitedFaceValue(double up, double down, double gradient, const Upwind& at) {
  const double ahead = (down - up) / at.ahead;
  const double behind = gradient + (gradient - ahead) * at.behind / at.ahead;
  const bool isMonotone = ahead * behind > 0.0;
  const double sum = at.ahead * ahead + at.behind * behind;
  // Without a branch, so that a loop over species goes through vectors.
  const double slope = (at.ahead + at.behind) * ahead * behind / (isMonotone ? sum : 1.0);
  const double largest = std::min(std::abs(down - up), std::abs(behind) * at.behind);
  const double step = std::copysign(std::min(std::abs(slope) * at.toFace, largest), slope);
  return up + (isMonotone ? step : 0.0);
}

}  // namespace lampblack::flow
