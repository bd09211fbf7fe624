// The dimer two-equation soot model (Wang 2025, section 7.2.2; Blanquart and Pitsch 2009 dimers, Appel, Bockhorn and
// Frenklach 2000 surface chemistry): a population of equal spheres carried as number, carbon mass and hydrogen mass per
// volume of gas. Every event moves whole atoms between gas and soot, so that elements and mass are conserved to
// round-off.
#pragma once

#include <array>
#include <cstddef>

#include "core/rooms.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/soot/dimer.hpp"
#include "particles/soot/surface_chemistry.hpp"

namespace lampblack::particles {

class TwoEquationSoot {
 public:
  struct Population {
    double number = 0;    // 1/m3
    double carbon = 0;    // kg/m3
    double hydrogen = 0;  // kg/m3
    [[nodiscard]] double mass() const { return carbon + hydrogen; }
  };

  // Instantaneous rates of change.
  struct Sources {
    double number = 0;                // 1/m3/s
    double carbon = 0, hydrogen = 0;  // kg/m3/s
    SootSpeciesArray gas{};           // production, mol/m3/s; H2O is not exchanged and stays zero
    // Parts. Soot mass rates, kg/m3/s; oxidation is negative.
    double nucleation = 0, condensation = 0, growth = 0, oxidationO2 = 0, oxidationOH = 0;
    double nucleationNumber = 0, coagulationNumber = 0, oxidationNumber = 0;  // 1/m3/s, the latter two negative
    double dimerNumber = 0;                                                   // 1/m3
  };

  // What one `advance` did, integrated over the step.
  struct Report {
    int subSteps = 0, rejected = 0;
    double nucleated = 0, condensed = 0, grown = 0, oxidised = 0;          // soot mass moved, kg/m3, each positive
    double numberNucleated = 0, numberCoagulated = 0, numberOxidised = 0;  // 1/m3, each positive
    int limitedOxidation = 0;  // sub-steps in which oxidation would have used more O2 or OH than there was
  };

  explicit TwoEquationSoot(SootModelOptions options);  // throws InputError

  // Negative concentrations or populations (transport may leave some) count as zero in every rate.
  [[nodiscard]] Sources sources(const ParticleGas& gas, const Population& population) const;

  // Advances population and gas together over `dt` (s) at the temperature, pressure and viscosity of `gas`;
  // `concentrations`, in the order of SootSpecies, come from the gas and return to it. Adaptive sub-steps of an
  // exponential midpoint rule; nothing becomes negative, whatever dt. Negative input entries are left as they are and
  // count as zero. Throws NumericsError for a temperature, pressure or viscosity that is not positive, or without
  // convergence.
  Report advance(const CarrierGas& gas, double dt, Population& population, std::span<double> concentrations) const;

  // Brownian diffusivity, m2/s (Wang 2025, eqs. 7-30 to 7-33) of the mean sphere, at least a nucleus in size.
  [[nodiscard]] double diffusivity(const CarrierGas& gas, const Population& population) const;

  [[nodiscard]] double volumeFraction(const Population& population) const {
    return population.mass() / options_.sootDensity;
  }
  // Diameter (m) of the mean sphere (Wang 2025, eq. 7-23); zero without soot.
  [[nodiscard]] double meanDiameter(const Population& population) const;
  // Surface area, m2/m3 (Wang 2025, eq. 7-24).
  [[nodiscard]] double surfaceArea(const Population& population) const;

  [[nodiscard]] const SootModelOptions& options() const { return options_; }
  [[nodiscard]] const DimerModel& dimers() const { return dimers_; }

  // Below these a cell has nothing to do: PAH in mol/m3, soot carbon in kg/m3 (volume fraction near 1e-21).
  static constexpr double negligiblePah = 1e-14;
  static constexpr double negligibleCarbon = 1e-18;

 private:
  struct State;    // moles and number per m3
  struct Frozen;   // what depends on temperature only, for one call
  struct Rates;    // coefficients at one state
  struct Extents;  // what happens in one sub-step
  [[nodiscard]] Frozen freeze(const CarrierGas& gas) const;
  [[nodiscard]] Rates rates(const Frozen& frozen, const State& state) const;
  [[nodiscard]] Extents extents(const Frozen& frozen, const Rates& rates, const State& start, double dt) const;
  [[nodiscard]] State apply(const State& start, const Extents& extents) const;
  [[nodiscard]] double error(const State& start, const State& low, const State& high) const;
  [[nodiscard]] Report integrate(const Frozen& frozen, State& state, double dt) const;

  SootModelOptions options_;
  DimerModel dimers_;
  double nucleusCarbon_;    // mol of carbon in the smallest nucleus
  double nucleusDiameter_;  // m
};

}  // namespace lampblack::particles
