#include "flow/burnt_mixture.hpp"

#include <algorithm>

#include "chemistry/mechanism/known_species.hpp"

namespace lampblack::flow {
namespace {

// Of the water that complete combustion forms, the share that is H + OH, as near 2300 K. Reduced mechanisms often have
// no initiation reactions: without radicals nothing would ever start.
constexpr double dissociated = 0.03;

}  // namespace

BurntMixture::BurntMixture(const Mechanism& mechanism, const Thermo& thermo)
    : mechanism_(mechanism), thermo_(thermo), equilibrium_(mechanism) {
  for (const char* element : {"C", "H", "O"}) elements_.push_back(mechanism.findElement(element));
  for (const char* name : {"CO2", "CO", "H2O", "O2"}) products_.push_back(findKnownSpecies(mechanism, name));
  for (const char* name : {"H", "OH"}) radicals_.push_back(findKnownSpecies(mechanism, name));
}

bool BurntMixture::isComplete() const {
  const auto known = [](const std::optional<std::size_t>& species) { return species.has_value(); };
  return std::ranges::all_of(products_, known) && std::ranges::all_of(radicals_, known);
}

double BurntMixture::burn(double enthalpy, double pressure, double hottest, std::vector<double>& Y) {
  if (isComplete()) {
    burnCompletely(Y);
    return std::min(thermo_.temperatureFromEnthalpy(enthalpy, Y, 1500.0), hottest);
  }
  const double T = equilibrium_.atEnthalpyAndPressure(enthalpy, pressure, Y);
  if (T <= hottest) return T;
  equilibrium_.atTemperatureAndPressure(hottest, pressure, Y);
  return hottest;
}

void BurntMixture::burnCompletely(std::vector<double>& Y) const {
  const auto W = mechanism_.molecularWeights();
  const std::size_t o2 = *products_[3];
  double oxygen = 2.0 * Y[o2] / W[o2];  // mol of atoms per kg
  // Fuels are the species of C and H alone; the share of them that can burn at least to CO and H2O does.
  std::vector<std::size_t> fuels;
  double carbon = 0.0;
  double hydrogen = 0.0;
  for (std::size_t k = 0; k < Y.size(); ++k) {
    const double c = atoms(k, 0);
    const double h = atoms(k, 1);
    if (c + h <= 0.0 || atoms(k, 2) > 0.0 || !onlyCarbonAndHydrogen(k)) continue;
    fuels.push_back(k);
    carbon += c * std::max(Y[k], 0.0) / W[k];
    hydrogen += h * std::max(Y[k], 0.0) / W[k];
  }
  const double needed = carbon + 0.5 * hydrogen;
  if (needed <= 0.0 || oxygen <= 0.0) return;
  const double share = std::min(1.0, oxygen / needed);
  for (std::size_t k : fuels) Y[k] *= 1.0 - share;
  carbon *= share;
  hydrogen *= share;
  oxygen -= carbon + 0.5 * hydrogen;
  const double toCo2 = std::min(carbon, std::max(oxygen, 0.0));
  oxygen -= toCo2;
  const double water = 0.5 * hydrogen;
  Y[*products_[2]] += (1.0 - dissociated) * water * W[*products_[2]];
  for (const auto& radical : radicals_) Y[*radical] += dissociated * water * W[*radical];
  Y[*products_[0]] += toCo2 * W[*products_[0]];
  Y[*products_[1]] += (carbon - toCo2) * W[*products_[1]];
  Y[o2] = 0.5 * std::max(oxygen, 0.0) * W[o2];
  double sum = 0.0;
  for (double y : Y) sum += y;
  for (double& y : Y) y /= sum;
}

double BurntMixture::atoms(std::size_t k, std::size_t which) const {
  return elements_[which] ? mechanism_.atoms(k, *elements_[which]) : 0.0;
}

bool BurntMixture::onlyCarbonAndHydrogen(std::size_t k) const {
  for (std::size_t e = 0; e < mechanism_.numElements(); ++e)
    if (mechanism_.atoms(k, e) > 0.0 && e != elements_[0].value_or(e + 1) && e != elements_[1].value_or(e + 1))
      return false;
  return true;
}

}  // namespace lampblack::flow
