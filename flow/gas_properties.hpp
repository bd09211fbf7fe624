// Transport and thermodynamic properties of the gas in every local cell, halo included.
#pragma once

#include <optional>
#include <vector>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "core/rooms.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct GasProperties {
  std::vector<double> viscosity;        // Pa s
  std::vector<double> conductivity;     // W/m/K
  std::vector<double> heatCapacity;     // J/kg/K
  std::vector<double> molecularWeight;  // kg/mol, of the mixture
  std::vector<double> massDiffusivity;  // kg/m/s, density times mixture-averaged coefficient, species a cell

  std::vector<double> thermalDiffusion;  // kg/m/s, species a cell; empty without the Soret effect

  // Evaluates all of it from the state's T, Y and density. Mass fractions below zero, which advection may leave at the
  // size of its error, count as zero here.
  void update(const FlowContext& context, const State& state);

 private:
  std::optional<MulticomponentTransport> multicomponent_;
  std::vector<double> X_, DT_;
};

}  // namespace lampblack::flow
