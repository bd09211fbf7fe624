#include "coupling/carried_particles.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "chemistry/mechanism/known_species.hpp"

namespace lampblack::coupling {

CarriedParticles::CarriedParticles(const Mechanism& mechanism, std::unique_ptr<ParticleModel> model, bool diffusion)
    : model_(std::move(model)), diffusion_(diffusion) {
  for (const ParticleScalar& scalar : model_->scalars()) {
    std::vector<double> elements(mechanism.numElements(), 0.0);
    for (const ElementMass& part : scalar.elements) elements[mechanism.elementIndex(part.element)] = part.mass;
    scalars_.push_back({{scalar.name, scalar.unit, scalar.description},
                        scalar.scale,
                        model_->thermophoresis(),
                        std::move(elements),
                        ParticleModel::smallestShare * scalar.scale});
  }
  exchanged_ = knownSpecies(mechanism, model_->gasSpecies(), "the model needs");
}

void CarriedParticles::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                               std::span<double> exchange) {
  model_->sources(gas, densities, rates, exchange);
}

void CarriedParticles::jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) {
  if (out.columns != scalars_.size() + exchanged_.size() + 1)
    throw std::logic_error("particles: the Jacobian has another number of columns than the model");
  model_->jacobian(gas, densities, out.values);
}

ParticleAdvance CarriedParticles::advance(const CarrierGas& gas, double dt, std::span<double> densities,
                                          std::span<double> concentrations, std::span<const double> supply) {
  return model_->advance(gas, dt, densities, concentrations, supply);
}

bool CarriedParticles::idle(const ParticleGas& gas, std::span<const double> densities) const {
  return model_->idle(gas, densities);
}

void CarriedParticles::diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) {
  if (diffusion_)
    model_->diffusivities(gas, densities, D);
  else
    std::fill(D.begin(), D.end(), 0.0);
}

void CarriedParticles::enthalpies(double temperature, std::span<double> h, std::span<double> slope) {
  model_->enthalpies(temperature, h, slope);
}

double CarriedParticles::absorption(double temperature, std::span<const double> densities) {
  return model_->absorption(temperature, model_->volumeFraction(densities));
}

std::vector<Quantity> CarriedParticles::properties() const {
  std::vector<Quantity> names;
  for (const ParticlePropertyName& p : particlePropertyNames) names.push_back({p.name, p.unit, p.description});
  return names;
}

void CarriedParticles::evaluateProperties(const ParticleGas& gas, std::span<const double> densities,
                                          std::span<double> values) const {
  const ParticleProperties properties = model_->propertiesForResults(gas, densities);
  for (std::size_t i = 0; i < particlePropertyNames.size(); ++i) values[i] = properties.*particlePropertyNames[i].value;
}

double CarriedParticles::volumeFraction(std::span<const double> densities) const {
  return model_->volumeFraction(densities);
}

double CarriedParticles::volumeFractionAtLimit(std::span<const double> densities) const {
  return model_->volumeFractionAtLimit(densities);
}

}  // namespace lampblack::coupling
