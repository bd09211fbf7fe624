// Compositions of equilibria, and the atoms in them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline std::vector<double> massFractions(const Mechanism& mechanism, const std::string& X) {
  std::vector<double> Y(mechanism.numSpecies());
  Thermo(mechanism).moleToMass(parseComposition(mechanism, X), Y);
  return Y;
}

inline std::vector<double> moleFractions(const Mechanism& mechanism, const std::vector<double>& Y) {
  std::vector<double> X(Y.size());
  Thermo(mechanism).massToMole(Y, X);
  return X;
}

// Atoms of an element per mass.
inline double content(const Mechanism& mechanism, std::size_t element, const std::vector<double>& Y) {
  double sum = 0;
  for (std::size_t k = 0; k < Y.size(); ++k)
    sum += mechanism.atoms(k, element) * Y[k] / mechanism.molecularWeights()[k];
  return sum;
}

}  // namespace lampblack::test
