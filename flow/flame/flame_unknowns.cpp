// What the unknowns of a flame are: names, sizes that count, bounds, and what keeps them physical.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "chemistry/transport/transport_margin.hpp"
#include "flow/flame/flame_equations_data.hpp"

namespace lampblack::flow {

void FlameEquations::bounds(std::span<double> lower, std::span<double> upper) const {
  const Data& d = *data_;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::fill(lower.begin(), lower.end(), -infinite);
  std::fill(upper.begin(), upper.end(), infinite);
  for (std::size_t i = 0; i < d.points(); ++i) {
    double* low = &lower[i * d.width()];
    double* high = &upper[i * d.width()];
    low[FlameLayout::temperature] = transportmargin::coldest;
    high[FlameLayout::temperature] = transportmargin::hottest;
    for (std::size_t k = 0; k < d.species(); ++k) {
      low[FlameLayout::firstSpecies + k] = -1e-3;  // what differences at a front may undershoot by
      high[FlameLayout::firstSpecies + k] = 1 + 1e-3;
    }
  }
  if (d.problem.type == FlameType::Free) lower[d.points() * d.width() + leftMassFlux] = 1e-6;
  lower[d.points() * d.width() + load] = 0;
}

void FlameEquations::correct(std::span<const double> x, std::span<double> trial) const {
  const Data& d = *data_;
  for (std::size_t i = 0; i < d.points(); ++i)
    for (std::size_t c = d.layout.firstScalar(); c < d.width(); ++c) {
      const std::size_t u = i * d.width() + c;
      trial[u] = positivePart(x[u], trial[u]);
    }
}

// At concentrations below zero a radical that is lost to itself is lost the faster the less there is of it: without
// this, undershoots at a front that moves grow without bounds.
void FlameEquations::clipNegativeAmounts(std::span<double> x) const {
  const Data& d = *data_;
  for (std::size_t i = 0; i < d.points(); ++i)
    for (std::size_t c = FlameLayout::firstSpecies; c < d.width(); ++c) {
      double& value = x[i * d.width() + c];
      value = std::max(value, 0.0);
    }
}

void FlameEquations::scales(std::span<const double> x, std::span<double> scale) const {
  const Data& d = *data_;
  const std::size_t w = d.width(), n = d.points();
  const FlameTolerances& t = d.tolerances;
  for (std::size_t c = 0; c < w; ++c) {
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += std::abs(x[i * w + c]) / static_cast<double>(n);
    const double floor = c == FlameLayout::temperature  ? t.temperature
                         : c < FlameLayout::temperature ? t.flow
                         : c < d.layout.firstScalar()   ? t.species
                                                        : t.scalars;
    for (std::size_t i = 0; i < n; ++i) scale[i * w + c] = t.relative * mean + floor;
  }
  const double* g = &x[n * w];
  scale[n * w + leftMassFlux] = t.relative * std::abs(g[leftMassFlux]) + 1e-2 * t.flow;
  scale[n * w + pressureGradient] = t.relative * std::abs(g[pressureGradient]) + t.flow;
  scale[n * w + load] = t.relative * std::abs(g[load]) + t.flow;
}

std::string FlameEquations::nameOf(std::size_t unknown) const {
  const Data& d = *data_;
  if (unknown >= d.points() * d.width()) {
    static constexpr std::array names{"mass flux of the left stream", "radial pressure gradient", "load"};
    return names[unknown - d.points() * d.width()];
  }
  return d.nameOf(unknown / d.width(), unknown % d.width());
}

std::string FlameEquations::Data::nameOf(std::size_t point, std::size_t c) const {
  const std::string name = c == FlameLayout::massFlux      ? "mass flux"
                           : c == FlameLayout::spread      ? "spread rate"
                           : c == FlameLayout::temperature ? "temperature"
                           : c < layout.firstScalar()      ? mechanism->speciesName(c - FlameLayout::firstSpecies)
                                                           : carried->scalars()[c - layout.firstScalar()].density.name;
  return fmt::format("{} at z = {:.4g} mm (point {} of {})", name, 1e3 * profile.z[point], point + 1, points());
}

}  // namespace lampblack::flow
