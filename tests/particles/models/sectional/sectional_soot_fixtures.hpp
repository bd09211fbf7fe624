// What the tests of the sections share: gases, random states, sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/constants.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Mole fractions H, H2, OH, H2O, O2, C2H2, CO, then PAH, at one atmosphere.
struct SectionGas {
  std::vector<double> concentrations;
  ParticleGas gas;

  SectionGas(double temperature, std::vector<double> fractions) : concentrations(std::move(fractions)) {
    gas.temperature = temperature;
    gas.pressure = constants::oneAtmosphere;
    gas.meanMolecularWeight = 0.028;
    gas.viscosity = 1.8e-5 * std::pow(temperature / 300, 0.7);
    const double c = gas.pressure / (constants::gasConstant * temperature);
    gas.density = c * gas.meanMolecularWeight;
    for (double& x : concentrations) x *= c;
    gas.concentrations = concentrations;
  }
  SectionGas(const SectionGas&) = delete;
  SectionGas& operator=(const SectionGas&) = delete;
};

inline std::vector<double> sooting(std::vector<double> pah) {
  std::vector<double> x = {1e-3, 0.08, 2e-4, 0.08, 1e-3, 0.04, 0.1};
  x.insert(x.end(), pah.begin(), pah.end());
  return x;
}

inline SectionalSootOptions pyrene() {
  SectionalSootOptions options;
  options.soot.sootDensity = 1800;
  options.soot.pah = {{"A4", 16, 10, 2.5e-2}};
  return options;
}

inline SectionalSootOptions twoPahWithEverything() {
  SectionalSootOptions options = pyrene();
  options.soot.pah = {{"A3", 14, 10, 1.5e-2}, {"A4", 16, 10, 2.5e-2}};
  options.fragmentation.active = options.carbonisation = true;
  return options;
}

// A population that decreases with size, with noise; aggregates of 20 nm primaries at most.
inline std::vector<double> randomState(const SectionalSoot& model, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.2, 1.0);
  const std::size_t n = model.sections();
  const bool spheres = model.options().aggregation == SectionalSootOptions::Aggregation::spheres;
  std::vector<double> y(model.scalars().size());
  for (std::size_t i = 0; i < n; ++i) {
    const double m = model.pivots()[i];
    y[i] = uniform(random) * std::min(1e17, 1e-5 / m);
    // Away from where n_p turns to its limits, whose second derivative jumps.
    if (!spheres) y[n + i] = y[i] * std::max(1.3, 1 + uniform(random) * (m / 7.7e-21 - 1));
  }
  if (model.options().carbonisation) y.back() = 3e-6 * uniform(random);
  return y;
}

struct SectionRates {
  std::vector<double> scalars, exchange;
};

inline SectionRates sourcesOf(const SootModel& model, const ParticleGas& gas, const std::vector<double>& y) {
  SectionRates f{std::vector<double>(model.scalars().size()), std::vector<double>(model.gasSpecies().size())};
  model.sources(gas, y, f.scalars, f.exchange);
  return f;
}

inline double sum(std::span<const double> values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

// sum of N_i m_i.
inline double carbonOf(const SectionalSoot& model, std::span<const double> values) {
  double total = 0;
  for (std::size_t i = 0; i < model.sections(); ++i) total += model.pivots()[i] * values[i];
  return total;
}

}  // namespace lampblack::test
