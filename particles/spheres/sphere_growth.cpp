#include "particles/spheres/sphere_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {
namespace {

constexpr double part = 0.01;  // of a radius, after which one looks for what has merged
// Of a sphere's surface: with less than that it grows as if it had so much.
constexpr double leastOpen = 0.01;

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

void takeVolumes(SphereAggregate& aggregate, std::vector<double>& volumes) {
  aggregate.geometricVolumes(volumes);
  for (std::size_t k = 0; k < volumes.size(); ++k) aggregate.change()[k].volume = volumes[k];
}

void requireGrowth(double amount) {
  if (!(amount >= 0) || !std::isfinite(amount))
    throw InputError("aggregates of spheres grow only: a finite amount that is not negative was expected");
}

}  // namespace

// Each radius by its volume over its surface; what is then missing of the volume of all in the same proportions.
bool SphereGrowth::step(SphereAggregate& aggregate, std::vector<double>& due, std::vector<double>& through) {
  const std::size_t n = aggregate.count();
  std::vector<AggregateSphere>& spheres = aggregate.change();
  through.assign(n, 0.0);
  weights_.resize(n);
  open_.resize(n);
  before_.resize(n);
  double amount = 0;
  for (const double volume : due) amount += std::abs(volume);
  if (!(amount > 0)) return true;
  aggregate.surfaces(surfaces_);
  keepDistances(aggregate, distances_);
  double done = 1, total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const AggregateSphere& s = spheres[i];
    open_[i] = std::max(surfaces_[i].free, leastOpen * surfaceOfRadius(s.radius));
    done = std::min(done, part * s.radius * open_[i] / std::max(std::abs(due[i]), 1e-300));
    weights_[i] = std::abs(due[i]) / amount;
    before_[i] = s.volume;
    total += s.volume;
  }
  const double wanted = done * std::accumulate(due.begin(), due.end(), 0.0);
  const double tolerance = 1e-14 * done * amount + 4 * std::numeric_limits<double>::epsilon() * total;
  for (std::size_t i = 0; i < n; ++i) spheres[i].radius += done * due[i] / open_[i];
  for (int k = 0; k < 40; ++k) {
    widenNecks(aggregate, distances_);
    takeVolumes(aggregate, volumes_);
    double missing = wanted;
    for (std::size_t i = 0; i < n; ++i) missing += before_[i] - volumes_[i];
    if (std::abs(missing) <= tolerance) break;
    for (std::size_t i = 0; i < n; ++i) spheres[i].radius += missing * weights_[i] / open_[i];
  }
  for (std::size_t k = n; k-- > 1;) {
    through[k] += spheres[k].volume - before_[k] - done * due[k];
    through[spheres[k].parent] += through[k];
  }
  through[0] = 0;
  for (double& volume : due) volume *= 1 - done;
  return done == 1;
}

void growEverywhere(SphereAggregate& aggregate, double thickness) {
  requireGrowth(thickness);
  std::vector<double> distances, volumes;
  while (thickness > 0) {
    double layer = thickness;
    for (const AggregateSphere& s : aggregate.spheres()) layer = std::min(layer, part * s.radius);
    keepDistances(aggregate, distances);
    for (AggregateSphere& s : aggregate.change()) s.radius += layer;
    widenNecks(aggregate, distances);
    takeVolumes(aggregate, volumes);
    if (aggregate.mergeDue() == 0 && thickness == layer) aggregate.place();
    thickness -= layer;
  }
}

std::size_t growSphere(SphereAggregate& aggregate, std::size_t i, double volume) {
  requireGrowth(volume);
  SphereGrowth growth;
  std::vector<double> due, through;
  const double tolerance = 8 * std::numeric_limits<double>::epsilon() * aggregate.volume();
  while (volume > tolerance) {
    due.assign(aggregate.count(), 0.0);
    due[i] = volume;
    growth.step(aggregate, due, through);
    volume = due[i];
    if (aggregate.mergeDue(&i) == 0) aggregate.place();
  }
  return i;
}

}  // namespace lampblack::particles
