// Rates of a gas mechanism: mass action with Arrhenius, three-body and fall-off (Lindemann, Troe) rate constants,
// reverse rates from the equilibrium constants. Loops run over flat arrays with one vectorised exponential for each
// distinct rate constant; an object holds its workspace, so use one per thread or rank.
//
// All quantities are SI with mol: concentrations mol/m3, rates mol/m3/s, rate constants (m3/mol)^(order-1)/s.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "chemistry/mechanism.hpp"
#include "chemistry/nasa7.hpp"

namespace lampblack {

class Kinetics {
 public:
  explicit Kinetics(const Mechanism& mechanism);

  std::size_t numSpecies() const { return numSpecies_; }
  std::size_t numReactions() const { return numReactions_; }

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
  // A reaction with more than three reactants, or products if reversible, decimal coefficients or orders: handled by
  // explicit powers. Decimal powers of negative concentrations count as zero.
  struct GeneralReaction {
    std::size_t reaction = 0;  // internal number
    std::vector<StoichiometricTerm> forwardOrders, reverseOrders;
  };
  // A set of collision efficiencies: [M] = base * sum c + sum_i excess_i c_i
  struct ThirdBodySet {
    double base = 1;
    std::vector<StoichiometricTerm> excess;
    std::vector<double> efficiencies;  // of every species
  };
  struct ThirdBodyUse {
    std::size_t reaction = 0, set = 0;
  };
  // factor = Pr/(1+Pr) F(Pr, T) multiplies the high-pressure rate constant; one entry a fall-off reaction. The centre
  // of the broadening is Fcent = w3 exp(-T/T3) + w1 exp(-T/T1) + w2 exp(-T2/T); Lindemann has w1 = 1, 1/T1 = 0: Fcent
  // = 1.
  struct FalloffArrays {
    std::vector<std::size_t> reaction, set;
    std::vector<double> lnA, b, Ta;  // low-pressure limit
    std::vector<double> w3, w1, w2, inverseT3, inverseT1, T2;
  };
  // jacobian[species + ld*column] += nu * derivative[source]
  struct JacobianTerm {
    std::uint32_t species = 0, column = 0, source = 0;
    double nu = 0;
  };
  struct FalloffDerivatives {
    double value = 0, byM = 0, byT = 0;
  };

  static double power(double concentration, double exponent);
  void orderReactions(const Mechanism& mechanism);
  void setRates(const Mechanism& mechanism);
  void setSlots(const Mechanism& mechanism);
  void setThirdBodies(const Mechanism& mechanism);
  void setProductionTable(const Mechanism& mechanism);
  void setJacobianTerms();
  void sizeWorkspace();
  std::size_t thirdBodySet(const ThirdBody& body);

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

  std::size_t numSpecies_ = 0;
  std::size_t numReactions_ = 0;
  std::size_t numReversible_ = 0;      // internal order: reversible reactions first
  std::vector<std::size_t> original_;  // mechanism's number of internal reaction r
  Nasa7Table table_;

  // Per internal reaction.
  std::vector<double> lnA_, b_, Ta_, sign_, nuSum_;
  bool anyNegative_ = false;
  std::array<std::vector<std::int32_t>, 3> reactant_, product_;  // slot numSpecies_: a constant concentration of one
  std::vector<GeneralReaction> general_;
  std::vector<ThirdBodySet> sets_;
  std::vector<ThirdBodyUse> threeBody_;
  FalloffArrays falloff_;

  // wdot_k = sum over rows_[k]..rows_[k+1] of nu * q; rows are padded to multiples of four with q = 0.
  std::vector<std::size_t> rows_;
  std::vector<std::int32_t> rowReaction_;
  std::vector<double> rowNu_;
  // Net stoichiometry by reaction, for the Jacobian.
  std::vector<std::vector<StoichiometricTerm>> netTerms_;
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
