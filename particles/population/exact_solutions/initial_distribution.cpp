#include "particles/population/exact_solutions/initial_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/population/exact_solutions/quadrature.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

// Standard deviation of ln v.
double spread(const InitialPopulation& initial) {
  return 3 * std::log(initial.geometricDeviation);
}

bool single(const InitialPopulation& initial) {
  return initial.distribution == Distribution::monodisperse ||
         (initial.distribution == Distribution::lognormal && !(spread(initial) > 0));
}

bool nothing(const InitialPopulation& initial) {
  return initial.distribution == Distribution::none || !(initial.number > 0);
}

// The part of an interval's number between two volumes.
double numberWithin(const SizeInterval& interval, double lower, double upper) {
  const double a = std::max(lower, interval.from), b = std::min(upper, interval.to);
  return b > a ? interval.number * std::log(b / a) / std::log(interval.to / interval.from) : 0;
}

}  // namespace

double intervalMoment(const SizeInterval& interval, double order) {
  const double span = order * std::log(interval.to / interval.from);
  return interval.number * std::pow(interval.from, order) * (span == 0 ? 1 : std::expm1(span) / span);
}

double initialMoment(const InitialPopulation& initial, double order) {
  if (nothing(initial)) return 0;
  if (initial.distribution == Distribution::table || initial.distribution == Distribution::modes) {
    double sum = 0;
    for (const InitialPopulation& mode : initial.modes) sum += initialMoment(mode, order);
    for (const SizeInterval& interval : initial.intervals) sum += intervalMoment(interval, order);
    return sum;
  }
  const double equal = initial.number * std::pow(initial.volume, order);
  if (single(initial)) return equal;
  if (initial.distribution == Distribution::exponential) {
    if (!(order > -1)) throw InputError("an exponential size distribution has no moments of order -1 or below");
    return equal * std::tgamma(1 + order);
  }
  const double s = spread(initial);
  return equal * std::exp(0.5 * order * order * s * s);
}

double initialNumber(const InitialPopulation& initial, double lower, double upper) {
  if (nothing(initial) || !(upper > lower)) return 0;
  if (initial.distribution == Distribution::table || initial.distribution == Distribution::modes) {
    double sum = 0;
    for (const InitialPopulation& mode : initial.modes) sum += initialNumber(mode, lower, upper);
    for (const SizeInterval& interval : initial.intervals) sum += numberWithin(interval, lower, upper);
    return sum;
  }
  const double v = initial.volume;
  if (single(initial)) return v >= lower && v < upper ? initial.number : 0.0;
  if (initial.distribution == Distribution::exponential) {
    return -initial.number * std::exp(-std::max(lower, 0.0) / v) * std::expm1((std::max(lower, 0.0) - upper) / v);
  }
  if (!(upper > 0)) return 0;
  // The smaller tail, so that differences of probabilities keep their digits.
  const double scale = std::sqrt(2.0) * spread(initial);
  const double a = lower > 0 ? std::log(lower / v) / scale : -HUGE_VAL, b = std::log(upper / v) / scale;
  const double probability = a > 0 ? std::erfc(a) - std::erfc(b) : std::erfc(-b) - std::erfc(-a);
  return 0.5 * initial.number * probability;
}

double initialIntegral(const InitialPopulation& initial, double lower, double upper,
                       const std::function<double(double)>& f) {
  if (nothing(initial) || !(upper > lower)) return 0;
  if (initial.distribution == Distribution::table || initial.distribution == Distribution::modes) {
    double sum = 0;
    for (const InitialPopulation& mode : initial.modes) sum += initialIntegral(mode, lower, upper, f);
    for (const SizeInterval& interval : initial.intervals) {
      const double a = std::max(lower, interval.from), b = std::min(upper, interval.to);
      if (!(b > a)) continue;
      sum += interval.number / std::log(interval.to / interval.from) *
             integral([&](double z) { return f(std::exp(z)); }, std::log(a), std::log(b));
    }
    return sum;
  }
  const double v0 = initial.volume;
  if (single(initial)) return v0 >= lower && v0 < upper ? initial.number * f(v0) : 0.0;
  if (initial.distribution == Distribution::exponential) {
    // 80^3 exp(-80) is below round-off.
    const auto density = [&](double v) { return initial.number / v0 * std::exp(-v / v0) * f(v); };
    return integralOverSizes(density, std::max(lower, 0.0), upper, std::max(lower, 0.0) + 80 * v0);
  }
  // In z = ln(v/v0)/s; the weight v^3 moves its maximum by 3 s.
  const double s = spread(initial);
  const double first = std::max(lower > 0 ? std::log(lower / v0) / s : -HUGE_VAL, -12.0);
  const double last = std::min(upper > 0 ? std::log(upper / v0) / s : -HUGE_VAL, 3 * s + 12);
  std::vector<double> breakpoints;
  for (double z = first + 1; z < last; ++z) breakpoints.push_back(z);
  const double norm = initial.number / std::sqrt(2 * constants::pi);
  return integral([&](double z) { return norm * std::exp(-0.5 * z * z) * f(v0 * std::exp(s * z)); }, first, last,
                  breakpoints);
}

}  // namespace lampblack::particles
