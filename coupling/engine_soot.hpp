// A model of soot that each particle of an engine's gas carries: its scalars per kg of gas, and what they exchange with
// that gas.
#pragma once

#include <mpi.h>

#include <vector>

#include "chemistry/reactor/engine/engine_carried.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "coupling/reactor_particles.hpp"

namespace lampblack::coupling {

// Elements of gas and scalars are kept to round-off, and so is their enthalpy, what was exchanged being as warm as the
// gas. The ranks share the particles of gas, and all have the result.
class EngineSoot final : public EngineCarried {
 public:
  // All have to live as long. InputError without transport data.
  EngineSoot(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, CarriedParticles& particles);

  [[nodiscard]] std::size_t size() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::vector<double>>& unitElements() const override { return elements_; }
  double advance(double duration, EngineGas& gas) override;

 private:
  // Of one particle of gas, to a row of zeros: one, the factor of its mass, temperature, enthalpy given (J/kg of the
  // gas before), mass fractions, amounts. Left as it is where nothing changes.
  void advanceOne(double duration, const EngineGas& gas, std::size_t i, std::span<double> row);
  // What a model's numerical Jacobian leaves of the elements goes to the exchanged species: the change that is least
  // over the concentrations. `before`: densities, then concentrations.
  void keepElements(std::span<const double> before);

  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  const Thermo& thermo_;
  CarriedParticles& particles_;
  ReactorGas seen_;
  std::size_t scalars_;
  std::vector<double> weights_;                // kg/mol, of the exchanged species
  std::vector<std::vector<double>> elements_;  // kg in a unit of each scalar
  std::vector<std::vector<double>> atoms_;     // of each element in the exchanged species
  std::vector<double> atomicWeights_;          // kg/mol
  std::vector<double> before_, rows_, densities_, concentrations_, enthalpy_, slope_, matrix_, weight_;
};

}  // namespace lampblack::coupling
