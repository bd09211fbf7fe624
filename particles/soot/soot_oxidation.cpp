#include "particles/soot/soot_oxidation.hpp"

#include <cmath>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

constexpr double gramOfCarbon = 12.011;  // g/mol

double pressureInAtm(double temperature, double concentration) {
  return concentration * constants::gasConstant * temperature / constants::oneAtmosphere;
}

// exp(-E/RT) with E in cal/mol and the R in use when these rates were published.
double boltzmannFactor(double calories, double temperature) {
  return std::exp(-calories / (1.987 * temperature));
}

}  // namespace

double oxidationByLee(double temperature, double O2) {
  const double gram = 1.085e4 * pressureInAtm(temperature, O2) / std::sqrt(temperature) *
                      boltzmannFactor(39300, temperature);  // g/cm2/s
  return 1e4 * gram / gramOfCarbon;
}

double oxidationByNagle(double temperature, double O2) {
  const double p = pressureInAtm(temperature, O2);
  const double kA = 20 * boltzmannFactor(30000, temperature), kB = 4.46e-3 * boltzmannFactor(15200, temperature),
               kT = 1.51e5 * boltzmannFactor(97000, temperature), kZ = 21.3 * boltzmannFactor(-4100, temperature);
  if (!(p > 0)) return 0;
  const double reactive = kB * p / (kB * p + kT);  // share of sites A
  return 1e4 * (kA * p / (1 + kZ * p) * reactive + kB * p * (1 - reactive));
}

double hydroxylFlux(double temperature, double OH) {
  constexpr double hydroxylWeight = 17.007e-3;  // kg/mol
  return OH * std::sqrt(constants::gasConstant * temperature / (2 * constants::pi * hydroxylWeight));
}

double netOxidation(double oxidised, double gained) {
  if (!(oxidised > 0)) return 0;
  constexpr double width = 0.05;
  const auto positive = [](double x) { return x + std::sqrt(x * x + width * width); };
  const double net = 1 - gained / oxidised;
  // Without cancellation far below zero.
  return (net > 0 ? positive(net) : width * width / positive(-net)) / positive(1);
}

}  // namespace lampblack::particles
