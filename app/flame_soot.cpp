#include "app/flame_soot.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace lampblack {

FlameSoot::FlameSoot(const Mechanism& mechanism, std::unique_ptr<SootModel> model, bool diffusion)
    : model_(std::move(model)), diffusion_(diffusion) {
  const std::size_t carbon = mechanism.elementIndex("C"), hydrogen = mechanism.elementIndex("H");
  for (const SootScalar& scalar : model_->scalars()) {
    std::vector<double> elements(mechanism.numElements(), 0.0);
    elements[carbon] = scalar.carbon;
    elements[hydrogen] = scalar.hydrogen;
    scalars_.push_back({scalar.name, scalar.unit, scalar.scale, sootThermophoresis(), std::move(elements)});
  }
  for (const std::string& name : model_->gasSpecies()) exchanged_.push_back(mechanism.speciesIndex(name));
}

void FlameSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                        std::span<double> exchange) {
  model_->sources(gas, densities, rates, exchange);
}

void FlameSoot::jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) {
  if (out.columns != scalars_.size() + exchanged_.size() + 1)
    throw std::logic_error("soot: the Jacobian has another number of columns than the model");
  model_->jacobian(gas, densities, out.values);
}

void FlameSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) {
  if (diffusion_)
    model_->diffusivities(gas, densities, D);
  else
    std::fill(D.begin(), D.end(), 0.0);
}

void FlameSoot::enthalpies(double temperature, std::span<double> h, std::span<double> slope) {
  const auto [carbon, carbonSlope] = sootCarbonEnthalpy(temperature);
  const auto [hydrogen, hydrogenSlope] = sootHydrogenEnthalpy(temperature);
  const std::vector<SootScalar>& scalars = model_->scalars();
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    h[i] = scalars[i].carbon * carbon + scalars[i].hydrogen * hydrogen;
    slope[i] = scalars[i].carbon * carbonSlope + scalars[i].hydrogen * hydrogenSlope;
  }
}

double FlameSoot::absorption(double temperature, std::span<const double> densities) {
  return 700 * model_->volumeFraction(densities) * temperature;
}

}  // namespace lampblack
