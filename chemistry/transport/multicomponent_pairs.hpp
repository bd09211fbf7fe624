// What multicomponent transport takes from every pair of molecules, as polynomials of temperature instead of collision
// integrals: least squares in T^(-1/3) from 200 to 4000 K, as Transport has them.
//
// With c = 1/(p D_jk), m = W_j + W_k and the ratios A*, B*, C* of collision integrals:
//   conductance  c, zero for j = k
//   thermal      (6/5 C* - 1) c/m, zero for j = k
//   exchange     A* c/m
//   energy       (55/4 - 3 B*) c/m^2
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/transport/pair_polynomials.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class MulticomponentPairs {
 public:
  MulticomponentPairs(const PureGas& gas, std::span<const double> weights);  // kg/mol

  // A column a species, with as many rows, rounded up to whole lanes, zero behind the last species: symmetric.
  struct Matrices {
    std::vector<double> conductance, thermal, exchange, energy;  // m-2 s/Pa; over kg/mol, kg/mol, (kg/mol)^2
    std::vector<double> own;                                     // c_kk
  };

  // At T (K).
  void fill(double T, Matrices& matrices);

 private:
  static constexpr std::size_t terms = 8;
  using Polynomials = PairPolynomials<terms>;

  std::size_t n_, ld_;
  Polynomials conductance_, thermal_, exchange_, energy_;  // times T^(3/2)
  std::vector<double> own_;                                // [term][species]
};

}  // namespace lampblack::chemistry
