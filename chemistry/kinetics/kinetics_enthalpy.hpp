// Factors on base rate constants whose activation energy follows the enthalpy of reaction (Blowers, Masel 2000; formula
// in reaction.hpp): what exp(-Ea/T) is in excess of the intrinsic energy's.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class EnthalpyFactors {
 public:
  explicit EnthalpyFactors(const KineticsTables& tables);

  // ln of the factors of tables.enthalpyDependent, from h/RT of all species.
  std::span<const double> logarithms(const KineticsTables& tables, double T, const double* enthalpyOverRT);
  // Derivatives of the logarithms by T, 1/K; also needs cp/R.
  std::span<const double> slopes(const KineticsTables& tables, double T, const double* enthalpyOverRT,
                                 const double* cpOverR);

 private:
  std::vector<double> values_;
};

}  // namespace lampblack::chemistry
