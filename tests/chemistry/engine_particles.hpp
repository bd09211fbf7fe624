// Particles for the tests of an engine's gas.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/engine/engine_gas.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Of equal masses at one atmosphere, in the hydrogen mechanism: temperature, mole fractions.
inline EngineGas engineGas(const std::vector<std::pair<double, std::string>>& particles, double mass = 1e-3) {
  const Mechanism& mechanism = hydrogen();
  const Thermo thermo(mechanism);
  EngineGas gas;
  gas.species = mechanism.numSpecies();
  gas.pressure = constants::oneAtmosphere;
  std::vector<double> Y(gas.species);
  for (const auto& [T, composition] : particles) {
    thermo.moleToMass(parseComposition(mechanism, composition), Y);
    gas.add(mass / static_cast<double>(particles.size()), T, Y);
  }
  return gas;
}

}  // namespace lampblack::test
