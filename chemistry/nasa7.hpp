// NASA-7 polynomials of all species as flat arrays, evaluated in loops over species (thesis eqs 6-15..6-17).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/species.hpp"

namespace lampblack {

class Nasa7Table {
 public:
  explicit Nasa7Table(std::span<const Species> species);

  std::size_t size() const { return mid_.size(); }

  // Dimensionless, at temperature T in K; arrays of size() values. Outside the range of the data the polynomials are
  // extrapolated.
  void cpOverR(double T, double* cp) const;
  void cpSlopeOverR(double T, double* slope) const;  // d(cp/R)/dT, 1/K
  void enthalpyOverRT(double T, double* h) const;
  void entropyOverR(double T, double lnT, double* s) const;
  void gibbsOverRT(double T, double lnT, double* g) const;  // h/RT - s/R at the standard pressure

 private:
  std::vector<double> mid_;
  std::array<std::vector<double>, 7> low_;
  std::array<std::vector<double>, 7> high_;
};

}  // namespace lampblack
