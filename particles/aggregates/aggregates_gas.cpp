#include "particles/aggregates/aggregates_gas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/air.hpp"
#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

constexpr double airWeight = 0.02897;  // kg/mol

}  // namespace

double AggregatesGas::valueAt(const std::vector<double>& values, double when) const {
  const auto k = static_cast<std::size_t>(std::ranges::upper_bound(time, when) - time.begin());
  if (k == 0) return values.front();
  if (k == time.size()) return values.back();
  const double part = (when - time[k - 1]) / (time[k] - time[k - 1]);
  return values[k - 1] + part * (values[k] - values[k - 1]);
}

double AggregatesGas::nextChange(double when) const {
  const auto next = std::ranges::upper_bound(time, when);
  return next == time.end() ? std::numeric_limits<double>::infinity() : *next;
}

CarrierGas AggregatesGas::at(double when) const {
  CarrierGas gas;
  gas.temperature = valueAt(temperature, when);
  gas.pressure = valueAt(pressure, when);
  gas.meanMolecularWeight = airWeight;
  gas.density = gas.pressure * airWeight / (constants::gasConstant * gas.temperature);
  gas.viscosity = viscosityOfAir(gas.temperature);
  return gas;
}

}  // namespace lampblack::particles
