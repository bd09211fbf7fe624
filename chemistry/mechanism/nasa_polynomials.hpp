// The NASA polynomials of one range of temperature: seven coefficients (Gordon and McBride 1971, NASA SP-273) or nine
// (McBride, Zehe, Gordon 2002, NASA/TP-2002-211556), as the files of mechanisms have them. Dimensionless; T in K.
#pragma once

#include <array>

#include "core/modules.hpp"

namespace lampblack::chemistry {

double cpOverR(const std::array<double, 7>& a, double T);
double enthalpyOverRT(const std::array<double, 7>& a, double T);
double entropyOverR(const std::array<double, 7>& a, double T, double lnT);
double cpOverR(const std::array<double, 9>& a, double T);
double enthalpyOverRT(const std::array<double, 9>& a, double T, double lnT);
double entropyOverR(const std::array<double, 9>& a, double T, double lnT);

}  // namespace lampblack::chemistry
