// Aggregates of the tests, in radii of their first sphere.
#pragma once

#include <cmath>
#include <vector>

#include "particles/spheres/ballistic_joining.hpp"
#include "particles/spheres/sphere_aggregate.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Two spheres whose planes lie where a neck of this radius puts them.
inline particles::SphereAggregate pairOfSpheres(double first, double second, double neck) {
  return particles::SphereAggregate({{{0, 0, 0}, first, 0, 0, 0}, {{0.6, 0, 0.8}, second, 0, neck * neck, 0}});
}

// Equal spheres one behind the other along a line that bends.
inline particles::SphereAggregate chainOfSpheres(std::size_t count, double neck) {
  std::vector<particles::AggregateSphere> spheres{{{0, 0, 0}, 1, 0, 0, 0}};
  for (std::size_t k = 1; k < count; ++k) {
    const double angle = 0.3 * static_cast<double>(k % 7);
    const Vector3& last = spheres.back().centre;
    spheres.push_back(
        {sum(last, {std::cos(angle), std::sin(angle), 0.2}), 1, 0, neck * neck, static_cast<std::uint32_t>(k - 1)});
  }
  return particles::SphereAggregate(spheres);
}

// Grown by joining equal pairs, 2^doublings spheres.
inline particles::SphereAggregate ballisticAggregate(int doublings, std::uint64_t seed) {
  RandomStream random(seed, 0, 1);
  particles::BallisticJoining joining;
  particles::SphereAggregate one(1.0);
  for (int k = 0; k < doublings; ++k) one = joining.join(one, one, random);
  return one;
}

// Distances of centres are those of radii and necks, volumes those of the geometry, the centre of mass is zero.
inline double largestMismatch(const particles::SphereAggregate& aggregate) {
  double worst = 0;
  std::vector<double> volumes;
  aggregate.geometricVolumes(volumes);
  Vector3 centre{};
  for (std::size_t k = 0; k < aggregate.count(); ++k) {
    const particles::AggregateSphere& s = aggregate.spheres()[k];
    worst = std::max(worst, std::abs(volumes[k] / s.volume - 1));
    centre = sum(centre, scaled(s.centre, s.volume / aggregate.volume()));
    worst = std::max(worst, (length(s.centre) + s.radius) / aggregate.reach() - 1);
    if (k == 0) continue;
    const double apart = length(difference(s.centre, aggregate.spheres()[s.parent].centre));
    worst = std::max(worst, std::abs(apart / aggregate.distance(k) - 1));
  }
  return std::max(worst, length(centre) / aggregate.reach());
}

}  // namespace lampblack::test
