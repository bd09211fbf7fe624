// Factors of fall-off and chemically activated reactions at one state (tables and equations: kinetics_tables.hpp). What
// depends on temperature alone is kept between calls.
//
// Sources: Gilbert, Luther, Troe (1983) and Stewart, Larson, Golden (1989) for the broadening F.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/kinetics_tables.hpp"

namespace lampblack {

class FalloffFactors {
 public:
  explicit FalloffFactors(const KineticsTables& tables);

  // lnBase: ln of the magnitude of every reaction's base rate constant at this temperature.
  void setTemperature(const KineticsTables& tables, double T, double lnT, const double* lnBase);

  // The factors of all entries at the temperature set; [M] of every set of efficiencies in mol/m3.
  std::span<const double> evaluate(const KineticsTables& tables, const double* M);

  // Partial derivatives of the factor of entry i with respect to its [M] and to T.
  struct Slope {
    double byM = 0, byT = 0;
  };
  Slope slope(const KineticsTables& tables, std::size_t i, double M) const;

 private:
  double T_ = 0;
  std::vector<double> ratio_;  // k_low/k_high, so that Pr = ratio [M]
  std::vector<double> terms_;  // the three exponentials of Fcent, one block each
  std::vector<double> lnFcent_, shift_, width_, lnScale_;
  std::vector<double> pr_, values_;
};

}  // namespace lampblack
