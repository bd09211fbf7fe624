// Decks of small flows whose steady state is sought.
#pragma once

#include <string>
#include <vector>

#include "tests/app/flow_runs.hpp"

namespace lampblack::app::steadymode {

inline const std::string steady = "time.mode=steady";

// Warm gas into a channel with a cold wall.
inline Deck channel(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
mesh: {geometry: planar, x: [{to: 4 mm, cells: 5}], y: [{to: 8 mm, cells: 8}]}
boundaries:
  in: {type: inlet, side: y-min, velocity: 30 cm/s, temperature: 400 K, composition: "GAS: 1"}
  out: {type: outlet, side: y-max, temperature: 300 K, composition: "GAS: 1"}
  cold: {type: wall, side: x-min, temperature: 300 K}
  adiabatic: {type: wall, side: x-max}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K}
)",
                        overrides);
}

// A hot spot in nitrogen, far from where hydrogen and air come in and meet: it lights nothing.
inline Deck hydrogenBesideAir(const std::vector<std::string>& overrides) {
  return test::flowDeck("hydrogen_h2o2_10.yaml", R"deck(
mesh: {geometry: planar, x: [{to: 8 mm, cells: 8}], y: [{to: 12 mm, cells: 8}]}
boundaries:
  fuel: {type: inlet, side: y-min, to: 4 mm, velocity: 30 cm/s, temperature: 298 K, composition: "H2: 0.3, N2: 0.7"}
  air: {type: inlet, side: y-min, from: 4 mm, velocity: 30 cm/s, temperature: 298 K, composition: "O2: 0.21, N2: 0.79"}
  out: {type: outlet, side: y-max, temperature: 298 K, composition: "N2: 1"}
  axis: {type: symmetry, side: x-min}
  shroud: {type: wall, side: x-max, slip: true}
initial: {layer: none, composition: "N2: 1", temperature: 298 K, formula: {temperature: "298 + 900*exp(-((y-0.011)/0.001)^2)"}}
time: {mode: steady, steady: {steps: 40, residual: 1e-4}}
)deck",
                        overrides);
}

}  // namespace lampblack::app::steadymode
