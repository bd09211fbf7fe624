// Chemical equilibrium of an ideal gas: the composition of least Gibbs energy (at constant volume, Helmholtz energy) at
// given elements, over all species of the mechanism. Method, sources and measured accuracy: docs/theory/chemistry.md.
// An object holds its workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/equilibrium_path.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class Equilibrium {
 public:
  explicit Equilibrium(const Mechanism& mechanism);

  // All members replace the mass fractions Y, which only tell the elements (negative ones count as zero), by those of
  // the equilibrium at two given quantities. Amounts below e^-700 of the mixture become zero. NumericsError, with the
  // state, if an input is not a finite number or not positive where it has to be, or if there is no solution.
  //
  // Temperature T (K) and pressure p (Pa), or density (kg/m3).
  void atTemperatureAndPressure(double T, double p, std::span<double> Y);
  void atTemperatureAndDensity(double T, double density, std::span<double> Y);
  // Enthalpy h (J/kg, with enthalpies of formation) or entropy s (J/kg/K) and pressure, internal energy u (J/kg) and
  // density. Returned is the temperature, which is searched in [Thermo::minTemperature, Thermo::maxTemperature].
  double atEnthalpyAndPressure(double h, double p, std::span<double> Y);
  double atEntropyAndPressure(double s, double p, std::span<double> Y);
  double atEnergyAndDensity(double u, double density, std::span<double> Y);

  std::size_t iterations() const { return path_.iterations(); }  // of Newton's method in the last solution

 private:
  using Constant = EquilibriumPath::Constant;
  enum class Property { Enthalpy, Entropy, Energy };

  void begin(Constant constant, double pressureOrDensity, std::span<const double> Y);
  void forbidAbsentElements();
  void setActiveSpecies(double size);
  void setMixture(double size);
  void moveTo(double T);
  void growTo(double size);
  double search(Property property, double value, std::span<double> Y);
  double evaluate(Property property, double T);
  double slope(Property property, double T);
  void writeMassFractions(std::span<double> Y) const;
  std::string state(double T) const;

  const Mechanism& mechanism_;
  SpeciesThermo thermo_;
  Constant constant_ = Constant::Pressure;
  double pressureOrDensity_ = 0;
  double mass_ = 0;                  // kg, of the one mol in amounts_
  std::vector<double> given_;        // Y
  std::vector<double> amounts_;      // mol, of all species, as given
  std::vector<bool> allowed_;        // species that the elements do not exclude
  std::vector<std::size_t> active_;  // the species of path_
  std::vector<double> all_;          // per species of the mechanism
  std::vector<double> g_, start_;    // per species of path_, as the following
  std::vector<double> h_;            // H/RT, at constant volume U/RT
  std::vector<double> byTemperature_;
  std::vector<double> atoms_, size_;  // of the active species: per element and species, and all
  std::vector<double> part_;          // of a molecule, that of path_ stands for
  EquilibriumPath path_;
};

}  // namespace lampblack::chemistry
