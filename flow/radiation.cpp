#include "flow/radiation.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

template <std::size_t n>
double polynomial(const std::array<double, n>& c, double x) {
  double sum = 0;
  for (std::size_t i = n; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// Planck-mean absorption coefficients, 1/m/atm, fitted by the TNF workshop to RADCAL (Grosshandler 1993) from 300 to
// 2500 K: H2O and CO2 in 1000 K/T, CO and CH4 in T/K.
constexpr double lowest = 300, highest = 2500;  // K
constexpr std::array waterTerms{-0.23093, -1.12390, 9.41530, -2.99880, 0.51382, -1.86840e-5};
constexpr std::array dioxideTerms{18.741, -121.310, 273.500, -194.050, 56.310, -5.8169};
constexpr double monoxideSplit = 750;  // K
constexpr std::array coldMonoxideTerms{4.7869, -0.06953, 2.95775e-4, -4.25732e-7, 2.02894e-10};
constexpr std::array hotMonoxideTerms{10.09, -0.01183, 4.7753e-6, -5.87209e-10, -2.5334e-14};
constexpr std::array methaneTerms{6.6334, -0.0035686, 1.6682e-8, 2.5611e-10, -2.6558e-14};

}  // namespace

ThinRadiation::ThinRadiation(const Mechanism& mechanism, double surroundings)
    : h2o_(mechanism.findSpecies("H2O")),
      co2_(mechanism.findSpecies("CO2")),
      co_(mechanism.findSpecies("CO")),
      ch4_(mechanism.findSpecies("CH4")),
      surroundings4_(surroundings * surroundings * surroundings * surroundings) {
  if (!(surroundings >= 0))
    throw InputError("radiation: the temperature of the surroundings cannot be " + std::to_string(surroundings) + " K");
}

double ThinRadiation::absorption(double T, double p, std::span<const double> X) const {
  const double t = std::clamp(T, lowest, highest);
  const double inverse = 1000 / t;
  double sum = 0;  // 1/m/atm times mole fractions
  if (h2o_) sum += X[*h2o_] * polynomial(waterTerms, inverse);
  if (co2_) sum += X[*co2_] * polynomial(dioxideTerms, inverse);
  if (co_) sum += X[*co_] * (t <= monoxideSplit ? polynomial(coldMonoxideTerms, t) : polynomial(hotMonoxideTerms, t));
  if (ch4_) sum += X[*ch4_] * polynomial(methaneTerms, t);
  return sum * p / constants::oneAtmosphere;
}

double ThinRadiation::loss(double absorption, double T) const {
  return 4 * constants::stefanBoltzmann * absorption * (T * T * T * T - surroundings4_);
}

double ThinRadiation::lossSlope(double absorption, double T) const {
  return 16 * constants::stefanBoltzmann * absorption * T * T * T;
}

}  // namespace lampblack::flow
