// What is said of aggregates of spheres: how large they are, how they look from afar, and by which law of a fractal
// their size goes with the number of spheres. docs/theory/spheres.md.
#pragma once

#include <cstddef>
#include <span>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/spheres/ballistic_joining.hpp"
#include "particles/spheres/sphere_aggregate.hpp"

namespace lampblack::particles {

// Square of the radius of gyration: of the spheres as their necks cut them; or of their masses, each in the centre.
[[nodiscard]] double gyrationSquared(const SphereAggregate& aggregate);
[[nodiscard]] double gyrationSquaredOfPoints(const SphereAggregate& aggregate);

[[nodiscard]] double meanRadius(const SphereAggregate& aggregate);
// Neighbours of a sphere, in the mean: 2 (n - 1)/n.
[[nodiscard]] double coordination(const SphereAggregate& aggregate);
// Largest distance of two points.
[[nodiscard]] double maximumLength(const SphereAggregate& aggregate);
// Lenses of spheres that are not neighbours, which the volumes of the spheres do not know of.
[[nodiscard]] double uncountedOverlap(const SphereAggregate& aggregate);

// Area that discs cover, exactly; they are seen along z.
[[nodiscard]] double coveredArea(std::span<const RigidSphere> discs);
// Area of the shadow: the mean over so many directions.
[[nodiscard]] double projectedArea(const SphereAggregate& aggregate, std::size_t directions, RandomStream& random);
// The same along x, y and z as the aggregate stands.
[[nodiscard]] double shadowAlongAxes(const SphereAggregate& aggregate);
// Of the sphere with the same shadow, which is that of the same mobility where the gas has no collisions.
[[nodiscard]] double shadowDiameter(double area);

// n = prefactor (R_g/a)^dimension, by least squares of ln(R_g/a), which scatters, over ln n, which does not; points
// have weights. Standard errors of both from how far the points lie from the line. NaN where there are fewer than three
// points, or the largest n is less than `range` times the smallest.
// `...OverRadius`: of the other line through the points, by least squares of ln n over ln(R_g/a). Its dimension is
// smaller by the square of the correlation of both.
struct FractalFit {
  double dimension = 0, dimensionError = 0, prefactor = 0, prefactorError = 0;
  double dimensionOverRadius = 0, prefactorOverRadius = 0;
};
class FractalPoints {
 public:
  void add(double number, double gyrationOverRadius, double weight = 1);
  [[nodiscard]] FractalFit fit() const;
  [[nodiscard]] std::size_t count() const { return count_; }
  static constexpr double range = 4;

 private:
  std::size_t count_ = 0;
  double smallest_ = 0, largest_ = 0;
  double weight_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

}  // namespace lampblack::particles
