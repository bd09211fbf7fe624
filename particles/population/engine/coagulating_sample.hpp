// The population balance of numerical particles that coagulate alone, of options with `coagulation`, `kernel`,
// `particles` and `fullAt`: other processes act on the particles beside it.
#pragma once

#include "core/constants.hpp"
#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

template <class Options>
[[nodiscard]] PopulationModel modelOfSample(const Options& options) {
  PopulationModel model;
  if (options.coagulation) {
    model.coagulation = options.kernel;  // of some gas, until there is the right one
    model.coagulation->gas = {1500, constants::oneAtmosphere, 0.2, 5e-5, 0.028};
  }
  return model;
}

template <class Options>
[[nodiscard]] MonteCarloOptions monteCarloOfSample(const Options& options) {
  MonteCarloOptions monteCarlo;
  monteCarlo.method = MonteCarloMethod::dsmc;
  monteCarlo.particles = options.particles;
  monteCarlo.expectedNumber = options.fullAt;
  return monteCarlo;
}

}  // namespace lampblack::particles
