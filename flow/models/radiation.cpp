#include "flow/models/radiation.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "chemistry/mechanism/known_species.hpp"
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

// "CO2, CO"
std::string namesOf(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool hasElements(const Mechanism& mechanism, std::string_view formula) {
  for (const char element : {'C', 'H', 'O'})
    if (formula.find(element) != std::string_view::npos && !mechanism.findElement(std::string(1, element)))
      return false;
  return true;
}

}  // namespace

std::vector<std::string> radiationWarnings(const Mechanism& mechanism) {
  std::vector<std::string> missing, others;
  for (const char* name : {"H2O", "CO2", "CO"})
    if (hasElements(mechanism, name) && !findKnownSpecies(mechanism, name)) missing.emplace_back(name);
  for (const char* name : {"NH3", "N2O", "NO"})
    if (const auto k = findKnownSpecies(mechanism, name)) others.push_back(mechanism.speciesName(*k));
  std::vector<std::string> warnings;
  if (!missing.empty())
    warnings.push_back("radiation: no species of the mechanism is " + namesOf(missing) +
                       " for sure, by composition and name; what is left out does not radiate");
  if (!others.empty())
    warnings.push_back("radiation: H2O, CO2, CO and CH4 radiate; " + namesOf(others) +
                       " of the mechanism would too, but there are no data of them here");
  return warnings;
}

ThinRadiation::ThinRadiation(const Mechanism& mechanism, double surroundings)
    : h2o_(findKnownSpecies(mechanism, "H2O")),
      co2_(findKnownSpecies(mechanism, "CO2")),
      co_(findKnownSpecies(mechanism, "CO")),
      ch4_(findKnownSpecies(mechanism, "CH4")),
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
