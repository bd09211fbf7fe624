#include "particles/spheres/sphere_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {
namespace {

constexpr double step = 0.01;  // of a radius, after which one looks for what has merged

void keepDistances(const SphereAggregate& aggregate, std::vector<double>& distances) {
  distances.resize(aggregate.count());
  for (std::size_t k = 1; k < aggregate.count(); ++k) distances[k] = aggregate.distance(k);
}

// Necks of the radii at these distances. Where the plane lies beyond the smaller one's centre it is swallowed: the neck
// is as wide as it, so that it is due.
void widenNecks(SphereAggregate& aggregate, const std::vector<double>& distances) {
  std::vector<AggregateSphere>& spheres = aggregate.change();
  for (std::size_t k = 1; k < spheres.size(); ++k) {
    const double a = spheres[k].radius, b = spheres[spheres[k].parent].radius;
    const double small = std::min(a, b), plane = planeOfNeck(small, std::max(a, b), distances[k]);
    spheres[k].neck = plane > 0 ? std::max(0.0, small * small - plane * plane) : small * small;
  }
}

void takeVolumes(SphereAggregate& aggregate) {
  std::vector<double> volumes;
  aggregate.geometricVolumes(volumes);
  for (std::size_t k = 0; k < volumes.size(); ++k) aggregate.change()[k].volume = volumes[k];
}

void requireGrowth(double amount) {
  if (!(amount >= 0) || !std::isfinite(amount))
    throw InputError("aggregates of spheres grow only: a finite amount that is not negative was expected");
}

}  // namespace

void growEverywhere(SphereAggregate& aggregate, double thickness) {
  requireGrowth(thickness);
  std::vector<double> distances;
  while (thickness > 0) {
    double layer = thickness;
    for (const AggregateSphere& s : aggregate.spheres()) layer = std::min(layer, step * s.radius);
    keepDistances(aggregate, distances);
    for (AggregateSphere& s : aggregate.change()) s.radius += layer;
    widenNecks(aggregate, distances);
    takeVolumes(aggregate);
    if (aggregate.mergeDue() == 0 && thickness == layer) aggregate.place();
    thickness -= layer;
  }
}

std::size_t growSphere(SphereAggregate& aggregate, std::size_t i, double volume) {
  requireGrowth(volume);
  std::vector<double> distances;
  std::vector<SphereSurfaces> surfaces;
  const double tolerance = 8 * std::numeric_limits<double>::epsilon() * aggregate.volume();
  while (volume > tolerance) {
    aggregate.surfaces(surfaces);
    keepDistances(aggregate, distances);
    const double before = aggregate.volume(), largest = step * aggregate.spheres()[i].radius;
    const double wanted = std::min(volume, largest * surfaces[i].free);
    // The volume of all rises by the free surface times the change of the radius.
    double gained = 0;
    const double start = aggregate.spheres()[i].radius;
    for (int k = 0; k < 20 && std::abs(wanted - gained) > 1e-14 * wanted; ++k) {
      aggregate.change()[i].radius += (wanted - gained) / surfaces[i].free;
      widenNecks(aggregate, distances);
      takeVolumes(aggregate);
      gained = aggregate.volume() - before;
      if (std::abs(wanted - gained) <= tolerance) break;
      aggregate.surfaces(surfaces);
      if (!(surfaces[i].free > 0)) break;
    }
    if (!(aggregate.spheres()[i].radius > start)) throw NumericsError("growth of a sphere: its surface vanished");
    volume -= gained;
    if (aggregate.mergeDue(&i) == 0) aggregate.place();
  }
  return i;
}

}  // namespace lampblack::particles
