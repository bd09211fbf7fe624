// Moments and distributions of numerical particles with different weights.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/compensated_sum.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"

namespace lampblack::particles {

// M_0 to M_3, sums of w v^k (m^(3k-3)). The sums do not lose to rounding: M_1 has to stay put over a long run.
template <class Type, class Store>
[[nodiscard]] std::array<double, 4> weightedMoments(const Type& type, const Store& store) {
  std::array<CompensatedSum, 4> sums;
  store.forEach([&](const auto& entry) {
    const double v = type.volume(entry.particle);
    double term = entry.weight;
    for (CompensatedSum& sum : sums) {
      sum.add(term);
      term *= v;
    }
  });
  return {sums[0].value(), sums[1].value(), sums[2].value(), sums[3].value()};
}

// Number (1/m3) with a volume in each [edges[k], edges[k+1]).
template <class Type, class Store>
[[nodiscard]] std::vector<double> weightedInBins(const Type& type, const Store& store, std::span<const double> edges) {
  std::vector<double> number(edges.empty() ? 0 : edges.size() - 1, 0.0);
  store.forEach([&](const auto& entry) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), type.volume(entry.particle));
    if (above == edges.begin() || above == edges.end()) return;
    number[static_cast<std::size_t>(above - edges.begin()) - 1] += entry.weight;
  });
  return number;
}

// Geometric standard deviation of the diameter by number; 1 for fewer than two particles.
template <class Type, class Store>
[[nodiscard]] double weightedGeometricDeviation(const Type& type, const Store& store) {
  WeightedDeviation deviation;
  store.forEach(
      [&](const auto& entry) { deviation.add(std::log(type.collisionDiameter(entry.particle)), entry.weight); });
  return deviation.geometric();
}

}  // namespace lampblack::particles
