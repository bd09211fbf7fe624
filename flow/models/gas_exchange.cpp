#include "flow/models/gas_exchange.hpp"

namespace lampblack::flow {

void GasExchange::recordExchange(State& state, int cell, std::span<const std::size_t> species,
                                 std::span<const double> change, double heat) {
  const auto n = static_cast<std::size_t>(state.species);
  double* Y = &state.Y[static_cast<std::size_t>(cell) * n];
  const auto W = context_.mechanism.molecularWeights();
  const double rho = state.density[cell];
  bool isChanged = false;
  for (std::size_t k = 0; k < n; ++k) partialDensity_[k] = rho * Y[k];
  for (std::size_t i = 0; i < species.size(); ++i) {
    if (change[i] == 0.0) continue;
    partialDensity_[species[i]] += change[i] * W[species[i]];
    isChanged = true;
  }
  if (!isChanged && heat == 0.0) return;

  double mass = 0.0;
  for (std::size_t k = 0; k < n; ++k) mass += partialDensity_[k];
  for (std::size_t k = 0; k < n; ++k) Y[k] = partialDensity_[k] / mass;
  state.enthalpy[cell] = (rho * state.enthalpy[cell] - heat) / mass;
  state.density[cell] = mass;
  state.temperature[cell] =
      context_.thermo.temperatureFromEnthalpy(state.enthalpy[cell], {Y, n}, state.temperature[cell]);
}

}  // namespace lampblack::flow
