// States to time reactors on: a flame of methane, and ignitions of methane with any mechanism.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace lampblack::bench {

struct GasState {
  double T = 0;           // K
  double p = 0;           // Pa
  std::vector<double> Y;  // mass fractions
};

inline Mechanism shippedMechanism(const std::string& name) {
  return Mechanism::fromFile(test::sourcePath("cases/mechanisms/" + name + ".yaml"));
}

// Every tenth of a thousand states along a premixed flame of methane and air, GRI-Mech 3.0, 1 atm.
inline std::vector<GasState> methaneFlameStates(const Mechanism& mechanism) {
  const test::Table table("reactor_states_ch4_flame.csv");
  std::vector<GasState> states;
  for (std::size_t row = 0; row < table.size(); ++row) {
    GasState state{table.number(row, "T"), table.number(row, "p"), {}};
    double sum = 0;
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
      state.Y.push_back(std::max(0.0, table.number(row, "Y_" + mechanism.speciesName(k))));
      sum += state.Y.back();
    }
    for (double& value : state.Y) value /= sum;
    states.push_back(state);
  }
  return states;
}

// Hot, partly reacted mixtures of methane and air at 1 atm, which every mechanism knows: igniting at constant pressure
// from 1600 K, stoichiometric and at twice that, as they are at 20 temperatures each on the way to equilibrium.
inline std::vector<GasState> methaneIgnitionStates(const Mechanism& mechanism) {
  ConstantPressureReactor reactor(mechanism, {1e-8, 1e-15, 100000, 0.0});
  std::vector<GasState> states;
  for (const char* mixture : {"CH4: 1, O2: 2, N2: 7.52", "CH4: 1, O2: 1, N2: 3.76"}) {
    GasState gas{1600.0, constants::oneAtmosphere, std::vector<double>(mechanism.numSpecies())};
    Thermo(mechanism).moleToMass(parseComposition(mechanism, mixture), gas.Y);
    std::vector<GasState> path{gas};
    const double dt = 1e-6;
    for (int i = 0; i < 2000; ++i) {
      ConstantPressureReactor::Cell cell{gas.T, gas.p, gas.Y, {}, 0.0};
      reactor.advance(cell, dt);
      gas.T = cell.temperature;
      path.push_back(gas);
    }
    const auto [coldest, hottest] =
        std::minmax_element(path.begin(), path.end(), [](const auto& a, const auto& b) { return a.T < b.T; });
    for (int i = 0; i < 20; ++i) {
      const double T = coldest->T + (i + 0.5) / 20 * (hottest->T - coldest->T);
      states.push_back(*std::find_if(path.begin(), path.end(), [&](const auto& s) { return s.T >= T; }));
    }
  }
  return states;
}

}  // namespace lampblack::bench
