#include "flow/mixing_layer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "chemistry/mechanism/known_species.hpp"
#include "chemistry/thermo/equilibrium.hpp"

namespace lampblack::flow {
namespace {

// Converts the fuel of a mixture to products as far as its oxygen reaches.
class CompleteCombustion {
 public:
  explicit CompleteCombustion(const Mechanism& mechanism) : mechanism_(mechanism) {
    for (const char* element : {"C", "H", "O"}) elements_.push_back(mechanism.findElement(element));
    for (const char* name : {"CO2", "CO", "H2O", "O2"}) products_.push_back(findKnownSpecies(mechanism, name));
    for (const char* name : {"H", "OH"}) radicals_.push_back(findKnownSpecies(mechanism, name));
  }

  // Whether the mechanism has the products, and the radicals.
  [[nodiscard]] bool possible() const {
    const auto known = [](const std::optional<std::size_t>& species) { return species.has_value(); };
    return std::ranges::all_of(products_, known) && std::ranges::all_of(radicals_, known);
  }

  void burn(std::vector<double>& Y) const {
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

 private:
  [[nodiscard]] double atoms(std::size_t k, std::size_t which) const {
    return elements_[which] ? mechanism_.atoms(k, *elements_[which]) : 0.0;
  }
  [[nodiscard]] bool onlyCarbonAndHydrogen(std::size_t k) const {
    for (std::size_t e = 0; e < mechanism_.numElements(); ++e)
      if (mechanism_.atoms(k, e) > 0.0 && e != elements_[0].value_or(e + 1) && e != elements_[1].value_or(e + 1))
        return false;
    return true;
  }

  // Reduced mechanisms often have no initiation reactions: without radicals nothing would ever start.
  static constexpr double dissociated = 0.03;  // share of the water formed that is H + OH, as near 2300 K

  const Mechanism& mechanism_;
  std::vector<std::optional<std::size_t>> elements_;  // C, H, O
  std::vector<std::optional<std::size_t>> products_;  // CO2, CO, H2O, O2
  std::vector<std::optional<std::size_t>> radicals_;  // H, OH
};

// Brings a mixture to equilibrium at its enthalpy, or at `hottest` if that is less. Returns the temperature.
double burnToEquilibrium(Equilibrium& equilibrium, double enthalpy, double pressure, double hottest,
                         std::vector<double>& Y) {
  const double T = equilibrium.atEnthalpyAndPressure(enthalpy, pressure, Y);
  if (T <= hottest) return T;
  equilibrium.atTemperatureAndPressure(hottest, pressure, Y);
  return hottest;
}

}  // namespace

void setMixingLayer(const FlowContext& context, const MixingLayer& layer, State& state) {
  const Mesh& m = context.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  const CompleteCombustion combustion(context.mechanism);
  Equilibrium equilibrium(context.mechanism);
  std::vector<double> Y(n);
  const double lowEnthalpy = context.thermo.enthalpyMass(layer.low.temperature, layer.low.Y);
  const double highEnthalpy = context.thermo.enthalpyMass(layer.high.temperature, layer.high.Y);
  for (int c = 0; c < m.cells; ++c) {
    const double x = m.centre[c][layer.axis];
    const double share = 0.5 * (1.0 - std::tanh(2.0 * (x - layer.position) / layer.width));  // of the low stream
    for (std::size_t k = 0; k < n; ++k) Y[k] = share * layer.low.Y[k] + (1.0 - share) * layer.high.Y[k];
    const double h = share * lowEnthalpy + (1.0 - share) * highEnthalpy;
    double T = context.thermo.temperatureFromEnthalpy(h, Y, layer.low.temperature);
    if (layer.burnt && combustion.possible()) {
      combustion.burn(Y);
      T = std::min(context.thermo.temperatureFromEnthalpy(h, Y, 1500.0), std::max(T, layer.temperature));
    } else if (layer.burnt) {
      T = burnToEquilibrium(equilibrium, h, state.thermodynamicPressure, std::max(T, layer.temperature), Y);
    } else {
      const double away = (x - layer.hotPosition) / layer.hotWidth;
      T = std::max(T, T + (layer.temperature - T) * std::exp(-away * away));
    }
    std::copy(Y.begin(), Y.end(), &state.Y[c * n]);
    state.temperature[c] = T;
    state.enthalpy[c] = context.thermo.enthalpyMass(T, Y);
    state.density[c] = context.thermo.density(T, state.thermodynamicPressure, Y);
  }
}

}  // namespace lampblack::flow
