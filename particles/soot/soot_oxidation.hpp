// Published rates at which a soot surface burns, as carbon lost per area: for models whose surface has no sites.
#pragma once

namespace lampblack {

// Carbon lost to oxygen, mol/m2/s, at a temperature (K) and a concentration of O2 (mol/m3).
// Lee, Thring, Beer 1962: 1.085e4 p T^(-1/2) exp(-39300 / RT) g/cm2/s with p in atm and R in cal/mol/K.
[[nodiscard]] double oxidationByLee(double temperature, double O2);
// Nagle and Strickland-Constable 1962, in which sites of two kinds compete.
[[nodiscard]] double oxidationByNagle(double temperature, double O2);

// Collisions of OH with a surface, mol/m2/s. Fenimore and Jones 1967: a fraction of them takes a carbon atom each.
[[nodiscard]] double hydroxylFlux(double temperature, double OH);

}  // namespace lampblack
