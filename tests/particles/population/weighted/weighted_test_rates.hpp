// Rates for tests of the sorted store: entries with a volume, a weight and a tag that has to travel with them.
#pragma once

#include <algorithm>
#include <cmath>

#include "particles/population/monte_carlo/sorted_store.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// (u^1/3 + v^1/3)^2 sqrt(1/u + 1/v), the shape of the free-molecular kernel, times max(w, w'), or the constant kernel;
// two single processes.
template <bool plain>
struct WeightedTestRates {
  struct Tagged {
    double volume = 1;
    int tag = 0;
  };
  struct Bare {
    double volume = 1;
  };
  using Particle = std::conditional_t<plain, Bare, Tagged>;
  struct Entry {
    Particle particle;
    double weight = 1;
  };
  static constexpr bool weighted = true, bare = plain;
  bool relative = true, constantKernel = false;

  [[nodiscard]] double volume(const Entry& e) const { return e.particle.volume; }
  [[nodiscard]] double weight(const Entry& e) const { return e.weight; }
  [[nodiscard]] Entry entry(double v, double w) const {
    Entry e;
    e.particle.volume = v;
    e.weight = w;
    return e;
  }
  [[nodiscard]] std::size_t rank() const { return constantKernel ? 1 : 2; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry& e) const {
    if (constantKernel) return {{0.5}, {1}};
    const double d = std::cbrt(e.particle.volume), root = 1 / std::sqrt(e.particle.volume);
    return {{2 * d * d * root, 2 * d * d}, {1, root}};
  }
  [[nodiscard]] double kernel(const Entry& i, const Entry& j) const {
    if (constantKernel) return 1;
    const double u = i.particle.volume, v = j.particle.volume, sum = std::cbrt(u) + std::cbrt(v);
    return sum * sum * std::sqrt(1 / u + 1 / v);
  }
  [[nodiscard]] double weightFactor() const { return 1; }
  [[nodiscard]] double weightPart(const Entry& i, const Entry& j) const { return std::max(i.weight, j.weight); }
  [[nodiscard]] double pair(const Entry& i, const Entry& j) const { return weightPart(i, j) * kernel(i, j); }
  [[nodiscard]] bool accepts(const Entry& i, const Entry& j, double majorant, double u) const {
    return pair(i, j) > u * (i.weight + j.weight) * majorant;
  }
  [[nodiscard]] double single(SingleProcess process, const Entry& e) const {
    return process == SingleProcess::breakage ? e.particle.volume * e.particle.volume : 3;
  }
  [[nodiscard]] bool active(SingleProcess process) const { return process != SingleProcess::condensation; }
  [[nodiscard]] bool relativeDifference() const { return relative; }
  [[nodiscard]] bool merges() const { return true; }
  [[nodiscard]] bool keepsHeaviest() const { return true; }
  [[nodiscard]] bool monotone() const { return plain; }
};

}  // namespace lampblack::test
