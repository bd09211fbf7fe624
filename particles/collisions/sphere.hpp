// Spheres of a volume (m3): what particles are measured by.
#pragma once

#include <cmath>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

[[nodiscard]] inline double sphereDiameter(double volume) {  // m
  return cubeRoot(6 * volume / constants::pi);
}

[[nodiscard]] inline double sphereSurface(double volume) {  // m2
  const double d = sphereDiameter(volume);
  return constants::pi * d * d;
}

}  // namespace lampblack::particles
