// Rates of a gas mechanism at one state: mass action with all rate constants of kinetics_tables.hpp, reverse rates from
// the equilibrium constants, and analytic derivatives. Loops run over flat arrays with vectorised exponentials; an
// object holds its workspace, so use one per thread or rank. What depends on temperature alone is kept from call to
// call: changing only the concentrations is cheaper.
//
// All quantities are SI with mol: concentrations mol/m3, rates mol/m3/s, rate constants (m3/mol)^(order-1)/s. Pressure,
// where a rate constant depends on it, is R T sum c, of at least 1e-10 mol/m3.
//
// Errors: InputError at construction for rate constants that make no sense (named with file and line), NumericsError at
// evaluation if the constants a reaction has at one pressure add up to nothing positive at this temperature.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics_enthalpy.hpp"
#include "chemistry/kinetics/kinetics_falloff.hpp"
#include "chemistry/kinetics/kinetics_jacobian_table.hpp"
#include "chemistry/kinetics/kinetics_linear_burke.hpp"
#include "chemistry/kinetics/kinetics_pressure.hpp"
#include "chemistry/kinetics/kinetics_tables.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "core/modules.hpp"
#include "numerics/sparse_pattern.hpp"

namespace lampblack::chemistry {

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

  // The same derivatives for large mechanisms: d wdot_k / d c_j = S_kj + common[k] for every j. S has the entries of
  // jacobianPattern(), a fixed pattern that contains the diagonal; values are in its order, one an entry.
  const SparsePattern& jacobianPattern() const { return jacobianTable_.pattern(); }
  void netProductionRatesAndSparseJacobian(double T, std::span<const double> concentrations, std::span<double> wdot,
                                           std::span<double> values, std::span<double> common,
                                           std::span<double> temperatureDerivative);

  // Rates of progress, mol/m3/s, in the mechanism's order of reactions.
  void ratesOfProgress(double T, std::span<const double> concentrations, std::span<double> forward,
                       std::span<double> reverse);

  // Rate constants in the mechanism's order. Constants of reactions that depend on pressure are effective ones.
  // Constants of three-body reactions exclude [M]. Irreversible reactions have reverse constant 0.
  void rateConstants(double T, std::span<const double> concentrations, std::span<double> forward,
                     std::span<double> reverse);

  // Kc = prod c_eq^nu, (mol/m3)^(sum nu), of every reaction, reversible or not.
  void equilibriumConstants(double T, std::span<double> Kc);

  // Multiplies both rate constants of a reaction (the mechanism's number), 1 unless set. The derivative of the
  // production rates with respect to ln factor is netStoichiometry(reaction) times the net rate of progress.
  void setMultiplier(std::size_t reaction, double factor);
  double multiplier(std::size_t reaction) const { return multiplier_[internal_[reaction]]; }

  // Products minus reactants; species that do not change are left out.
  std::span<const StoichiometricTerm> netStoichiometry(std::size_t reaction) const {
    return tables_.netTerms[internal_[reaction]];
  }

 private:
  struct ThirdSlot {
    std::uint32_t reaction = 0, species = 0;
  };

  void findThirdSlots();
  void sizeWorkspace();

  void update(double T, std::span<const double> concentrations);
  void updateTemperature(double T);
  void updateConcentrations(std::span<const double> concentrations);
  void updateFactors();
  void updateProgress();
  void sumProduction(double* out);  // of progress_

  void slotDerivatives();
  void generalDerivatives();
  void factorDerivatives(double* values, double* common);
  void addSetColumn(std::size_t set, std::size_t reaction, double factorByM);
  void progressTemperatureDerivatives();

  KineticsTables tables_;
  JacobianTable jacobianTable_;
  SpeciesThermo thermo_;
  FalloffFactors falloff_;
  PressureRates pressureRates_;
  EnthalpyFactors enthalpyFactors_;
  LinearBurkeFactors linearBurke_;
  std::vector<std::size_t> internal_;                 // internal number of the mechanism's reaction
  std::array<std::vector<ThirdSlot>, 2> thirdSlots_;  // the few reactions with three reactants, three products

  // State of the last evaluation. c_, gibbs_ and enthalpy_ have a last entry for the empty slot.
  double temperature_ = -1;
  double totalConcentration_ = 0, lnPressure_ = 0;
  std::vector<double> lnkf_, kf_, lnkr_, kr_, gibbs_, enthalpy_, heatCapacity_;
  std::vector<double> multiplier_;
  std::vector<double> c_, M_, factor_, forward_, reverse_, progress_;  // forward_, reverse_ are without factor_
  std::vector<double> sources_;                                        // of jacobianTable_
  std::vector<double> factorByT_, setColumns_;
  std::vector<double> sparseValues_, common_;
};

}  // namespace lampblack::chemistry
