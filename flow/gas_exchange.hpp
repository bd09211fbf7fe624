// What the gas of a cell gives to and gets from what it carries, booked at once: species, mass, enthalpy.
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

  // Adds `change` (mol/m3) of the species (by number in the mechanism) to the gas of an owned cell, whose volume does
  // not change, and takes `heat` (J/m3) from it; what changes it not at all leaves its bits.
  void book(State& state, int cell, std::span<const std::size_t> species, std::span<const double> change, double heat);

 private:
  const FlowContext& context_;
  std::vector<double> partialDensity_;
};

}  // namespace lampblack::flow
