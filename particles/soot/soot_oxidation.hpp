// Published rates at which a soot surface burns, as carbon lost per area: for models whose surface has no sites; and
// what of oxidation takes whole particles, for all models that do not know the sizes.
#pragma once

#include "core/modules.hpp"

namespace lampblack::particles {

// Carbon lost to oxygen, mol/m2/s, at a temperature (K) and a concentration of O2 (mol/m3).
// Lee, Thring, Beer 1962: 1.085e4 p T^(-1/2) exp(-39300 / RT) g/cm2/s with p in atm and R in cal/mol/K.
[[nodiscard]] double oxidationByLee(double temperature, double O2);
// Nagle and Strickland-Constable 1962, in which sites of two kinds compete.
[[nodiscard]] double oxidationByNagle(double temperature, double O2);

// Collisions of OH with a surface, mol/m2/s. Fenimore and Jones 1967: a fraction of them takes a carbon atom each.
[[nodiscard]] double hydroxylFlux(double temperature, double OH);

// The part of oxidation that particles lose size by, given that they also gain by growth and condensation (kg/m3/s
// both): 1 - gained/oxidised, zero where they gain more. Only this part can make a particle vanish. The corner at
// equality is rounded over some 0.05 of the ratio.
[[nodiscard]] double netOxidation(double oxidised, double gained);

}  // namespace lampblack::particles
