// What a mechanism file says about one species, in SI units with mol.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// The standard state of all thermodynamic data is the ideal gas at 1 atm: a reader of data for another pressure shifts
// the entropy constant. Shomate polynomials are kept as NASA-9, constant heat capacities as NASA-7: both are special
// cases, to the last term.
//
// NASA seven-coefficient polynomials (Wang 2025, eqs 6-15..6-17): `low` holds up to and including `midTemperature`,
// `high` above. A file that gives a single range has low == high.
struct Nasa7 {
  double minTemperature = 0;  // K
  double midTemperature = 0;  // K
  double maxTemperature = 0;  // K
  std::array<double, 7> low{};
  std::array<double, 7> high{};
};

// NASA nine-coefficient polynomials (McBride, Zehe, Gordon 2002): a1..a7 and the constants b1, b2 of each range.
struct Nasa9 {
  std::vector<double> temperatures;           // K, bounds of the ranges, one more than ranges
  std::vector<std::array<double, 9>> ranges;  // cp/R = a1 T^-2 + a2 T^-1 + a3 + a4 T + a5 T^2 + a6 T^3 + a7 T^4
};

enum class MoleculeShape { Atom, Linear, Nonlinear };

// Parameters of the Stockmayer potential and of rotational relaxation (Wang 2025, section 6.2.3).
struct TransportData {
  MoleculeShape shape = MoleculeShape::Atom;
  double wellDepth = 0;             // eps/k_B, K
  double diameter = 0;              // m
  double dipole = 0;                // C m
  double polarizability = 0;        // m3 (volume)
  double rotationalRelaxation = 0;  // collision number at 298 K
};

struct Species {
  std::string name;
  std::vector<double> atoms;   // per element of the mechanism
  double molecularWeight = 0;  // kg/mol
  Nasa7 thermo;
  std::optional<Nasa9> nasa9;  // where given, it replaces `thermo`, which then holds only the range of temperature
  std::optional<TransportData> transport;
  int line = 0;      // where the file declares it
  std::string file;  // empty if it is the mechanism's
};

}  // namespace lampblack::chemistry
