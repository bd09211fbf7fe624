// Geometry of spheres that overlap in pairs: caps, lenses, and the radius that a volume and its necks ask for. SI, or
// any one unit of length. docs/theory/spheres.md has the equations.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

// From the centre of a sphere to the plane of its neck with another at a distance; negative where it lies behind.
[[nodiscard]] inline double planeOfNeck(double radius, double other, double distance) {
  return (distance * distance - other * other + radius * radius) / (2 * distance);
}
// The same from the square of the neck's radius, which is smaller than the sphere's: NaN where it is not.
[[nodiscard]] inline double planeOfNeck(double radius, double neck) {
  return std::sqrt(radius * radius - neck);
}

// What a plane at a distance x from the centre cuts off.
[[nodiscard]] inline double capVolume(double radius, double x) {
  return constants::pi / 3 * (radius - x) * (radius - x) * (2 * radius + x);
}
[[nodiscard]] inline double capSurface(double radius, double x) {
  return 2 * constants::pi * radius * (radius - x);
}
// Of a cap: its volume times the distance of its centroid from the centre, and the integral of the squared distance
// from the centre.
[[nodiscard]] inline double capFirstMoment(double radius, double x) {
  const double square = radius * radius - x * x;
  return constants::pi / 4 * square * square;
}
[[nodiscard]] inline double capSecondMoment(double radius, double x) {
  const auto fifth = [](double a) { return a * a * a * a * a; };
  return constants::pi / 2 * (radius * radius * radius * radius * (radius - x) - (fifth(radius) - fifth(x)) / 5);
}

[[nodiscard]] inline double volumeOfRadius(double radius) {
  return 4 * constants::pi / 3 * radius * radius * radius;
}
[[nodiscard]] inline double surfaceOfRadius(double radius) {
  return 4 * constants::pi * radius * radius;
}

// Volume that two spheres share.
[[nodiscard]] inline double lensVolume(double a, double b, double distance) {
  if (distance >= a + b) return 0;
  if (distance <= std::abs(a - b)) return volumeOfRadius(std::min(a, b));
  const double overlap = a + b - distance;
  return constants::pi * overlap * overlap * (distance * distance + 2 * distance * (a + b) - 3 * (a - b) * (a - b)) /
         (12 * distance);
}

}  // namespace lampblack::particles
