// Numbers of clusters of k equal particles, and their sums over a range of k.
#pragma once

#include "core/modules.hpp"

namespace lampblack::particles::exact {

// Sum over lower <= k < upper of (tau/2)^(k-1) / (1 + tau/2)^(k+1).
[[nodiscard]] double geometricClusters(double tau, double lower, double upper);

// factor k^(k-1) t^(k-1) exp(-k t) / k! (power 3/2) or the same over k (power 5/2): what a branching process with a
// mean of t children leaves (Borel 1942). `rest` is 1 - t with its own digits.
struct Borel {
  double factor, power, t, rest;
};
[[nodiscard]] double borelClusters(const Borel& law, double lower, double upper);

}  // namespace lampblack::particles::exact
