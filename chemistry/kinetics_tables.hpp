// A mechanism's reactions as flat tables: rate constants, stoichiometry, third bodies, fall-off. Built once, immutable
// afterwards; the evaluators of rates (one state or many at a time) loop over them.
//
// Reactions have internal numbers: reversible ones first, otherwise in the mechanism's order. Units are SI with mol.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "chemistry/mechanism.hpp"

namespace lampblack {

struct KineticsTables {
  // A reaction with more than three reactants, or products if reversible, decimal coefficients or orders: handled by
  // explicit powers. Its slots are empty.
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
  // factor = Pr/(1+Pr) F(Pr, T) multiplies the high-pressure rate constant; one entry a fall-off reaction. The centre
  // of the broadening is Fcent = w3 exp(-T/T3) + w1 exp(-T/T1) + w2 exp(-T2/T); Lindemann has w1 = 1, 1/T1 = 0: Fcent
  // = 1.
  struct Falloff {
    std::vector<std::size_t> reaction, set;
    std::vector<double> lnA, b, Ta;  // low-pressure limit
    std::vector<double> w3, w1, w2, inverseT3, inverseT1, T2;
  };

  // Throws InputError for a reaction whose rate cannot be computed.
  explicit KineticsTables(const Mechanism& mechanism);

  std::size_t numSpecies = 0;
  std::size_t numReactions = 0;
  std::size_t numReversible = 0;
  std::vector<std::size_t> original;  // mechanism's number of each internal reaction

  // Per reaction: k = sign exp(lnA + b ln T - Ta/T), the sum of the net coefficients, and the species of at most three
  // reactants and products; numSpecies marks an empty slot, a constant concentration of one.
  std::vector<double> lnA, b, Ta, sign, nuSum;
  bool anyNegative = false;
  std::array<std::vector<std::int32_t>, 3> reactant, product;
  std::vector<std::vector<StoichiometricTerm>> netTerms;
  std::vector<GeneralReaction> general;

  std::vector<ThirdBodySet> sets;
  std::vector<ThirdBodyUse> threeBody;
  Falloff falloff;

  // wdot_k = sum over the entries rows[k]..rows[k+1] of rowNu * q[rowReaction]; rows are padded to multiples of four
  // with reaction numReactions and coefficient zero.
  std::vector<std::size_t> rows;
  std::vector<std::int32_t> rowReaction;
  std::vector<double> rowNu;

 private:
  void orderReactions(const Mechanism& mechanism);
  void setRates(const Mechanism& mechanism);
  void setSlots(const Mechanism& mechanism);
  void setThirdBodies(const Mechanism& mechanism);
  void setProductionTable();
  std::size_t thirdBodySet(const ThirdBody& body);
};

}  // namespace lampblack
