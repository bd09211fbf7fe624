// What is asked of a store of particles with one weight.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/store_operations.hpp"

namespace lampblack::particles {

// M_0 to M_3 of a sample.
template <class Store>
[[nodiscard]] std::array<double, 4> sampleMoments(const Store& store, double weight) {
  // Partial sums in one vector register each.
  constexpr std::size_t lanes = 8;
  struct Lanes {
    using Register [[gnu::vector_size(lanes * sizeof(double))]] = double;
    Register x{};
  };
  Lanes first, second, third;
  const auto& type = store.rates().type();
  store_operations::forEachRun(store, [&](auto run) {
    std::size_t k = 0;
    for (; k + lanes <= run.size(); k += lanes) {
      Lanes v;
      for (std::size_t lane = 0; lane < lanes; ++lane) v.x[lane] = type.volume(run[k + lane].particle);
      const Lanes square{v.x * v.x};
      first.x += v.x;
      second.x += square.x;
      third.x += square.x * v.x;
    }
    for (; k < run.size(); ++k) {
      const double v = type.volume(run[k].particle);
      first.x[k % lanes] += v;
      second.x[k % lanes] += v * v;
      third.x[k % lanes] += v * v * v;
    }
  });
  std::array<double, 4> moments{weight * static_cast<double>(store.size()), 0, 0, 0};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    moments[1] += weight * first.x[lane];
    moments[2] += weight * second.x[lane];
    moments[3] += weight * third.x[lane];
  }
  return moments;
}

// Number (1/m3) in each [edges[k], edges[k+1]) of volume.
template <class Store>
[[nodiscard]] std::vector<double> sampleInBins(const Store& store, double weight, std::span<const double> edges) {
  std::vector<double> bins(edges.size() < 2 ? 0 : edges.size() - 1);
  const auto& type = store.rates().type();
  store.forEach([&](const auto& entry) {
    const auto bin = std::upper_bound(edges.begin(), edges.end(), type.volume(entry.particle)) - edges.begin();
    if (bin > 0 && static_cast<std::size_t>(bin) <= bins.size()) bins[static_cast<std::size_t>(bin) - 1] += weight;
  });
  return bins;
}

// exp of the standard deviation of log(diameter(entry)); 1 for fewer than two.
template <class Store, class Diameter>
[[nodiscard]] double sampleGeometricDeviation(const Store& store, Diameter diameter) {
  if (store.size() < 2) return 1;
  const double count = static_cast<double>(store.size());
  double sum = 0, squares = 0;
  store.forEach([&](const auto& entry) { sum += std::log(diameter(entry)); });
  const double mean = sum / count;
  store.forEach([&](const auto& entry) {
    const double deviation = std::log(diameter(entry)) - mean;
    squares += deviation * deviation;
  });
  return std::exp(std::sqrt(squares / count));
}

}  // namespace lampblack::particles
