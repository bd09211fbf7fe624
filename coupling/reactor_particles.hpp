// Puts a model of particles behind what the equations of a reactor carry: unknowns in units of the scalars' typical
// amounts, and the gas at a state of a reactor as the particles see it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "chemistry/reactor/carried_phase.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/air.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"

namespace lampblack::coupling {

// Of the gas as particles see it: from transport data; or that of air (viscosityOfAir), for mechanisms without.
enum class GasViscosity { transport, air };

// The gas of a reactor at a state of it: all concentrations, and those that particles see.
class ReactorGas {
 public:
  // `species`: of a ParticleGas, by number. The mechanism has to live as long. InputError without transport data, where
  // the viscosity comes from them.
  ReactorGas(const Mechanism& mechanism, std::vector<std::size_t> species,
             GasViscosity viscosity = GasViscosity::transport);

  // What particles see at concentrations (mol/m3) of all species; good until the next call.
  const ParticleGas& at(double T, double p, std::span<const double> concentrations);
  // The same at mass fractions Y, whose sum does not matter.
  const ParticleGas& atComposition(double T, double p, std::span<const double> Y);

 private:
  std::vector<double> weights_;  // kg/mol
  std::vector<std::size_t> species_;
  std::optional<Transport> transport_;
  std::vector<double> all_, X_, D_, seen_;
  ParticleGas gas_;
};

class ReactorParticles final : public CarriedPhase {
 public:
  // Both have to live as long. InputError as ReactorGas.
  ReactorParticles(const Mechanism& mechanism, CarriedParticles& particles);

  [[nodiscard]] const CarriedParticles& particles() const { return particles_; }
  ReactorGas& gas() { return gas_; }

  [[nodiscard]] std::size_t size() const override { return scales_.size(); }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return particles_.exchanged(); }
  void sources(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
               std::span<double> rates, std::span<double> exchange) override;
  void jacobian(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
                std::span<double> values) override;
  void enthalpies(double T, std::span<double> h, std::span<double> slope) override;

  // Amounts per m3 in the model's units from those of the unknowns, `density` (kg/m3) being that of gas and particles.
  void densities(double density, std::span<const double> amounts, std::span<double> out) const;
  // The reverse of it.
  void amounts(double density, std::span<const double> densities, std::span<double> out) const;
  // kg of each element of the mechanism in a unit of each amount.
  [[nodiscard]] std::vector<std::vector<double>> unitElements() const;

 private:
  CarriedParticles& particles_;
  std::vector<double> scales_;
  ReactorGas gas_;
  std::vector<double> densities_;
};

}  // namespace lampblack::coupling
