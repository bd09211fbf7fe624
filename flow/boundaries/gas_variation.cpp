#include "flow/boundaries/gas_variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double sumRoundOff = 1e-9;    // of a sum of mole fractions
constexpr double writtenDigits = 1e-3;  // the same where all are given, as in a table

// Mole fractions of which some are given: the others keep their proportions and fill what is left of one.
void fillMoleFractions(const std::vector<std::pair<std::size_t, double>>& given, std::vector<double>& X) {
  double sum = 0.0;
  for (const auto& [species, share] : given) {
    if (share < 0.0) throw InputError(fmt::format("expected mole fractions of zero or more, found {:g}", share));
    X[species] = 0.0;
    sum += share;
  }
  const double others = std::accumulate(X.begin(), X.end(), 0.0);
  if (others > 0.0 ? sum > 1.0 + sumRoundOff : std::abs(sum - 1.0) > writtenDigits)
    throw InputError(fmt::format("expected mole fractions that sum to one, found {:g}", sum));
  const double scale = others > 0.0 ? std::max(1.0 - sum, 0.0) / others : 0.0;
  for (double& share : X) share *= scale;
  for (const auto& [species, share] : given) X[species] = share;
}

}  // namespace

void GasVariation::apply(const Vector3& place, double time, const Thermo& thermo, double& T,
                         std::vector<double>& Y) const {
  if (temperature) {
    T = temperature(place, time);
    if (!(T >= Transport::minTemperature && T <= Transport::maxTemperature))
      throw InputError(fmt::format("expected a temperature from {:g} to {:g} K, found {:g} K",
                                   Transport::minTemperature, Transport::maxTemperature, T));
  }
  if (moleFractions.empty()) return;
  std::vector<std::pair<std::size_t, double>> given;
  for (const auto& [species, share] : moleFractions) given.emplace_back(species, share(place, time));
  std::vector<double> X(Y.size(), 0.0);
  if (std::ranges::any_of(Y, [](double y) { return y > 0.0; })) thermo.massToMole(Y, X);
  fillMoleFractions(given, X);
  thermo.moleToMass(X, Y);
}

}  // namespace lampblack::flow
