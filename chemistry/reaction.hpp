// One reaction of a mechanism, in SI units with mol (rate constants in (m3/mol)^(order-1)/s).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lampblack {

// k = A T^b exp(-Ta/T)
struct Arrhenius {
  double A = 0;
  double b = 0;
  double activationTemperature = 0;  // K, Ea/R
};

// Broadening of a fall-off curve (Gilbert, Luther, Troe 1983). Without T2 the third exponential is absent.
struct TroeBroadening {
  double A = 0;
  double T3 = 0;  // K; zero means the term exp(-T/T3) is zero
  double T1 = 0;  // K; zero means the term exp(-T/T1) is zero
  std::optional<double> T2;
};

struct StoichiometricTerm {
  std::size_t species = 0;
  double coefficient = 0;
};

// [M] = sum_k efficiency_k c_k
struct ThirdBody {
  double defaultEfficiency = 1;
  std::vector<StoichiometricTerm> efficiencies;
};

struct Reaction {
  enum class Type { Elementary, ThreeBody, Falloff };

  std::string equation;
  Type type = Type::Elementary;
  std::vector<StoichiometricTerm> reactants;  // species appear once, the third body of [M] not at all
  std::vector<StoichiometricTerm> products;
  std::vector<StoichiometricTerm> orders;  // forward orders where they differ from the coefficients
  bool reversible = true;
  bool duplicate = false;
  Arrhenius rate;                      // high-pressure limit of a fall-off reaction
  Arrhenius lowPressureRate;           // fall-off only
  std::optional<TroeBroadening> troe;  // fall-off only; absent means Lindemann
  std::optional<ThirdBody> thirdBody;  // three-body and fall-off
  int line = 0;
};

}  // namespace lampblack
