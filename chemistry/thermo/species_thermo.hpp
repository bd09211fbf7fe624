// Standard-state thermodynamics of all species as flat arrays: NASA-7 polynomials in loops over species (Wang 2025, eqs
// 6-15..6-17), species with NASA-9 polynomials (McBride, Zehe, Gordon 2002, NASA/TP-2002-211556) after them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/mechanism/species.hpp"
#include "core/modules.hpp"
#include "numerics/aligned_vector.hpp"

namespace lampblack::chemistry {

// h/R and cp/R of a mixture of NASA-7 species as one polynomial, between the temperatures at which any of them changes.
struct MixturePolynomial {
  std::array<double, 6> c{};                  // sums of a_1..a_6
  double above = HUGE_VAL, upTo = -HUGE_VAL;  // K, where it holds

  bool holds(double T) const { return T > above && T <= upTo; }
  double enthalpy(double T) const {  // K per unit of the weights
    return c[5] + T * (c[0] + T * (c[1] / 2 + T * (c[2] / 3 + T * (c[3] / 4 + T * (c[4] / 5)))));
  }
  double heatCapacity(double T) const { return c[0] + T * (c[1] + T * (c[2] + T * (c[3] + T * c[4]))); }
};

class SpeciesThermo {
 public:
  explicit SpeciesThermo(std::span<const Species> species);

  std::size_t size() const { return mid_.size(); }

  // Dimensionless, at temperature T in K; arrays of size() values. Outside the range of the data the polynomials are
  // extrapolated.
  void cpOverR(double T, double* cp) const;
  void cpSlopeOverR(double T, double* slope) const;  // d(cp/R)/dT, 1/K
  void enthalpyOverRT(double T, double* h) const;
  void entropyOverR(double T, double lnT, double* s) const;
  void gibbsOverRT(double T, double lnT, double* g) const;  // h/RT - s/R at the standard pressure

  // Of a mixture with these weights of the species, around T. Where all species are of NASA-7 (hasMixtures) only.
  bool hasMixtures() const { return nasa9_.empty(); }
  MixturePolynomial mixture(double T, const double* weights) const;

 private:
  struct Nasa9Species {
    std::size_t index = 0;
    Nasa9 data;
  };

  std::vector<double> mid_;
  std::vector<double> changes_;         // the different temperatures among them, rising
  AlignedVector lowBlock_, highBlock_;  // the coefficients of a species side by side, a block each
  std::array<std::vector<double>, 7> low_;
  std::array<std::vector<double>, 7> high_;
  std::vector<Nasa9Species> nasa9_;
};

// The same of one species.
double cpOverR(const Species& species, double T);
double enthalpyOverRT(const Species& species, double T);
double entropyOverR(const Species& species, double T);

}  // namespace lampblack::chemistry
