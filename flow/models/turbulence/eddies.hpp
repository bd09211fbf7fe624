// What models that go by turbulence know of it in a cell.
#pragma once

#include "core/modules.hpp"

namespace lampblack::flow {

struct Eddies {
  double energy = 0.0;         // m^2/s^2, k
  double dissipation = 0.0;    // m^2/s^3, epsilon
  double viscosity = 0.0;      // m^2/s, kinematic, molecular
  double eddyViscosity = 0.0;  // m^2/s
};

}  // namespace lampblack::flow
