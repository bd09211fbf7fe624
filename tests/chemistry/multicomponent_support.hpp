// What tests of multicomponent transport ask of its pairs of species.
#pragma once

#include <vector>

#include "chemistry/transport/multicomponent_pairs.hpp"

namespace lampblack::test {

// What the polynomials of pairs give, and a place in their matrices.
struct Pairs {
  Pairs(const chemistry::Mechanism& mechanism, double T) : rows((mechanism.numSpecies() + 7) / 8 * 8) {
    chemistry::MulticomponentPairs(chemistry::PureGas(mechanism), mechanism.molecularWeights()).fill(T, of);
  }
  double at(const std::vector<double>& matrix, std::size_t i, std::size_t j) const { return matrix[j * rows + i]; }
  double conductance(std::size_t i, std::size_t j) const { return at(of.conductance, i, j); }  // 1/(p D_ij)

  std::size_t rows;
  chemistry::MulticomponentPairs::Matrices of;
};

}  // namespace lampblack::test
