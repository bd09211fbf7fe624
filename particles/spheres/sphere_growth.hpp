// Growth of an aggregate on its free surface and its loss by burning, centres of spheres at rest: necks widen or
// narrow, and spheres that another has swallowed are merged. Where spheres would lose contact they follow, in point
// contact. docs/theory/spheres.md.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/spheres/sphere_aggregate.hpp"

namespace lampblack::particles {

// A volume for each sphere, put on or taken from its free surface by steps of 1 % of a radius.
class SphereGrowth {
 public:
  // One step. `due` (m3, of each sphere, of either sign) becomes what is left of it. `through` is set to the volume
  // that each sphere has gained from its parent, as the plane between them moved. The volume of all changes by what is
  // no longer due, to round-off. Returns whether nothing is due. Merging and place() are left to the caller.
  bool step(SphereAggregate& aggregate, std::vector<double>& due, std::vector<double>& through);

 private:
  std::vector<double> distances_, before_, weights_, open_, volumes_;
  std::vector<SphereSurfaces> surfaces_;
};

// A layer of a thickness >= 0 on all of the free surface. InputError.
void growEverywhere(SphereAggregate& aggregate, double thickness);
// A volume >= 0 on the free surface of sphere i, which is where it returns: it may have merged. InputError.
std::size_t growSphere(SphereAggregate& aggregate, std::size_t i, double volume);

}  // namespace lampblack::particles
