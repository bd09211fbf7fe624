// Factors of fall-off and chemically activated reactions at one state (tables and equations: kinetics_tables.hpp). What
// depends on temperature alone is kept between calls.
//
// Sources: Gilbert, Luther, Troe (1983) and Stewart, Larson, Golden (1989) for the broadening F.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class FalloffFactors {
 public:
  explicit FalloffFactors(const KineticsTables& tables);

  // lnBase: ln of the magnitude of every reaction's base rate constant at this temperature.
  void setTemperature(const KineticsTables& tables, double T, double lnT, const double* lnBase);

  // The factors of all entries at the temperature set; [M] of every set of efficiencies in mol/m3.
  std::span<const double> evaluate(const KineticsTables& tables, const double* M);

  // Partial derivatives of the factors last evaluated, with respect to [M] and to T. Call evaluateSlopes first.
  void evaluateSlopes(const KineticsTables& tables);
  std::span<const double> byM() const { return byM_; }
  std::span<const double> byT() const { return byT_; }

 private:
  double T_ = 0;
  std::vector<double> ratio_;  // k_low/k_high, so that Pr = ratio [M]
  std::vector<double> terms_;  // the three exponentials of Fcent, one block each
  std::vector<double> lnFcent_, shift_, width_, lnScale_;
  std::vector<double> pr_, u_, values_;
  std::vector<double> byM_, byT_;
};

}  // namespace lampblack::chemistry
