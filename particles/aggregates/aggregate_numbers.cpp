#include "particles/aggregates/aggregate_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::particles {

void describeAggregates(const std::vector<const SphereAggregate*>& all, const AggregateLook& look,
                        const AggregatePopulation& population, FractalPoints& law, RandomStream& random,
                        std::span<double> row) {
  double spheres = 0, largest = 0, volume = 0, surface = 0, radius = 0, logs = 0, squares = 0, necks = 0, widths = 0,
         gyration = 0, points = 0, length = 0, shadow = 0, mobility = 0, joints = 0, overlap = 0;
  for (const SphereAggregate* one : all) {
    const auto n = static_cast<double>(one->count());
    spheres += n;
    largest = std::max(largest, n);
    volume += one->volume();
    surface += one->surface();
    for (std::size_t k = 0; k < one->count(); ++k) {
      const AggregateSphere& s = one->spheres()[k];
      radius += s.radius;
      logs += std::log(s.radius);
      squares += std::log(s.radius) * std::log(s.radius);
      if (k == 0) continue;
      ++necks;
      widths += std::sqrt(s.neck) / std::min(s.radius, one->spheres()[s.parent].radius);
    }
    const double square = gyrationSquared(*one), area = projectedArea(*one, look.directions, random);
    gyration += square;
    points += gyrationSquaredOfPoints(*one);
    length += maximumLength(*one);
    shadow += area;
    mobility += shadowDiameter(area);
    joints += coordination(*one);
    overlap += uncountedOverlap(*one);
    if (one->count() >= look.fitFrom) law.add(n, std::sqrt(square) / meanRadius(*one));
  }
  const auto count = static_cast<double>(all.size());
  const double variance = std::max(0.0, squares / spheres - logs / spheres * (logs / spheres));
  const FractalFit fit = law.fit();
  const double values[] = {population.number,
                           count,
                           spheres / count,
                           largest,
                           volume / count,
                           surface / count,
                           radius / spheres,
                           std::exp(std::sqrt(variance)),
                           necks > 0 ? widths / necks : nothingToSay,
                           std::sqrt(gyration / count),
                           std::sqrt(points / count),
                           length / count,
                           shadow / count,
                           mobility / count,
                           population.collisionDiameter,
                           joints / count,
                           overlap / volume,
                           fit.dimension,
                           fit.dimensionError,
                           fit.prefactor,
                           fit.prefactorError,
                           fit.dimensionOverRadius,
                           fit.prefactorOverRadius,
                           static_cast<double>(law.count()),
                           population.tries,
                           population.merged};
  std::ranges::copy(values, row.begin());
}

const std::vector<Quantity>& aggregateQuantities() {
  static const std::vector<Quantity> all{
      {"number", "1/m^3", "number density of particles, of collisions"},
      {"aggregates", "1", "particles of a repeat"},
      {"spheres", "1", "spheres of a particle"},
      {"largest", "1", "spheres of the largest particle"},
      {"volume", "m^3", "volume of a particle"},
      {"surface", "m^2", "free surface of a particle"},
      {"radius", "m", "radius of a sphere"},
      {"radius_deviation", "1", "geometric standard deviation of that radius"},
      {"neck_ratio", "1", "radius of a neck over that of the smaller sphere"},
      {"gyration", "m", "radius of gyration, root of the mean square"},
      {"gyration_points", "m", "the same with the mass of each sphere in its centre"},
      {"length", "m", "largest distance of two points of a particle"},
      {"shadow", "m^2", "projected area of a particle"},
      {"mobility_diameter", "m", "diameter of the sphere with that area"},
      {"collision_diameter", "m", "diameter of collision, of collisions"},
      {"coordination", "1", "neighbours of a sphere"},
      {"overlap", "1", "volume shared by spheres that are not neighbours, over the volume of all"},
      {"fractal_dimension", "1",
       "D of n = k (R_g/a)^D over the particles with output.fit_from spheres; while aggregates are built of all sizes "
       "so far"},
      {"fractal_dimension_fit", "1", "standard error of D of the fit of a repeat"},
      {"fractal_prefactor", "1", "k of that law"},
      {"fractal_prefactor_fit", "1", "standard error of k of the fit of a repeat"},
      {"fractal_dimension_over_radius", "1", "D of the same law by least squares of ln n over ln(R_g/a)"},
      {"fractal_prefactor_over_radius", "1", "k of that line"},
      {"fitted", "1", "particles in the fit"},
      {"lines", "1", "straight lines drawn for a collision"},
      {"merged", "1", "spheres that have become one with a neighbour"}};
  return all;
}

}  // namespace lampblack::particles
