// Transfers species, mass and enthalpy between the gas of a cell and the particles in it.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class GasExchange {
 public:
  explicit GasExchange(const FlowContext& context)
      : context_(context), partialDensity_(context.mechanism.numSpecies()) {}

  // Adds `change` (mol/m3) of the species (by number in the mechanism) to the gas of an owned cell at constant volume,
  // and removes `heat` (J/m3). A change of zero leaves every bit as it is.
  void recordExchange(State& state, int cell, std::span<const std::size_t> species, std::span<const double> change,
                      double heat);

 private:
  const FlowContext& context_;
  std::vector<double> partialDensity_;
};

}  // namespace lampblack::flow
