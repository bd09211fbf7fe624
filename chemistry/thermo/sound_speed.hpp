// The speed of sound of a gas whose composition stays as it is.
#pragma once

#include <span>

#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// m/s, at T (K) and mass fractions Y: sqrt(cp/cv R T/W).
double soundSpeed(const Thermo& thermo, double T, std::span<const double> Y);

}  // namespace lampblack::chemistry
