// Transport and thermodynamic properties of the gas in every local cell, halo included.
#pragma once

#include <vector>

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

  // Evaluates all of it from the state's T, Y and density. Mass fractions below zero, which advection may leave at the
  // size of its error, count as zero here.
  void update(const FlowContext& context, const State& state);

 private:
  std::vector<double> X_;
};

}  // namespace lampblack::flow
