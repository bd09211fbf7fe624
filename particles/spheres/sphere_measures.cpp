#include "particles/spheres/sphere_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/constants.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {

double gyrationSquared(const SphereAggregate& aggregate) {
  const auto spheres = aggregate.spheres();
  // Integrals over each cut sphere, about its own centre, put together about the origin.
  double volume = 0, second = 0;
  Vector3 first{};
  const auto add = [&](const Vector3& centre, double v, const Vector3& towards, double own1, double own2) {
    volume += v;
    second += v * dot(centre, centre) + 2 * own1 * dot(centre, towards) + own2;
    for (std::size_t d = 0; d < 3; ++d) first[d] += v * centre[d] + own1 * towards[d];
  };
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const AggregateSphere& s = spheres[k];
    const double v = volumeOfRadius(s.radius);
    add(s.centre, v, {}, 0, 0.6 * v * s.radius * s.radius);
    if (k == 0) continue;
    const AggregateSphere& p = spheres[s.parent];
    const Vector3 line = difference(p.centre, s.centre);
    const Vector3 towards = scaled(line, 1 / length(line));
    const double x = planeOfNeck(s.radius, s.neck), y = planeOfNeck(p.radius, s.neck);
    add(s.centre, -capVolume(s.radius, x), towards, -capFirstMoment(s.radius, x), -capSecondMoment(s.radius, x));
    add(p.centre, -capVolume(p.radius, y), towards, capFirstMoment(p.radius, y), -capSecondMoment(p.radius, y));
  }
  return (second - dot(first, first) / volume) / volume;
}

double gyrationSquaredOfPoints(const SphereAggregate& aggregate) {
  double volume = 0, second = 0;
  for (const AggregateSphere& s : aggregate.spheres()) {  // from the centre of mass
    volume += s.volume;
    second += s.volume * dot(s.centre, s.centre);
  }
  return second / volume;
}

double meanRadius(const SphereAggregate& aggregate) {
  double sum = 0;
  for (const AggregateSphere& s : aggregate.spheres()) sum += s.radius;
  return sum / static_cast<double>(aggregate.count());
}

double coordination(const SphereAggregate& aggregate) {
  const auto n = static_cast<double>(aggregate.count());
  return 2 * (n - 1) / n;
}

double maximumLength(const SphereAggregate& aggregate) {
  const auto spheres = aggregate.spheres();
  double longest = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      longest = std::max(
          longest, length(difference(spheres[i].centre, spheres[j].centre)) + spheres[i].radius + spheres[j].radius);
  return longest;
}

double uncountedOverlap(const SphereAggregate& aggregate) {
  const auto spheres = aggregate.spheres();
  double volume = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (spheres[i].parent == j) continue;
      const double both = spheres[i].radius + spheres[j].radius;
      const Vector3 line = difference(spheres[i].centre, spheres[j].centre);
      if (dot(line, line) < both * both) volume += lensVolume(spheres[i].radius, spheres[j].radius, length(line));
    }
  return volume;
}

double shadowAlongAxes(const SphereAggregate& aggregate) {
  std::vector<RigidSphere> discs(aggregate.count());
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const AggregateSphere& s = aggregate.spheres()[i];
      discs[i] = {{s.centre[axis], s.centre[(axis + 1) % 3], 0}, s.radius};
    }
    sum += coveredArea(discs);
  }
  return sum / 3;
}

double projectedArea(const SphereAggregate& aggregate, std::size_t directions, RandomStream& random) {
  std::vector<RigidSphere> discs(aggregate.count());
  double sum = 0;
  for (std::size_t k = 0; k < directions; ++k) {
    const Rotation by = randomRotation(random);
    for (std::size_t i = 0; i < discs.size(); ++i)
      discs[i] = {turned(by, aggregate.spheres()[i].centre), aggregate.spheres()[i].radius};
    sum += coveredArea(discs);
  }
  return sum / static_cast<double>(directions);
}

double shadowDiameter(double area) {
  return std::sqrt(4 * area / constants::pi);
}

void FractalPoints::add(double number, double gyrationOverRadius, double weight) {
  const double x = std::log(number), y = std::log(gyrationOverRadius);
  smallest_ = count_ == 0 ? number : std::min(smallest_, number);
  largest_ = std::max(largest_, number);
  ++count_;
  weight_ += weight;
  x_ += weight * x;
  y_ += weight * y;
  xx_ += weight * x * x;
  xy_ += weight * x * y;
  yy_ += weight * y * y;
}

FractalFit FractalPoints::fit() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double x = x_ / weight_, y = y_ / weight_;
  const double xx = xx_ / weight_ - x * x, xy = xy_ / weight_ - x * y, yy = yy_ / weight_ - y * y;
  if (count_ < 3 || !(largest_ >= range * smallest_)) return {none, none, none, none, none, none};
  const double slope = xy / xx, offset = y - slope * x;
  const double left = std::max(0.0, yy - slope * xy) / (static_cast<double>(count_) - 2) / xx;
  FractalFit fit;
  fit.dimension = 1 / slope;
  fit.dimensionError = std::sqrt(left) / (slope * slope);
  fit.prefactor = std::exp(-offset / slope);
  // Of offset/slope: both errors go together by the mean of ln n.
  const double lever = x + offset / slope;
  fit.prefactorError = fit.prefactor / slope * std::sqrt(left * (xx + lever * lever));
  fit.dimensionOverRadius = xy / yy;
  fit.prefactorOverRadius = std::exp(x - y * fit.dimensionOverRadius);
  return fit;
}

}  // namespace lampblack::particles
