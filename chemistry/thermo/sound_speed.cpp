#include "chemistry/thermo/sound_speed.hpp"

#include <cmath>

#include "core/constants.hpp"

namespace lampblack::chemistry {

double soundSpeed(const Thermo& thermo, double T, std::span<const double> Y) {
  return std::sqrt(thermo.cpMass(T, Y) / thermo.cvMass(T, Y) * constants::gasConstant * T /
                   thermo.meanMolecularWeight(Y));
}

}  // namespace lampblack::chemistry
