// Chemical equilibrium of an ideal gas: the composition of least Gibbs energy at given elements, over all species of
// the mechanism. The method is described in docs/theory/chemistry.md. An object holds its workspace, so use one per
// thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/equilibrium_path.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/nasa7.hpp"

namespace lampblack {

class Equilibrium {
 public:
  explicit Equilibrium(const Mechanism& mechanism);

  // Replaces the mass fractions Y, which only tell the elements (negative ones count as zero), by those of equilibrium
  // at temperature T (K) and pressure p (Pa). Amounts below e^-700 of the mixture become zero. NumericsError with the
  // state if the equations cannot be solved, or if an input is not a finite number, T or p not positive, Y all zero.
  void atTemperature(double T, double p, std::span<double> Y);

  // The same at the temperature, which is returned, where the equilibrium has the enthalpy h (J/kg, with enthalpies of
  // formation). NumericsError also if that is outside [Thermo::minTemperature, Thermo::maxTemperature].
  double atEnthalpy(double h, double p, std::span<double> Y);

  std::size_t iterations() const { return path_.iterations(); }  // of Newton's method in the last solution

 private:
  void begin(double T, double p, std::span<const double> Y);
  void setActiveSpecies();
  void moveTo(double T);
  void excludeSpecies();
  void writeMassFractions(std::span<double> Y) const;
  double enthalpyMass(double T);
  double heatCapacityMass(double T);
  std::string state(double T, std::span<const double> Y) const;

  const Mechanism& mechanism_;
  Nasa7Table thermo_;
  double lnPressure_ = 0;            // of p over the standard pressure
  double mass_ = 0;                  // kg, of the moles in amounts_
  std::vector<double> amounts_;      // mol, of all species, as given
  std::vector<bool> allowed_;        // species that are not excluded by the elements
  std::vector<std::size_t> active_;  // the species of path_
  std::vector<double> gibbs_, enthalpies_, cp_, g_, h_, start_, derivative_, given_;
  EquilibriumPath path_;
};

}  // namespace lampblack
