// What the tests of trees that break share: soot that breaks, rows of primaries, and how many they become.
#pragma once

#include <cmath>
#include <vector>

#include "particles/trees/tree_population.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {

inline TreeOptions breakingSoot(double factor) {
  SootReactions reactions;
  reactions.soot = threePah();
  reactions.soot.coagulation = false;
  reactions.fragmentation = {true, factor};
  TreeOptions options;
  options.material = sootMaterial(reactions);
  options.size = CollisionSize::volumeToSurface;
  options.coagulation = false;
  return options;
}

inline constexpr TreeUnits unitsOfEach{400000, 20000, 0};

// Equal primaries in a row, in point contact: what it breaks into are rows again.
inline Tree chain(const PrimaryTrees& type, std::size_t count, const TreeUnits& each = unitsOfEach) {
  RandomStream random(1, 2, 3);
  Tree tree = type.make(each);
  for (std::size_t i = 1; i < count; ++i) tree = type.coagulated(std::move(tree), type.make(each), random);
  TreeHead& head = tree.own();
  for (std::uint32_t k = 0; k + 1 < head.count; ++k) {
    necksOf(&head)[k].left = k;
    necksOf(&head)[k].right = k + 1;
  }
  return tree;
}

// Mean number that each row of n primaries has become where w t is `exposure` (kg/m2) and a row breaks at any of its
// necks alike: dN_m/dt = -k_m N_m + sum over n > m of k_n 2/(n - 1) N_n, integrated by the classical Runge-Kutta
// method.
inline double meanNumber(std::size_t n, double exposure, double factor) {
  const auto k = [&](std::size_t m) { return m < 2 ? 0.0 : factor * std::pow(static_cast<double>(m), 1 / 1.8); };
  std::vector<double> N(n + 1);
  N[n] = 1;
  const auto slope = [&](const std::vector<double>& x) {
    std::vector<double> f(n + 1);
    for (std::size_t m = 1; m <= n; ++m) {
      f[m] -= k(m) * x[m];
      for (std::size_t part = 1; part < m; ++part) f[part] += k(m) * x[m] * 2 / static_cast<double>(m - 1);
    }
    return f;
  };
  constexpr int steps = 400;
  const double h = exposure / steps;
  for (int step = 0; step < steps; ++step) {
    const auto moved = [&](const std::vector<double>& f, double by) {
      std::vector<double> x = N;
      for (std::size_t m = 0; m <= n; ++m) x[m] += by * f[m];
      return x;
    };
    const auto a = slope(N), b = slope(moved(a, h / 2)), c = slope(moved(b, h / 2)), d = slope(moved(c, h));
    for (std::size_t m = 0; m <= n; ++m) N[m] += h / 6 * (a[m] + 2 * b[m] + 2 * c[m] + d[m]);
  }
  double sum = 0;
  for (const double x : N) sum += x;
  return sum;
}

}  // namespace lampblack::test
