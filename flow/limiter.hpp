// Limited second-order upwind interpolation to a face.
#pragma once

#include <cmath>

#include "core/rooms.hpp"

namespace lampblack::flow {

// Face value between the upwind value `up` and the downwind value `down`. `slope` is the upwind cell's gradient along
// the direction up -> down times their distance; `fraction` the distance up -> face over the distance up -> down.
// van Leer's limiter (1974) on the ratio of successive differences (Darwish and Moukalled 2003 for general meshes).
inline double limitedFaceValue(double up, double down, double slope, double fraction) {
  const double step = down - up;
  const double previous = 2.0 * slope - step;  // difference up - upup of an equivalent uniform mesh
  const double product = previous * step;
  // step * psi(r) = step * 2r/(1+r) for r = previous/step > 0, written without division by zero.
  const double limited = product > 0.0 ? 2.0 * product / (previous + step) : 0.0;
  return up + fraction * limited;
}

}  // namespace lampblack::flow
