#include "particles/soot/surface_chemistry.hpp"

#include <algorithm>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

// A T^n exp(-E/RT) with A in cm3/mol/s and E in kcal/mol, returned in m3/mol/s.
double arrhenius(double A, double n, double kcal, double logT, double inverseRT) {
  return 1e-6 * A * std::exp(n * logT - 1e3 * constants::thermochemicalCalorie * kcal * inverseRT);
}

// Wang (2025), eqs. 7-47 to 7-49.
double siteSlope(double temperature) {
  return 12.65 - 0.00563 * temperature;
}

double siteShift(double temperature) {
  return -1.38 + 0.00068 * temperature;
}

double boundedTanh(double a, double b, double meanCarbonAtoms) {
  return std::clamp(std::tanh(a / std::log10(meanCarbonAtoms) + b), 0.0, 1.0);
}

// The constant of the options, or what their table says at this temperature.
std::optional<double> fixedAlpha(const SootModelOptions& options, double temperature) {
  const std::vector<AlphaPoint>& table = options.alphaTable;
  if (options.alpha || table.empty()) return options.alpha;
  const auto above = std::upper_bound(table.begin(), table.end(), temperature,
                                      [](double T, const AlphaPoint& point) { return T < point.temperature; });
  if (above == table.begin()) return table.front().alpha;
  if (above == table.end()) return table.back().alpha;
  const AlphaPoint& below = *(above - 1);
  const double share = (temperature - below.temperature) / (above->temperature - below.temperature);
  return below.alpha + share * (above->alpha - below.alpha);
}

}  // namespace

double activeSiteFraction(double temperature, double meanCarbonAtoms) {
  return boundedTanh(siteSlope(temperature), siteShift(temperature), meanCarbonAtoms);
}

SurfaceChemistry::SurfaceChemistry(const SootModelOptions& options, double temperature)
    : sites_(options.siteDensity / constants::avogadro),
      a_(siteSlope(temperature)),
      b_(siteShift(temperature)),
      growthOn_(options.surfaceGrowth ? 1 : 0),
      oxidationOn_(options.oxidation ? 1 : 0),
      alpha_(fixedAlpha(options, temperature)) {
  const double logT = std::log(temperature), inverseRT = 1 / (constants::gasConstant * temperature);
  k1_ = arrhenius(4.2e13, 0, 13.0, logT, inverseRT);
  k1r_ = arrhenius(3.9e12, 0, 11.0, logT, inverseRT);
  k2_ = arrhenius(1.0e10, 0.734, 1.43, logT, inverseRT);
  k2r_ = arrhenius(3.68e8, 1.139, 17.1, logT, inverseRT);
  k3_ = 2.0e13 * 1e-6;
  k4_ = arrhenius(8.0e7, 1.56, 3.8, logT, inverseRT);
  k5_ = arrhenius(2.2e12, 0, 7.5, logT, inverseRT);
  constexpr double hydroxylWeight = 17.007e-3;  // kg/mol
  ohFlux_ =
      options.ohEfficiency * std::sqrt(constants::gasConstant * temperature / (2 * constants::pi * hydroxylWeight));
}

double SurfaceChemistry::alpha(double meanCarbonAtoms) const {
  return alpha_ ? *alpha_ : boundedTanh(a_, b_, meanCarbonAtoms);
}

}  // namespace lampblack::particles
