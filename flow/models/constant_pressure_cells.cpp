#include "flow/models/constant_pressure_cells.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/group_failure.hpp"

namespace lampblack::flow {

void ConstantPressureCells::advance(std::span<const Cell> cells, double dt, std::span<Result> results) {
  cells_.resize(cells.size());
  found_.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [gas, Y, source] = cells[i];
    try {
      const double temperature = thermo_.temperatureFromEnthalpy(gas.enthalpy, Y, gas.temperature);
      cells_[i] = {temperature, gas.pressure, Y, source, gas.firstStep, gas.heating, gas.mixing.reactingShare};
    } catch (const NumericsError& error) {
      throw FailureInGroup(error.what(), i);
    }
  }
  reactor_.advance(cells_, dt, found_);
  for (std::size_t i = 0; i < cells.size(); ++i)
    results[i] = {cells_[i].temperature,
                  cells_[i].initialStep,
                  found_[i].work,
                  static_cast<double>(found_[i].steps),
                  static_cast<double>(found_[i].retries),
                  found_[i].skipped ? 1.0 : 0.0,
                  found_[i].handedOver ? 1.0 : 0.0};
}

void ConstantPressureCells::rates(std::span<const Asked> cells) {
  for (const Asked& cell : cells) findRates(cell);
}

void ConstantPressureCells::findRates(const Asked& cell) {
  const auto& [gas, Y, rates] = cell;
  std::ranges::copy(Y, y_.begin());
  y_.back() = gas.temperature;
  system_.setConditions(gas.pressure, {}, 0.0, gas.mixing.reactingShare);
  const bool isThere = rates.slopes.empty() ? system_.chemicalRates(y_.data(), f_.data())
                                            : system_.jacobian(y_.data(), f_.data(), rates.slopes.data(), y_.size());
  if (!isThere) throw NumericsError("the reactions have no rates: " + system_.refusal());
  std::copy_n(f_.begin(), rates.values.size(), rates.values.begin());
}

}  // namespace lampblack::flow
