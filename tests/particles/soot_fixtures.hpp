// Gas states shared by the soot tests: an ethylene flame's soot-forming zone and its burnout zone.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/constants.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/gas/soot_gas.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

struct FlameGas {
  std::vector<double> concentrations;  // mol/m3, in the order of SootSpecies
  ParticleGas state;

  // Concentrations from mole fractions at one atmosphere.
  FlameGas(double temperature, double H, double H2, double OH, double H2O, double O2, double C2H2,
           const std::vector<double>& pahFractions)
      : concentrations{H, H2, OH, H2O, O2, C2H2, 0} {
    concentrations.insert(concentrations.end(), pahFractions.begin(), pahFractions.end());
    state.temperature = temperature;
    state.pressure = constants::oneAtmosphere;
    state.meanMolecularWeight = 0.028;
    const double c = state.pressure / (constants::gasConstant * temperature);
    state.density = c * state.meanMolecularWeight;
    state.viscosity = 1.8e-5 * std::pow(temperature / 300, 0.7);
    for (double& x : concentrations) x *= c;
    state.concentrations = concentrations;
  }
  FlameGas(const FlameGas&) = delete;
  FlameGas& operator=(const FlameGas&) = delete;

  [[nodiscard]] double operator[](SootSpecies::Index k) const { return concentrations[k]; }
  [[nodiscard]] std::span<const double> pah() const {
    return std::span<const double>(concentrations).subspan(SootSpecies::fixed);
  }
};

inline SootModelOptions naphthalene() {
  SootModelOptions options;
  options.pah = {{"A2", 10, 8, 2.0e-3}};
  return options;
}

inline SootModelOptions threePah() {
  SootModelOptions options;
  options.pah = {{"A2", 10, 8, 2.0e-3}, {"A3", 14, 10, 1.5e-2}, {"A4", 16, 10, 2.5e-2}};
  return options;
}

// `count` spheres of one mass (kg), together at `number` (1/m3).
inline std::vector<GivenParticle> equalSpheres(std::size_t count, double mass, double hydrogenFraction, double number) {
  return std::vector<GivenParticle>(
      count, {(1 - hydrogenFraction) * mass, hydrogenFraction * mass, 1, number / static_cast<double>(count)});
}

// Neither growth nor condensation.
inline SootModelOptions jumpsOnly(bool coagulation, bool inception) {
  SootModelOptions soot = threePah();
  soot.coagulation = coagulation;
  soot.inception = inception;
  soot.condensation = soot.surfaceGrowth = soot.oxidation = false;
  return soot;
}

}  // namespace lampblack::test
