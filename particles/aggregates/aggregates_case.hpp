// A run of aggregates: spheres, how they become aggregates, the gas around them, how often, and what is looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "particles/aggregates/aggregates_gas.hpp"
#include "particles/trees/tree_options.hpp"

namespace lampblack::particles {

struct AggregatesCase {
  // Clusters of the same number that join in pairs; spheres that join an aggregate one by one; or a population whose
  // particles collide as often as they do in a gas.
  enum class Build { equalPairs, singleSpheres, collisions };

  std::string title;
  Build build = Build::equalPairs;
  double radius = 0, deviation = 1;  // m, median of the spheres at the start, geometric standard deviation
  std::size_t doublings = 0, spheres = 0, aggregates = 0;
  double number = 0;       // 1/m3, of spheres at the start, of collisions
  TreeOptions population;  // also of the law of sintering
  AggregatesGas gas;
  double birthDiameter = 0;   // m
  std::vector<double> times;  // s, of rows: the first is zero
  std::size_t fitFrom = 0;    // fewest spheres of an aggregate in the fit of the fractal law
  std::size_t directions = 0, drawn = 0;
  std::uint64_t repeats = 0, seed = 0;

  // Numbers of spheres with a row while aggregates are built, before the times.
  [[nodiscard]] std::vector<std::size_t> sizes() const;
  [[nodiscard]] std::size_t rows() const {
    return times.size() + (build == Build::collisions ? 0 : sizes().size() - 1);
  }
  [[nodiscard]] double timeOf(std::size_t row) const {
    return row + times.size() < rows() ? 0 : times[row + times.size() - rows()];
  }
};

}  // namespace lampblack::particles
