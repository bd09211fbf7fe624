#include "particles/population/sectional/initial_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

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

// A row of a table, of one particle, volumes in units of `unit`.
Part intervalPart(const SizeInterval& interval, double unit, double a, double b) {
  const double from = interval.from / unit, to = interval.to / unit;
  const double low = std::max(a, from), high = std::min(b, to);
  if (!(high > low)) return {0, 0};
  const double span = std::log(to / from), number = std::log(high / low) / span;
  return {number, (high - low) / span - a * number};
}

// Adds a population all of one volume.
void addEqual(const SectionGrid& grid, const InitialPopulation& initial, std::vector<double>& y) {
  const double end = grid.volume(grid.last());
  // On the first pivot but for rounding is on the grid.
  if (initial.volume < grid.volume(1) * (1 - 1e-12) || initial.volume > end) {
    throw InputError(
        fmt::format("the volume of the initial particles, {:.4g} m3, is outside the sectional grid, "
                    "{:.4g} to {:.4g} m3",
                    initial.volume, grid.volume(1), end));
  }
  const auto place = grid.pivotsAround(initial.volume);
  y[place.lower] += (1 - place.upper) * initial.number;
  y[place.lower + 1] += place.upper * initial.number;
}

// Adds `number` particles spread by `part` over volumes in units of `unit`.
template <class PartOf>
void addSpread(const SectionGrid& grid, double number, double unit, PartOf part, std::vector<double>& y) {
  const SectionLayout layout = grid.layout();
  for (std::size_t k = 0; k < grid.last(); ++k) {
    const double a = grid.volume(k) / unit, b = grid.volume(k + 1) / unit;
    const Part p = part(a, b);
    const double upper = std::clamp(p.excess / (b - a), 0.0, p.number);  // outside by rounding only
    y[k] += number * (p.number - upper);
    y[k + 1] += number * upper;
  }
  const double a = grid.volume(grid.last()) / unit;
  const Part rest = part(a, std::numeric_limits<double>::infinity());
  y[layout.overNumber()] += number * rest.number;
  y[layout.overVolume()] += number * (rest.number + rest.excess / a);
}

void addMode(const SectionGrid& grid, const InitialPopulation& mode, std::vector<double>& y) {
  using Distribution = InitialPopulation::Distribution;
  const double sigma = 3 * std::log(mode.geometricDeviation);
  if (mode.distribution == Distribution::table) {
    for (const SizeInterval& interval : mode.intervals)
      addSpread(
          grid, interval.number, interval.from,
          [&](double a, double b) { return intervalPart(interval, interval.from, a, b); }, y);
  } else if (mode.distribution == Distribution::exponential) {
    addSpread(
        grid, mode.number, mode.volume,
        [](double a, double b) {
          return std::isinf(b) ? Part{std::exp(-a), std::exp(-a)} : exponentialPart(a, b);
        },
        y);
  } else if (mode.distribution == Distribution::monodisperse || sigma == 0) {
    addEqual(grid, mode, y);
  } else {
    addSpread(
        grid, mode.number, mode.volume, [&](double a, double b) { return lognormalPart(a, b, sigma); }, y);
  }
}

}  // namespace

std::vector<double> initialSections(const SectionGrid& grid, const InitialPopulation& initial, double overflow) {
  const SectionLayout layout = grid.layout();
  std::vector<double> y(layout.size(), 0.0);
  if (initial.distribution == InitialPopulation::Distribution::none || initial.number == 0) return y;
  for (const InitialPopulation& mode : modesOf(initial)) addMode(grid, mode, y);
  const double end = grid.volume(grid.last());
  const double lost = y[layout.overVolume()] * end / initialMoment(initial, 1);
  if (lost > overflow) {
    throw InputError(
        fmt::format("the sectional grid ends too early for the initial population: {:.2g} of its volume is "
                    "in particles above the last pivot, {:.4g} m3",
                    lost, end));
  }
  return y;
}

}  // namespace lampblack::particles
