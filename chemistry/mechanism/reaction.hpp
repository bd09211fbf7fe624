// One reaction of a mechanism, in SI units with mol (rate constants in (m3/mol)^(order-1)/s).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

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

// Broadening with the centre Fcent = A + B T and otherwise Troe's formula (Tsang, Herron 1991).
struct TsangBroadening {
  double A = 1;
  double B = 0;  // 1/K
};

// Activation energy that follows the enthalpy of reaction H (Blowers, Masel, AIChE J. 46 (2000) 2041-2052), all over R
// in K. With the intrinsic energy E0 (where H is zero) and the mean energy w of the bonds broken and formed it is 0 for
// H <= -4 E0, H for H >= 4 E0, and (w + H/2) (V - 2 w + H)^2/(V^2 - 4 w^2 + H^2), V = 2 w (w + E0)/(w - E0), between.
struct BlowersMasel {
  double bondEnergy = 0;  // w; above E0, which is the activation temperature of the reaction's rate
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

struct Collider;

struct Reaction {
  enum class Type {
    Elementary,
    ThreeBody,
    Falloff,              // k = k_inf Pr/(1+Pr) F, Pr = k_0 [M]/k_inf
    ChemicallyActivated,  // k = k_0 1/(1+Pr) F, the same Pr
    PressureLog,          // pressureRates
    Chebyshev,
    LinearBurke,  // colliders
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
  // High-pressure limit of fall-off and chemically activated reactions; unused where the constant depends on pressure
  // in another way.
  Arrhenius rate;
  Arrhenius lowPressureRate;                 // fall-off and chemically activated
  std::optional<TroeBroadening> troe;        // of these two; with neither, Lindemann (F = 1)
  std::optional<SriBroadening> sri;          // of these two
  std::optional<TsangBroadening> tsang;      // of these two
  std::optional<BlowersMasel> blowersMasel;  // elementary and three-body
  std::optional<ThirdBody> thirdBody;        // three-body, and these two
  std::vector<PressureRate> pressureRates;   // PressureLog, in rising order of pressure
  std::optional<ChebyshevRate> chebyshev;    // Chebyshev
  std::vector<Collider> colliders;           // LinearBurke, that of all other species first
  int line = 0;
  std::string file;  // empty if it is the mechanism's
};

// A collider of the linear mixture rule in reduced pressure (Burke, Song, J. Phys. Chem. A 121 (2017) 4139; Singal,
// Lee, Lei, Speth, Burke, Proc. Combust. Inst. 40 (2024) 105779, eq. 8). With E = sum_j efficiency_j c_j over all
// species,
//   k = 1/E sum_j efficiency_j c_j k_j(T, p = R T E/efficiency_j);
// a collider without a rate of its own has that of the first at p = R T E.
struct Collider {
  std::optional<std::size_t> species;  // all that are not named, for the first
  Arrhenius efficiency{1, 0, 0};       // relative to the first, whose own is one
  bool ownRate = false;
  Reaction rate;  // of a fall-off (p stands for its [M]), PLOG or Chebyshev reaction
};

}  // namespace lampblack::chemistry
