#include "particles/soot/surface_chemistry.hpp"

#include <algorithm>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

// In m3/mol/s.
double arrhenius(const RateConstant& k, double logT, double inverseRT) {
  return 1e-6 * valueAt(k, logT, inverseRT);
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
      bounded_(options.surface.bounded),
      growthOn_(options.surfaceGrowth ? 1 : 0),
      oxidationOn_(options.oxidation ? 1 : 0),
      alpha_(fixedAlpha(options, temperature)) {
  const double logT = std::log(temperature), inverseRT = 1 / (constants::gasConstant * temperature);
  const SurfaceRateConstants& k = options.surface;
  k1_ = arrhenius(k.openByH, logT, inverseRT);
  k1r_ = arrhenius(k.closeByH2, logT, inverseRT);
  k2_ = arrhenius(k.openByOH, logT, inverseRT);
  k2r_ = arrhenius(k.closeByH2O, logT, inverseRT);
  k3_ = arrhenius(k.closeByH, logT, inverseRT);
  k4_ = arrhenius(k.growth, logT, inverseRT);
  k5_ = arrhenius(k.oxidation, logT, inverseRT);
  k5closing_ = k.closeByO2 ? arrhenius(*k.closeByO2, logT, inverseRT) : k5_;
  constexpr double hydroxylWeight = 17.007e-3;  // kg/mol
  ohFlux_ =
      options.ohEfficiency * std::sqrt(constants::gasConstant * temperature / (2 * constants::pi * hydroxylWeight));
}

double SurfaceChemistry::alpha(double meanCarbonAtoms) const {
  return alpha_ ? *alpha_ : boundedTanh(a_, b_, meanCarbonAtoms);
}

}  // namespace lampblack::particles
