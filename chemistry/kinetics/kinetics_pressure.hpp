// Rate constants tabulated over pressure, at one state: logarithmic interpolation between pressures and Chebyshev
// polynomials (tables of kinetics_tables.hpp). What depends on temperature alone is kept between calls.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class PressureRates {
 public:
  explicit PressureRates(const KineticsTables& tables);

  // d ln k / d ln p at constant T and d ln k / dT at constant p, 1/K
  struct Slope {
    double byLnP = 0, byT = 0;
  };

  // Throws NumericsError, naming the reaction, if the rate constants given for one pressure add up to nothing positive.
  void setTemperature(const KineticsTables& tables, double T, double lnT);

  // ln k of entry i at the temperature set and ln(p/Pa).
  double logarithmic(const KineticsTables& tables, std::size_t i, double lnP) const;
  double chebyshev(const KineticsTables& tables, std::size_t i, double lnP) const;
  Slope logarithmicSlope(const KineticsTables& tables, std::size_t i, double lnP) const;
  Slope chebyshevSlope(const KineticsTables& tables, std::size_t i, double lnP) const;

 private:
  double pointSlope(const KineticsTables::PressureLog& table, std::size_t point) const;

  double T_ = 0;
  std::vector<double> lnRates_;          // of every rate of every pressure
  std::vector<double> lnPoints_;         // ln k at every pressure
  std::vector<std::size_t> chebyFirst_;  // of each entry in the next two
  std::vector<double> chebySums_;        // sum_i a_ij T_i(Tr) for each j
  std::vector<double> chebySlopes_;      // its derivative with respect to T
};

}  // namespace lampblack::chemistry
