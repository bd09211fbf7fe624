// Growth of an aggregate on its free surface, centres of spheres at rest: necks widen, and spheres that another has
// swallowed are merged. docs/theory/spheres.md.
#pragma once

#include <cstddef>

#include "core/modules.hpp"
#include "particles/spheres/sphere_aggregate.hpp"

namespace lampblack::particles {

// A layer of a thickness >= 0 on all of the free surface. InputError.
void growEverywhere(SphereAggregate& aggregate, double thickness);
// A volume >= 0 on the free surface of sphere i, which is where it returns: it may have merged. InputError.
std::size_t growSphere(SphereAggregate& aggregate, std::size_t i, double volume);

}  // namespace lampblack::particles
