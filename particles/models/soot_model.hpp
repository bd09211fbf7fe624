// What all models of soot have in common beside ParticleModel: made of carbon and hydrogen, black, as warm as the gas.
#pragma once

#include <utility>

#include "core/modules.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::particles {

class SootModel : public ParticleModel {
 public:
  [[nodiscard]] std::string material() const override { return "soot"; }
  // The PAH, which stand behind the species of SootSpecies.
  [[nodiscard]] std::vector<std::size_t> precursors() const override;
  // Carbon has the enthalpy of graphite, hydrogen that of H2.
  void enthalpies(double temperature, std::span<double> h, std::span<double> slope) const override;
  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  // Adds `count` (1/m3) spheres of carbon of this volume (m3) each to the densities of the scalars. Number and carbon
  // are kept to round-off; of sections, which share them, the carbon alone beyond the smallest and the largest.
  virtual void addSpheres(double count, double volume, std::span<double> densities) const = 0;
};

// 700 f_v T, 1/m (Wang 2025, section 7.2.4).
[[nodiscard]] double sootAbsorption(double temperature, double volumeFraction);
// Enthalpy of soot carbon (graphite) and hydrogen (as in H2), J/kg, and slopes, J/kg/K (NASA polynomials of Gurvich's
// data; Burcat and Ruscic 2005).
[[nodiscard]] std::pair<double, double> sootCarbonEnthalpy(double temperature);
[[nodiscard]] std::pair<double, double> sootHydrogenEnthalpy(double temperature);

}  // namespace lampblack::particles
