// Reduced collision integrals of the Stockmayer (12-6-3) potential.
#pragma once

namespace lampblack {

// Where the integrals come from.
enum class CollisionIntegrals {
  // Lennard-Jones integrals of Neufeld, Janzen, Aziz, J. Chem. Phys. 57 (1972) 1100-1102 (within 0.4 % of the
  // tables), plus
  // 0.19 delta*^2 / T* for dipoles (Brokaw, Ind. Eng. Chem. Process Des. Dev. 8 (1969) 240-253).
  NeufeldBrokaw,
  // The fits of the thesis (eqs 6-36, 6-37, Table 6.1), within 2.5 % of the tables.
  ThesisFits,
};

// Omega(1,1)* and Omega(2,2)* at reduced temperature T* = k_B T/eps and reduced dipole moment
// delta* = mu_j mu_k / (2 (4 pi eps0) eps sigma^3).
double collisionIntegral11(double reducedTemperature, double reducedDipole,
                           CollisionIntegrals source = CollisionIntegrals::NeufeldBrokaw);
double collisionIntegral22(double reducedTemperature, double reducedDipole,
                           CollisionIntegrals source = CollisionIntegrals::NeufeldBrokaw);

}  // namespace lampblack
