// A mechanism's reactions as flat tables: rate constants, stoichiometry, third bodies, dependence on pressure. Built
// once, immutable afterwards; the evaluators of rates (one state or many at a time) loop over them.
//
// Every reaction has a base rate constant of Arrhenius form; its rate of progress is factor (kf prod c - kr prod c)
// with kr = kf/Kc of the base constant and a factor of 1, [M], or what `falloff`, `pressureLog` or `chebyshev` say.
//
// Reactions have internal numbers: reversible ones first, those with a base constant independent of temperature side by
// side, otherwise in the mechanism's order. Units are SI with mol.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct KineticsTables {
  // A reaction with more than three reactants, or products if reversible, decimal coefficients or orders: handled by
  // explicit powers (concentration_power.hpp). The reaction's slots are empty.
  struct GeneralReaction {
    std::size_t reaction = 0;
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
  // Fall-off: the base is the high-pressure limit, factor = Pr/(1+Pr) F. Chemically activated: the base is the
  // low-pressure limit, factor = 1/(1+Pr) F. Both have Pr = k_low [M]/k_high, with
  //   ln (k_low/k_high) = direction (lnA + b ln T - Ta/T - ln k_base),
  //   Fcent = w3 exp(-T/T3) + w1 exp(-T/T1) + w2 exp(-T2/T) + byT T,  u = log10 Pr + shift0 + shift1 log10 Fcent,
  //   ln F = lnScale + scaleExponent ln T + ln Fcent/(1 + (u/(width0 + width1 log10 Fcent - slope u))^2).
  // Troe and Tsang have shift = (-0.4, -0.67), width = (0.75, -1.27), slope 0.14 and no scale; SRI has shift = 0, width
  // = (1, 0), slope 0; Lindemann has Fcent = 1.
  struct Falloff {
    std::vector<std::size_t> reaction, set;
    std::vector<double> direction;   // 1 fall-off, -1 chemically activated
    std::vector<double> lnA, b, Ta;  // of the limit that is not the base
    std::vector<double> w3, w1, w2, inverseT3, inverseT1, T2, byT;
    std::vector<double> shift0, shift1, width0, width1, slope, lnScale, scaleExponent;
  };
  // factor = k(T, p)/k_base. ln k is linear in ln p between the points points[i]..points[i+1] of entry i, constant
  // beyond; at point j, k = sum sign exp(lnA + b ln T - Ta/T) over rates[j]..rates[j+1].
  struct PressureLog {
    std::vector<std::size_t> reaction, points, rates;
    std::vector<double> lnPressure;
    std::vector<double> lnA, b, Ta, sign;
    std::vector<std::string> where;  // file, line and equation of each entry, for messages
  };
  // factor = k(T, p)/k_base, ln k = sum_ij coefficients[first + i numP + j] T_i(Tr) T_j(Pr), Tr = scaleT/T + shiftT,
  // Pr = scaleP ln p + shiftP; polynomials are continued outside the ranges of their data.
  struct Chebyshev {
    std::vector<std::size_t> reaction, first, numT, numP;
    std::vector<double> scaleT, shiftT, scaleP, shiftP;
    std::vector<double> coefficients;
  };

  // Base constants are multiplied by exp(-(Ea - intrinsic)/T), Ea from the enthalpy of reaction (BlowersMasel of
  // reaction.hpp), before anything else is done with them.
  struct EnthalpyDependent {
    std::size_t reaction = 0;
    double intrinsic = 0, bondEnergy = 0;  // K
  };
  // factor = k(T, p, c)/k_base; species of the colliders that are named.
  struct LinearBurke {
    std::size_t reaction = 0;
    std::vector<std::size_t> colliders;
  };

  // Throws InputError for a reaction whose rate cannot be computed.
  explicit KineticsTables(const Mechanism& mechanism);
  // Of reactions that are not the mechanism's own, between its species.
  KineticsTables(const Mechanism& mechanism, std::span<const Reaction> reactions);

  std::size_t numSpecies = 0;
  std::size_t numReactions = 0;
  std::size_t numReversible = 0;
  std::size_t constantBegin = 0, constantEnd = 0;  // range of the reactions with b = Ta = 0 and a positive A
  std::vector<std::size_t> original;               // mechanism's number of each internal reaction

  // Per reaction: base constant k = sign exp(lnA + b ln T - Ta/T), the sum of the net coefficients, and the species of
  // at most three reactants and products; numSpecies marks an empty slot, a constant concentration of one.
  std::vector<double> lnA, b, Ta, sign, nuSum;
  bool anyNegative = false;
  std::array<std::vector<std::int32_t>, 3> reactant, product;
  std::vector<std::vector<StoichiometricTerm>> netTerms;
  std::vector<GeneralReaction> general;

  std::vector<ThirdBodySet> sets;
  std::vector<ThirdBodyUse> threeBody;
  Falloff falloff;
  PressureLog pressureLog;
  Chebyshev chebyshev;
  std::vector<EnthalpyDependent> enthalpyDependent;
  std::vector<LinearBurke> linearBurke;

  // wdot_k = sum of signedProgress[rowSource[e]] over the entries rows[k] <= e < rows[k+1], where signedProgress holds
  // q of all reactions, then -q, then a zero; a coefficient of two makes two entries. Rows are padded to multiples of
  // four with the zero. Coefficients that are no whole numbers are in decimalTerms instead: wdot_k += nu q.
  struct DecimalTerm {
    std::size_t species = 0, reaction = 0;
    double nu = 0;
  };
  std::vector<std::size_t> rows;
  std::vector<std::int32_t> rowSource;
  std::vector<DecimalTerm> decimalTerms;

 private:
  void orderReactions(const Mechanism& mechanism, std::span<const Reaction> reactions);
  void setRates(const Mechanism& mechanism, std::span<const Reaction> reactions);
  void setSlots(const Mechanism& mechanism, std::span<const Reaction> reactions);
  void setFactors(const Mechanism& mechanism, std::span<const Reaction> reactions);
  static double lnMagnitude(double A);
  static Arrhenius baseRate(const Mechanism& mechanism, const Reaction& reaction);
  void addFalloff(std::size_t i, const Mechanism& mechanism, const Reaction& reaction);
  void addPressureLog(std::size_t i, const Mechanism& mechanism, const Reaction& reaction);
  void addChebyshev(std::size_t i, const ChebyshevRate& rate);
  void addLinearBurke(std::size_t i, const Reaction& reaction);
  void setProductionTable();
  std::size_t thirdBodySet(const ThirdBody& body);
};

}  // namespace lampblack::chemistry
