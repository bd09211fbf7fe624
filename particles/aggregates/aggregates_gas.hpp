// The gas that aggregates of spheres are in, and what it does to them besides collisions: constant, or of a table.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"

namespace lampblack::particles {

// Rows in time, linear in between and constant outside; one where nothing changes.
struct AggregatesGas {
  std::vector<double> time, temperature, pressure;  // s, K, Pa
  std::vector<double> births, growth;               // 1/m3/s; m/s, by which the free surface moves outward

  // At a time. The viscosity is that of air, and so is the mean molar mass.
  [[nodiscard]] CarrierGas at(double when) const;
  [[nodiscard]] double birthsAt(double when) const { return valueAt(births, when); }
  [[nodiscard]] double growthAt(double when) const { return valueAt(growth, when); }
  // The next row after a time, at which slopes change; infinity behind the last.
  [[nodiscard]] double nextChange(double when) const;

 private:
  [[nodiscard]] double valueAt(const std::vector<double>& values, double when) const;
};

}  // namespace lampblack::particles
