#include "coupling/reactor_particles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"

namespace lampblack::coupling {

ReactorGas::ReactorGas(const Mechanism& mechanism, std::vector<std::size_t> species, GasViscosity viscosity)
    : weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      species_(std::move(species)),
      all_(weights_.size()),
      X_(weights_.size()),
      D_(weights_.size()),
      seen_(species_.size()) {
  if (viscosity == GasViscosity::transport) transport_.emplace(mechanism);
}

const ParticleGas& ReactorGas::at(double T, double p, std::span<const double> concentrations) {
  double moles = 0, mass = 0;  // per m3
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    moles += concentrations[k];
    mass += concentrations[k] * weights_[k];
  }
  for (std::size_t k = 0; k < weights_.size(); ++k) X_[k] = concentrations[k] / moles;
  for (std::size_t i = 0; i < species_.size(); ++i) seen_[i] = concentrations[species_[i]];
  const double viscosity = transport_ ? transport_->mixture(T, p, X_, D_).viscosity : viscosityOfAir(T);
  gas_ = {{T, p, mass, viscosity, mass / moles}, seen_};
  return gas_;
}

const ParticleGas& ReactorGas::atComposition(double T, double p, std::span<const double> Y) {
  double moles = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) moles += Y[k] / weights_[k];
  const double perMole = p / (constants::gasConstant * T * moles);
  for (std::size_t k = 0; k < weights_.size(); ++k) all_[k] = Y[k] / weights_[k] * perMole;
  return at(T, p, all_);
}

ReactorParticles::ReactorParticles(const Mechanism& mechanism, CarriedParticles& particles)
    : particles_(particles), gas_(mechanism, particles.exchanged()), densities_(particles.scalars().size()) {
  for (const CarriedModel::Scalar& scalar : particles.scalars()) scales_.push_back(scalar.scale);
}

void ReactorParticles::densities(double density, std::span<const double> amounts, std::span<double> out) const {
  for (std::size_t s = 0; s < size(); ++s) out[s] = amounts[s] * scales_[s] * density;
}

void ReactorParticles::amounts(double density, std::span<const double> densities, std::span<double> out) const {
  for (std::size_t s = 0; s < size(); ++s) out[s] = densities[s] / (scales_[s] * density);
}

void ReactorParticles::sources(double T, double p, std::span<const double> concentrations,
                               std::span<const double> densities, std::span<double> rates, std::span<double> exchange) {
  for (std::size_t s = 0; s < size(); ++s) densities_[s] = densities[s] * scales_[s];
  particles_.sources(gas_.at(T, p, concentrations), densities_, rates, exchange);
  for (std::size_t s = 0; s < size(); ++s) rates[s] /= scales_[s];
}

void ReactorParticles::jacobian(double T, double p, std::span<const double> concentrations,
                                std::span<const double> densities, std::span<double> values) {
  const std::size_t columns = size() + exchanged().size() + 1;
  for (std::size_t s = 0; s < size(); ++s) densities_[s] = densities[s] * scales_[s];
  particles_.jacobian(gas_.at(T, p, concentrations), densities_, {values, columns});
  for (std::size_t r = 0; r + 1 < columns; ++r)
    for (std::size_t s = 0; s < size(); ++s) values[r * columns + s] *= scales_[s];
  for (std::size_t s = 0; s < size(); ++s)
    for (std::size_t c = 0; c < columns; ++c) values[s * columns + c] /= scales_[s];
}

void ReactorParticles::enthalpies(double T, std::span<double> h, std::span<double> slope) {
  particles_.enthalpies(T, h, slope);
  for (std::size_t s = 0; s < size(); ++s) {
    h[s] *= scales_[s];
    slope[s] *= scales_[s];
  }
}

std::vector<std::vector<double>> ReactorParticles::unitElements() const {
  std::vector<std::vector<double>> elements;
  for (const CarriedModel::Scalar& scalar : particles_.scalars()) {
    elements.push_back(scalar.elements);
    for (double& mass : elements.back()) mass *= scalar.scale;
  }
  return elements;
}

}  // namespace lampblack::coupling
