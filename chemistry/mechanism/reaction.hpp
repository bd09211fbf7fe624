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

// Broadening of a fall-off curve by the SRI formula (Stewart, Larson, Golden 1989):
// F = d T^e (a exp(-b/T) + exp(-T/c))^X, X = 1/(1 + (log10 Pr)^2).
struct SriBroadening {
  double a = 0;
  double b = 0;  // K
  double c = 0;  // K; zero means the term exp(-T/c) is zero
  double d = 1;
  double e = 0;
};

// One entry of a rate constant that is tabulated over pressure: ln k is linear in ln p between the pressures, constant
// beyond the first and the last. Entries of the same pressure add up.
struct PressureRate {
  double pressure = 0;  // Pa
  Arrhenius rate;
};

// log10 k = sum_ij coefficients[i * numPressure + j] T_i(Tr) T_j(Pr) with the Chebyshev polynomials of the first kind
// of the reduced inverse temperature and the reduced logarithm of pressure; k in SI units with mol.
struct ChebyshevRate {
  double minTemperature = 0, maxTemperature = 0;  // K
  double minPressure = 0, maxPressure = 0;        // Pa
  std::size_t numTemperature = 0, numPressure = 0;
  std::vector<double> coefficients;
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
  enum class Type {
    Elementary,
    ThreeBody,
    Falloff,              // k = k_inf Pr/(1+Pr) F, Pr = k_0 [M]/k_inf
    ChemicallyActivated,  // k = k_0 1/(1+Pr) F, the same Pr
    PressureLog,          // pressureRates
    Chebyshev,
  };

  std::string equation;
  Type type = Type::Elementary;
  std::vector<StoichiometricTerm> reactants;  // species appear once, the third body of [M] not at all
  std::vector<StoichiometricTerm> products;
  // Forward orders where they differ from the coefficients; may name species that are no reactants (coefficient zero),
  // and may be negative. Only of irreversible reactions.
  std::vector<StoichiometricTerm> orders;
  bool reversible = true;
  bool duplicate = false;
  // High-pressure limit of fall-off and chemically activated reactions; unused where the constant depends on pressure.
  Arrhenius rate;
  Arrhenius lowPressureRate;                // fall-off and chemically activated
  std::optional<TroeBroadening> troe;       // of these two; with neither, Lindemann (F = 1)
  std::optional<SriBroadening> sri;         // of these two
  std::optional<ThirdBody> thirdBody;       // three-body, and these two
  std::vector<PressureRate> pressureRates;  // PressureLog, in rising order of pressure
  std::optional<ChebyshevRate> chebyshev;   // Chebyshev
  int line = 0;
  std::string file;  // empty if it is the mechanism's
};

}  // namespace lampblack
