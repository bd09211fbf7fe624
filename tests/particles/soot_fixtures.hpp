// Gas states shared by the soot tests: an ethylene flame's soot-forming zone and its burnout zone.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack::test {

struct FlameGas {
  std::vector<double> pah;
  SootGasState state;

  // Concentrations from mole fractions at one atmosphere.
  FlameGas(double temperature, double H, double H2, double OH, double H2O, double O2, double C2H2,
           std::vector<double> pahFractions)
      : pah(std::move(pahFractions)) {
    state.temperature = temperature;
    state.pressure = constants::oneAtmosphere;
    state.meanMolecularWeight = 0.028;
    const double c = state.pressure / (constants::gasConstant * temperature);
    state.density = c * state.meanMolecularWeight;
    state.viscosity = 1.8e-5 * std::pow(temperature / 300, 0.7);
    state.H = H * c;
    state.H2 = H2 * c;
    state.OH = OH * c;
    state.H2O = H2O * c;
    state.O2 = O2 * c;
    state.C2H2 = C2H2 * c;
    for (double& x : pah) x *= c;
    state.pah = pah;
  }
  FlameGas(const FlameGas&) = delete;
  FlameGas& operator=(const FlameGas&) = delete;
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

}  // namespace lampblack::test
