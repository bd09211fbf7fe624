#include "particles/spheres/sphere_aggregate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {

double radiusOfVolume(double volume, std::span<const double> necks, double guess) {
  const auto left = [&](double r, double& slope) {
    double v = volumeOfRadius(r);
    slope = surfaceOfRadius(r);
    for (const double neck : necks) {
      const double x = planeOfNeck(r, neck);
      v -= capVolume(r, x);
      slope += constants::pi * neck * r / x - capSurface(r, x);
    }
    return v;
  };
  double least = 0, slope = 0;
  for (const double neck : necks) least = std::max(least, std::sqrt(neck));
  if (!necks.empty() && !(left(least * (1 + 1e-12), slope) < volume)) return std::numeric_limits<double>::quiet_NaN();
  // The volume rises with the radius: between bounds, else halved.
  double low = least, high = std::max(guess, least) * 2;
  while (left(high, slope) < volume) high *= 2;
  double r = std::clamp(guess, low, high);
  if (!(r > least)) r = 0.5 * (low + high);
  for (int k = 0; k < 100; ++k) {
    const double excess = left(r, slope) - volume;
    (excess > 0 ? high : low) = r;
    double next = r - excess / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - r);
    r = next;
    if (moved <= 4 * std::numeric_limits<double>::epsilon() * r) break;
  }
  return r;
}

SphereAggregate::SphereAggregate(double radius)
    : spheres_{{{}, radius, volumeOfRadius(radius), 0, 0}}, reach_(radius) {}

SphereAggregate::SphereAggregate(std::vector<AggregateSphere> spheres) : spheres_(std::move(spheres)) {
  if (spheres_.empty()) throw InputError("an aggregate needs a sphere");
  for (std::size_t k = 0; k < count(); ++k) {
    const AggregateSphere& s = spheres_[k];
    if (k > 0 && s.parent >= k)
      throw InputError(fmt::format("sphere {}: it has to be joined to one that stands before it", k));
    if (!(s.radius > 0)) throw InputError(fmt::format("sphere {}: its radius has to be positive", k));
    if (k > 0 && !(s.neck >= 0 && std::sqrt(s.neck) < std::min(s.radius, spheres_[s.parent].radius)))
      throw InputError(fmt::format("sphere {}: its neck has to be narrower than both spheres", k));
  }
  std::vector<double> volumes;
  geometricVolumes(volumes);
  for (std::size_t k = 0; k < count(); ++k) {
    if (!(volumes[k] > 0)) throw InputError(fmt::format("sphere {}: its necks leave nothing of it", k));
    spheres_[k].volume = volumes[k];
  }
  place();
}

void SphereAggregate::copy(std::span<const AggregateSphere> spheres) {
  spheres_.assign(spheres.begin(), spheres.end());
  merges_.clear();
  reach_ = 0;
  for (const AggregateSphere& s : spheres_) reach_ = std::max(reach_, length(s.centre) + s.radius);
}

double SphereAggregate::distance(std::size_t k) const {
  const AggregateSphere &s = spheres_[k], &p = spheres_[s.parent];
  return planeOfNeck(s.radius, s.neck) + planeOfNeck(p.radius, s.neck);
}

double SphereAggregate::volume() const {
  double sum = 0;
  for (const AggregateSphere& s : spheres_) sum += s.volume;
  return sum;
}

double SphereAggregate::surface() const {
  double sum = 0;
  for (std::size_t k = 0; k < count(); ++k) {
    const AggregateSphere& s = spheres_[k];
    sum += surfaceOfRadius(s.radius);
    if (k == 0) continue;
    for (const double r : {s.radius, spheres_[s.parent].radius}) sum -= capSurface(r, planeOfNeck(r, s.neck));
  }
  return sum;
}

void SphereAggregate::surfaces(std::vector<SphereSurfaces>& to) const {
  to.resize(count());
  for (std::size_t k = 0; k < count(); ++k) to[k].free = to[k].withNecks = surfaceOfRadius(spheres_[k].radius);
  for (std::size_t k = 1; k < count(); ++k)
    for (const std::size_t i : {k, std::size_t{spheres_[k].parent}}) {
      const double r = spheres_[i].radius, neck = spheres_[k].neck, x = planeOfNeck(r, neck);
      to[i].free -= capSurface(r, x);
      to[i].withNecks += constants::pi * neck * r / x - capSurface(r, x);
    }
}

void SphereAggregate::geometricVolumes(std::vector<double>& to) const {
  to.resize(count());
  for (std::size_t k = 0; k < count(); ++k) to[k] = volumeOfRadius(spheres_[k].radius);
  for (std::size_t k = 1; k < count(); ++k)
    for (const std::size_t i : {k, std::size_t{spheres_[k].parent}})
      to[i] -= capVolume(spheres_[i].radius, planeOfNeck(spheres_[i].radius, spheres_[k].neck));
}

void SphereAggregate::place() {
  // What each has moved by is kept until those that are joined to it have been placed.
  std::vector<Vector3> moved(count(), Vector3{});
  Vector3 centre{};
  double volume = 0;
  for (std::size_t k = 0; k < count(); ++k) {
    AggregateSphere& s = spheres_[k];
    if (k > 0) {
      const AggregateSphere& p = spheres_[s.parent];
      const Vector3 line = difference(s.centre, difference(p.centre, moved[s.parent]));
      const Vector3 placed = sum(p.centre, scaled(line, distance(k) / length(line)));
      moved[k] = difference(placed, s.centre);
      s.centre = placed;
    }
    for (std::size_t d = 0; d < 3; ++d) centre[d] += s.volume * s.centre[d];
    volume += s.volume;
  }
  for (double& c : centre) c /= volume;
  reach_ = 0;
  for (AggregateSphere& s : spheres_) {
    s.centre = difference(s.centre, centre);
    reach_ = std::max(reach_, length(s.centre) + s.radius);
  }
}

}  // namespace lampblack::particles
