// A model of soot that each particle of an engine's gas carries: its scalars per kg of gas, and its reactions with that
// gas.
#pragma once

#include <mpi.h>

#include <vector>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/engine/engine_carried.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "coupling/reactor_particles.hpp"

namespace lampblack::coupling {

// Each particle of gas with soot, or what it may come from, is the closed reactor of constant pressure that
// `problem: reactor` has, for the length of a step. Its enthalpy is kept to round-off, elements as the integrator keeps
// linear invariants. The ranks share the particles of gas, and all have the result.
class EngineSoot final : public EngineCarried {
 public:
  // All have to live as long. InputError without transport data.
  EngineSoot(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, CarriedParticles& particles,
             const ConstantPressureReactor::Options& tolerances);

  [[nodiscard]] std::size_t size() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::vector<double>>& unitElements() const override { return elements_; }
  Work react(double duration, EngineGas& gas, std::vector<char>& isDone) override;

 private:
  // Of one particle of gas, to a row of zeros: one, the factor of its mass, temperature, enthalpy given (J/kg of the
  // gas before), steps, mass fractions, amounts. Left as it is where there is no soot.
  void reactOne(double duration, const EngineGas& gas, std::size_t i, std::span<double> row);
  // J a kg of gas, of amounts in it.
  [[nodiscard]] double enthalpyOf(double T, std::span<const double> amounts);

  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  const Thermo& thermo_;
  CarriedParticles& particles_;
  ReactorParticles phase_;
  std::size_t scalars_;
  std::vector<std::vector<double>> elements_;  // kg in a unit of each scalar
  std::vector<double> unitMass_;               // kg, all of them
  std::vector<double> formation_;              // J/kg at 298.15 K
  ClosedReactor reactor_;
  StiffIntegrator integrator_;
  GasState start_;
  std::vector<double> rows_, densities_, enthalpy_, slope_;
};

}  // namespace lampblack::coupling
