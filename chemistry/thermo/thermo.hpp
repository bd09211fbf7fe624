// Thermodynamics of an ideal-gas mixture from NASA polynomials (Wang 2025, eqs 6-13..6-17). Holds flat copies of the
// species data; no call allocates. An object has a small workspace, so use one per thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class Thermo {
 public:
  // Enthalpies and internal energies are inverted to temperatures in this range only.
  static constexpr double minTemperature = 100.0;   // K
  static constexpr double maxTemperature = 6000.0;  // K

  explicit Thermo(const Mechanism& mechanism);

  std::size_t numSpecies() const { return weights_.size(); }
  std::span<const double> molecularWeights() const { return weights_; }  // kg/mol

  double meanMolecularWeight(std::span<const double> Y) const;           // kg/mol
  double density(double T, double p, std::span<const double> Y) const;   // kg/m3
  double cpMass(double T, std::span<const double> Y) const;              // J/kg/K
  double cvMass(double T, std::span<const double> Y) const;              // J/kg/K
  double enthalpyMass(double T, std::span<const double> Y) const;        // J/kg, with enthalpies of formation
  double internalEnergyMass(double T, std::span<const double> Y) const;  // J/kg, the same
  // J/kg/K, with the entropy of mixing; a species of zero (or less) has none.
  double entropyMass(double T, double p, std::span<const double> Y) const;
  void speciesEnthalpies(double T, std::span<double> h) const;        // J/kg
  void speciesInternalEnergies(double T, std::span<double> u) const;  // J/kg
  void speciesEntropies(double T, std::span<double> s) const;         // J/kg/K, at 1 atm
  void speciesGibbs(double T, std::span<double> g) const;             // J/kg, at 1 atm
  void speciesCp(double T, std::span<double> cp) const;               // J/kg/K
  void speciesCpSlope(double T, std::span<double> slope) const;       // d cp_k/dT, J/kg/K2

  // The temperature at which the mixture has enthalpy h (J/kg), by Newton's method inside a shrinking bracket, to
  // round-off. NumericsError if it lies outside [minTemperature, maxTemperature] or an input is not finite.
  double temperatureFromEnthalpy(double h, std::span<const double> Y, double guess) const;
  // The same for an internal energy u (J/kg).
  double temperatureFromInternalEnergy(double u, std::span<const double> Y, double guess) const;

  void massToMole(std::span<const double> Y, std::span<double> X) const;
  void moleToMass(std::span<const double> X, std::span<double> Y) const;

 private:
  template <class Value, class Slope>
  double invert(const Value& value, const Slope& slope, double target, double guess, const char* what) const;

  SpeciesThermo table_;
  std::vector<double> weights_;         // kg/mol
  std::vector<double> inverseWeights_;  // mol/kg
  std::vector<double> gasConstants_;    // R/W_k, J/kg/K
  mutable std::vector<double> work_;
};

}  // namespace lampblack::chemistry
