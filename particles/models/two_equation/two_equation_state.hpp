// Inside of TwoEquationSoot: the state of a cell in moles and the coefficients of its rates. Not for other rooms.
#pragma once

#include "core/rooms.hpp"
#include "particles/models/two_equation/two_equation.hpp"

namespace lampblack::particles {

struct TwoEquationSoot::State {
  double number = 0;                // 1/m3
  double carbon = 0, hydrogen = 0;  // of soot, mol/m3
  SootSpeciesArray gas{};           // mol/m3
  [[nodiscard]] std::span<const double> pah(std::size_t count) const { return {&gas[SootSpecies::fixed], count}; }
};

struct TwoEquationSoot::Frozen {
  SurfaceChemistry surface;
  double temperature, freeMolecular, continuum, twiceMeanFreePath;
};

struct TwoEquationSoot::Rates {
  PahArray pahLoss{};                     // 1/s
  double growth = 0;                      // 1/s, of C2H2
  double oxidationO2 = 0;                 // 1/s, of O2
  double oxidationOH = 0;                 // 1/s, of OH
  double coagulation = 0;                 // m3/s, dN/dt = -coagulation N^2
  double particleMass = 0, diameter = 0;  // kg, m; zero without soot
  double number = 0, carbon = 0;          // where the rates were taken
};

// Per m3 over one sub-step; moles unless said otherwise.
struct TwoEquationSoot::Extents {
  PahArray pah{};  // consumed
  double pahCarbon = 0, pahHydrogen = 0;
  double condensedShare = 0;  // of the PAH mass
  double growth = 0, O2 = 0, OH = 0;
  double hydrogenLost = 0;  // atoms of soot oxidised away
  double nucleated = 0;     // particles
  double finalNumber = 0;   // particles, before the nucleus limit
  double dimerNumber = 0;   // 1/m3
  bool limited = false;
};

}  // namespace lampblack::particles
