// What is said of aggregates of spheres together: means over them, and their fractal law.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "core/random.hpp"
#include "particles/spheres/sphere_aggregate.hpp"
#include "particles/spheres/sphere_measures.hpp"

namespace lampblack::particles {

inline constexpr double nothingToSay = std::numeric_limits<double>::quiet_NaN();

// What a population says besides its aggregates.
struct AggregatePopulation {
  double number = nothingToSay, collisionDiameter = nothingToSay, tries = nothingToSay, merged = 0;
};

// How they are looked at.
struct AggregateLook {
  std::size_t fitFrom = 0;     // fewest spheres of an aggregate in the fit of the fractal law
  std::size_t directions = 0;  // from which the shadow of each is measured
};

// What a row has, in this order; NaN where a population does not have it.
[[nodiscard]] const std::vector<Quantity>& aggregateQuantities();
// Of `all`, one at least; those with enough spheres go into the law too.
void describeAggregates(const std::vector<const SphereAggregate*>& all, const AggregateLook& look,
                        const AggregatePopulation& population, FractalPoints& law, RandomStream& random,
                        std::span<double> row);

}  // namespace lampblack::particles
