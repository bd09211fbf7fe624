// Rates of a gas mechanism: mass action with Arrhenius, three-body and fall-off (Lindemann, Troe) rate constants,
// reverse rates from the equilibrium constants. Loops run over flat arrays with one vectorised exponential for each
// distinct rate constant; an object holds its workspace, so use one per thread or rank.
//
// All quantities are SI with mol: concentrations mol/m3, rates mol/m3/s, rate constants (m3/mol)^(order-1)/s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "chemistry/kinetics_tables.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/nasa7.hpp"

namespace lampblack {

class Kinetics {
 public:
  explicit Kinetics(const Mechanism& mechanism);

  std::size_t numSpecies() const { return tables_.numSpecies; }
  std::size_t numReactions() const { return tables_.numReactions; }

  // Net molar production rate of every species at temperature T (K). Concentrations should not be negative.
  void netProductionRates(double T, std::span<const double> concentrations, std::span<double> wdot);

  // As above, and the derivatives of the rates: jacobian[k + leadingDimension * j] = d wdot_k / d c_j at constant T and
  // other concentrations, temperatureDerivative[k] = d wdot_k / dT at constant concentrations. leadingDimension 0 means
  // numSpecies(); rows beyond numSpecies() are not touched.
  void netProductionRatesAndJacobian(double T, std::span<const double> concentrations, std::span<double> wdot,
                                     std::span<double> jacobian, std::span<double> temperatureDerivative,
                                     std::size_t leadingDimension = 0);

  // Rates of progress, mol/m3/s, in the mechanism's order of reactions.
  void ratesOfProgress(double T, std::span<const double> concentrations, std::span<double> forward,
                       std::span<double> reverse);

  // Rate constants in the mechanism's order. Those of fall-off reactions are effective (they depend on [M]); those of
  // three-body reactions exclude [M]. Irreversible reactions have reverse constant 0.
  void rateConstants(double T, std::span<const double> concentrations, std::span<double> forward,
                     std::span<double> reverse);

  // Kc = prod c_eq^nu, (mol/m3)^(sum nu), of every reaction, reversible or not.
  void equilibriumConstants(double T, std::span<double> Kc);

 private:
  // jacobian[species + ld*column] += nu * derivative[source]
  struct JacobianTerm {
    std::uint32_t species = 0, column = 0, source = 0;
    double nu = 0;
  };
  struct FalloffDerivatives {
    double value = 0, byM = 0, byT = 0;
  };

  static double power(double concentration, double exponent);
  void setJacobianTerms();
  void sizeWorkspace();

  void updateTemperature(double T);
  void updateFalloffLimits(double T, double lnT);
  void updateConcentrations(std::span<const double> concentrations);
  void updateFactors();
  void updateProgress();
  void sumProduction(const double* progress, double* out) const;
  void slotDerivatives();
  void generalDerivatives();
  void thirdBodyDerivatives(double T, double* jacobian, std::size_t ld);
  void progressTemperatureDerivatives(double T);
  FalloffDerivatives falloffDerivatives(std::size_t i, double T) const;

  KineticsTables tables_;
  Nasa7Table thermo_;
  std::vector<JacobianTerm> jacobianTerms_;

  // State of the last evaluation. c_, gibbs_ and enthalpy_ have a last entry for the empty slot.
  double temperature_ = -1;
  std::vector<double> lnkf_, kf_, lnkr_, kr_, gibbs_, enthalpy_;
  std::vector<double> lowOverHigh_, lnFcent_, troeTerms_, falloffWork_;
  std::vector<double> c_, M_, factor_, forward_, reverse_, progress_;  // forward_, reverse_ are without factor_
  std::vector<double> derivatives_;  // d progress / d slot, six blocks of numReactions_, then the general reactions'
  std::vector<double> factorByT_, setColumn_;
};

}  // namespace lampblack
