#include "particles/population/model/nucleation_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

NucleationSchedule::NucleationSchedule(const NucleationOptions& options) : options_(options) {
  if (options_.source != NucleationOptions::Source::table) return;
  if (options_.times.size() != options_.rates.size() || options_.times.size() < 2) {
    throw InputError("nucleation: a table needs as many rates as times, at least two");
  }
  integral_.assign(options_.times.size(), 0.0);
  for (std::size_t k = 1; k < integral_.size(); ++k) {
    const double width = options_.times[k] - options_.times[k - 1];
    if (!(width > 0)) throw InputError("nucleation: the times of a table need to increase");
    integral_[k] = integral_[k - 1] + 0.5 * width * (options_.rates[k] + options_.rates[k - 1]);
  }
}

double NucleationSchedule::rate(double time) const {
  switch (options_.source) {
    case NucleationOptions::Source::constant:
      return options_.rate;
    case NucleationOptions::Source::precursor:
      return options_.rateConstant * options_.precursor * std::exp(-options_.rateConstant * time);
    case NucleationOptions::Source::table:
      break;
  }
  const auto& t = options_.times;
  if (time < t.front() || time > t.back()) return 0;
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin()),
                                       t.size() - 1);
  const double x = (time - t[k - 1]) / (t[k] - t[k - 1]);
  return (1 - x) * options_.rates[k - 1] + x * options_.rates[k];
}

double NucleationSchedule::cumulative(double time) const {
  switch (options_.source) {
    case NucleationOptions::Source::constant:
      return options_.rate * time;
    case NucleationOptions::Source::precursor:
      return -options_.precursor * std::expm1(-options_.rateConstant * time);
    case NucleationOptions::Source::table:
      break;
  }
  const auto& t = options_.times;
  if (time <= t.front()) return 0;
  if (time >= t.back()) return integral_.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
  return integral_[k - 1] + 0.5 * (time - t[k - 1]) * (options_.rates[k - 1] + rate(time));
}

double NucleationSchedule::timeOf(double number) const {
  switch (options_.source) {
    case NucleationOptions::Source::constant:
      return options_.rate > 0 ? number / options_.rate : infinity;
    case NucleationOptions::Source::precursor:
      // To 1e-16 / rateConstant, at half the cost of log1p.
      return number < options_.precursor
                 ? std::log(options_.precursor / (options_.precursor - number)) / options_.rateConstant
                 : infinity;
    case NucleationOptions::Source::table:
      break;
  }
  if (number >= integral_.back()) return infinity;
  const auto k = std::max<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(integral_.begin(), integral_.end(), number) - integral_.begin()), 1);
  const double slope = (options_.rates[k] - options_.rates[k - 1]) / (options_.times[k] - options_.times[k - 1]);
  const double rest = number - integral_[k - 1], start = options_.rates[k - 1];
  // The smaller root of slope x^2 / 2 + start x = rest, without cancellation.
  const double x = 2 * rest / (start + std::sqrt(std::max(start * start + 2 * slope * rest, 0.0)));
  return options_.times[k - 1] + (rest > 0 ? x : 0.0);
}

}  // namespace lampblack::particles
