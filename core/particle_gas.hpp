// The gas at a place, as what it carries sees it: plain data that a cell, a point of a flame and a reactor fill for any
// model of particles. Here, as neither flow/ nor particles/ knows the other.
#pragma once

#include <span>

namespace lampblack {

// What moves and heats particles.
struct CarrierGas {
  double temperature = 0;          // K
  double pressure = 0;             // Pa
  double density = 0;              // kg/m3, of the gas only
  double viscosity = 0;            // Pa s
  double meanMolecularWeight = 0;  // kg/mol
};

// With what they exchange.
struct ParticleGas : CarrierGas {
  std::span<const double> concentrations;  // mol/m3, of the species that the model names, in its order
};

// What advancing particles over a time took.
struct ParticleAdvance {
  int steps = 0, rejected = 0;
};

}  // namespace lampblack
