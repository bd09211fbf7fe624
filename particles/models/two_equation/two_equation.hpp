// The dimer two-equation soot model (Wang 2025, section 7.2.2; Blanquart and Pitsch 2009 dimers, Appel, Bockhorn and
// Frenklach 2000 surface chemistry): a population of equal spheres carried as number, carbon mass and hydrogen mass per
// volume of gas. Every event moves whole atoms between gas and soot, so that elements and mass are conserved to
// round-off.
#pragma once

#include <array>
#include <cstddef>

#include "core/modules.hpp"
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

  explicit TwoEquationSoot(SootModelOptions options);  // throws InputError

  // Negative concentrations or populations (transport may leave some) count as zero in every rate.
  [[nodiscard]] Sources sources(const ParticleGas& gas, const Population& population) const;

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

 private:
  struct Rates;
  [[nodiscard]] Rates rates(const CarrierGas& gas, const SootSpeciesArray& concentrations,
                            const Population& soot) const;

  SootModelOptions options_;
  DimerModel dimers_;
  double nucleusCarbon_;    // mol of carbon in the smallest nucleus
  double nucleusDiameter_;  // m
};

}  // namespace lampblack::particles
