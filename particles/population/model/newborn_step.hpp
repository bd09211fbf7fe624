// How long a step of a splitting may be for the particles that are born in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/modules.hpp"

namespace lampblack::particles {

// A step chosen by the particles that are there knows nothing of those born during it, which may be all there will be.
// `nuclei`: born, 1/m3/s; `number`: of particles there are, 1/m3; `growth`: of a nucleus, relative change of its
// diameter, 1/s; `coagulation`: kernel of two nuclei, m3/s. The step (s) at whose end
//   - the growth of those born, by their share of all, J dt/(N + J dt), and
//   - the share of them that met another, half the kernel times J dt,
// are the tolerance, whichever is shorter; infinity where nothing is born.
[[nodiscard]] inline double newbornStep(double tolerance, double nuclei, double number, double growth,
                                        double coagulation) {
  double step = std::numeric_limits<double>::infinity();
  if (!(nuclei > 0)) return step;
  if (growth > 0) {
    // growth J dt^2 = tolerance (N + J dt)
    const double half = 0.5 * tolerance / growth;
    step = half + std::sqrt(half * half + 2 * half * number / nuclei);
  }
  if (coagulation > 0) step = std::min(step, std::sqrt(2 * tolerance / (coagulation * nuclei)));
  return step;
}

}  // namespace lampblack::particles
