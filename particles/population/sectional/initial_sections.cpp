#include "particles/population/sectional/initial_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

struct Part {
  double number, excess;  // excess: integral of (v - a) n dv over [a, b]
};

// n = exp(-x), a and b in units of the mean volume.
Part exponentialPart(double a, double b) {
  const double width = b - a, scale = std::exp(-a);
  const double number = -std::expm1(-width);
  // 1 - (1 + w) exp(-w), which cancels for narrow intervals.
  const double excess =
      width < 1e-3 ? width * width * (0.5 - width * (1.0 / 3 - width / 8)) : number - width * std::exp(-width);
  return {scale * number, scale * excess};
}

// Probability of a standard normal variable between two bounds, from the side where nothing cancels.
double normalBetween(double a, double b) {
  const double root = std::sqrt(0.5);
  if (a > 0) return 0.5 * (std::erfc(a * root) - std::erfc(b * root));
  if (b < 0) return 0.5 * (std::erfc(-b * root) - std::erfc(-a * root));
  return 0.5 * (std::erf(b * root) - std::erf(a * root));
}

// ln v normal about zero, volumes in units of the median.
Part lognormalPart(double a, double b, double sigma) {
  const double from = std::log(a) / sigma, to = std::log(b) / sigma;
  const double number = normalBetween(from, to);
  const double volume = std::exp(0.5 * sigma * sigma) * normalBetween(from - sigma, to - sigma);
  return {number, volume - a * number};
}

}  // namespace

std::vector<double> initialSections(const SectionGrid& grid, const InitialPopulation& initial, double overflow) {
  const SectionLayout layout = grid.layout();
  std::vector<double> y(layout.size(), 0.0);
  using Distribution = InitialPopulation::Distribution;
  if (initial.distribution == Distribution::none || initial.number == 0) return y;
  const double end = grid.volume(grid.last());
  const bool exponential = initial.distribution == Distribution::exponential;
  const double sigma = 3 * std::log(initial.geometricDeviation);
  if (initial.distribution == Distribution::monodisperse || (!exponential && sigma == 0)) {
    // On the first pivot but for rounding is on the grid.
    if (initial.volume < grid.volume(1) * (1 - 1e-12) || initial.volume > end) {
      throw InputError(
          fmt::format("the volume of the initial particles, {:.4g} m3, is outside the sectional grid, "
                      "{:.4g} to {:.4g} m3",
                      initial.volume, grid.volume(1), end));
    }
    const auto place = grid.pivotsAround(initial.volume);
    y[place.lower] = (1 - place.upper) * initial.number;
    y[place.lower + 1] = place.upper * initial.number;
    return y;
  }
  const auto part = [&](double a, double b) {
    return exponential ? exponentialPart(a, b) : lognormalPart(a, b, sigma);
  };
  for (std::size_t k = 0; k < grid.last(); ++k) {
    const double a = grid.volume(k) / initial.volume, b = grid.volume(k + 1) / initial.volume;
    const Part p = part(a, b);
    const double upper = std::clamp(p.excess / (b - a), 0.0, p.number);  // outside by rounding only
    y[k] += initial.number * (p.number - upper);
    y[k + 1] += initial.number * upper;
  }
  const double a = end / initial.volume, infinity = std::numeric_limits<double>::infinity();
  const Part rest = exponential ? Part{std::exp(-a), std::exp(-a)} : part(a, infinity);
  y[layout.overNumber()] = initial.number * rest.number;
  y[layout.overVolume()] = initial.number * (rest.number + rest.excess / a);
  const double mean = exponential ? 1 : std::exp(0.5 * sigma * sigma);
  const double lost = (rest.excess + a * rest.number) / mean;
  if (lost > overflow) {
    throw InputError(
        fmt::format("the sectional grid ends too early for the initial population: {:.2g} of its volume is "
                    "in particles above the last pivot, {:.4g} m3",
                    lost, end));
  }
  return y;
}

}  // namespace lampblack::particles
