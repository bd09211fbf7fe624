// Spheres of an aggregate that have become one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "particles/spheres/sphere_aggregate.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {

void SphereAggregate::merge(std::size_t k) {
  const AggregateSphere gone = spheres_[k];
  const std::size_t i = gone.parent;
  spheres_.erase(spheres_.begin() + static_cast<std::ptrdiff_t>(k));
  merges_.push_back({i, k});
  AggregateSphere& one = spheres_[i];
  const double volume = one.volume + gone.volume;
  for (std::size_t d = 0; d < 3; ++d)
    one.centre[d] = (one.volume * one.centre[d] + gone.volume * gone.centre[d]) / volume;
  one.volume = volume;
  std::vector<double> necks;
  for (std::size_t c = 1; c < count(); ++c) {
    AggregateSphere& s = spheres_[c];
    if (c >= k && s.parent == k)
      s.parent = static_cast<std::uint32_t>(i);
    else if (c >= k && s.parent > k)
      --s.parent;
    if (c == i || s.parent == i) necks.push_back(s.neck);
  }
  one.radius = radiusOfVolume(volume, necks, std::max(one.radius, gone.radius));
  // Too little for its necks: hardly wider than the widest, which is due then.
  constexpr double hardlyWider = 1 + 1e-9;
  if (!(one.radius > 0)) one.radius = hardlyWider * std::sqrt(*std::ranges::max_element(necks));
}

std::size_t SphereAggregate::widestNeckOf(std::size_t i) const {
  std::size_t found = 0;
  for (std::size_t c = 1; c < count(); ++c)
    if ((c == i || spheres_[c].parent == i) && (found == 0 || spheres_[c].neck > spheres_[found].neck)) found = c;
  return found;
}

std::size_t SphereAggregate::dueNeck(std::vector<SphereSurfaces>& surfaces) const {
  for (std::size_t k = 1; k < count(); ++k) {
    const double smaller = std::min(spheres_[k].radius, spheres_[spheres_[k].parent].radius);
    if (spheres_[k].neck >= widest * widest * smaller * smaller) return k;
  }
  this->surfaces(surfaces);
  for (std::size_t i = 0; i < count(); ++i)
    if (!(surfaces[i].free > 0)) return widestNeckOf(i);
  return 0;
}

void SphereAggregate::mergeWithParent(std::size_t k) {
  place();
  merge(k);
}

std::size_t SphereAggregate::mergeDue(std::size_t* followed) {
  std::vector<SphereSurfaces> surfaces;
  const std::size_t before = count();
  for (std::size_t k = dueNeck(surfaces); k != 0; k = dueNeck(surfaces)) {
    if (followed != nullptr && *followed >= k) *followed = *followed == k ? spheres_[k].parent : *followed - 1;
    mergeWithParent(k);
  }
  if (count() != before) place();
  return before - count();
}

}  // namespace lampblack::particles
