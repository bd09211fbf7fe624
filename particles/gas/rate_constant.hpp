// Rate constants as the papers on soot print them: cm3, mol, s and kcal.
#pragma once

#include <cmath>

#include "core/constants.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

// A T^n exp(-E/RT).
struct RateConstant {
  double A = 0, n = 0, E = 0;  // cm3/mol/s, or 1/s; -; kcal/mol
};

// In the units of A; from the logarithm of the temperature (K) and 1/(R T), mol/J.
[[nodiscard]] inline double valueAt(const RateConstant& k, double logT, double inverseRT) {
  return k.A * std::exp(k.n * logT - 1e3 * constants::thermochemicalCalorie * k.E * inverseRT);
}

}  // namespace lampblack::particles
