// What a mechanism file says about one species, in SI units with mol.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lampblack {

// NASA seven-coefficient polynomials (thesis eqs 6-15..6-17): `low` holds up to and including `midTemperature`, `high`
// above. A file that gives a single range has low == high.
struct Nasa7 {
  double minTemperature = 0;  // K
  double midTemperature = 0;  // K
  double maxTemperature = 0;  // K
  std::array<double, 7> low{};
  std::array<double, 7> high{};
};

enum class MoleculeShape { Atom, Linear, Nonlinear };

// Parameters of the Stockmayer potential and of rotational relaxation (thesis section 6.2.3).
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
  std::optional<TransportData> transport;
  int line = 0;  // where the file declares it
};

}  // namespace lampblack
