// Puts a model of particles behind what a flame or a flow carries: names of species and elements become indices of the
// mechanism.
#pragma once

#include <memory>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/models/carried_model.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::coupling {

class CarriedParticles final : public CarriedModel {
 public:
  // Owns the model and does not refer to the mechanism afterwards. Without `diffusion` particles move with the gas and
  // by thermophoresis only, as ensembles on their paths do. InputError where the mechanism lacks a species or element
  // that the model needs.
  CarriedParticles(const Mechanism& mechanism, std::unique_ptr<ParticleModel> model, bool diffusion = true);

  [[nodiscard]] const ParticleModel& model() const { return *model_; }

  [[nodiscard]] std::string material() const override { return model_->material(); }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  [[nodiscard]] std::vector<std::vector<double>> gridSums() const override { return model_->gridSums(); }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) override;
  void jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) override;
  ParticleAdvance advance(const CarrierGas& gas, double dt, std::span<double> densities,
                          std::span<double> concentrations, std::span<const double> supply) override;
  [[nodiscard]] bool idle(const ParticleGas& gas, std::span<const double> densities) const override;
  void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) override;
  void enthalpies(double temperature, std::span<double> h, std::span<double> slope) override;
  double absorption(double temperature, std::span<const double> densities) override;
  [[nodiscard]] std::vector<Quantity> properties() const override;
  void evaluateProperties(const ParticleGas& gas, std::span<const double> densities,
                          std::span<double> values) const override;
  [[nodiscard]] double volumeFraction(std::span<const double> densities) const override;
  [[nodiscard]] double volumeFractionAtLimit(std::span<const double> densities) const override;

 private:
  std::unique_ptr<ParticleModel> model_;
  bool diffusion_;
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

}  // namespace lampblack::coupling
