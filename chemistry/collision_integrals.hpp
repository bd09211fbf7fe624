// Reduced collision integrals of the Stockmayer (12-6-3) potential.
#pragma once

namespace lampblack {

// Omega(1,1)* and Omega(2,2)* at reduced temperature T* = k_B T/eps and reduced dipole moment
// delta* = mu_j mu_k / (2 (4 pi eps0) eps sigma^3): fits of the thesis (eqs 6-36, 6-37, Table 6.1).
double collisionIntegral11(double reducedTemperature, double reducedDipole);
double collisionIntegral22(double reducedTemperature, double reducedDipole);

}  // namespace lampblack
